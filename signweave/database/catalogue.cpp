#include "signweave/database/catalogue.h"

#include <fmt/format.h>

#include <cmath>

#include "signweave/kv/sealed.h"

namespace signweave::catalogue {
namespace {

// Version 2 is the first; since version 3 the head has a tolerance, and recordings have rig names and defects.
constexpr std::uint8_t kFirstVersion = 2;

Bytes key_of(char what) {
  ByteWriter key;
  key.number(what);
  return key.take();
}

struct OpenRecord {
  std::uint8_t version = 0;
  ByteReader in;
};

OpenRecord open_record(const kv::ReadTransaction& snapshot, ByteSpan key, const std::string& where) {
  const auto record = snapshot.get(key);
  if (!record) ByteReader({}, where).fail("it is missing");
  ByteReader reader(kv::unsealed(*record, where), where);
  const auto version = reader.number<std::uint8_t>();
  if (version < kFirstVersion || version > kVersion) {
    throw Error(
        ErrorCode::unsupported,
        fmt::format("{}: written by another version of signweave (record version {}, this one reads {} to {}); use "
                    "that version, or import the recordings again",
                    where, version, kFirstVersion, kVersion));
  }
  return {version, reader};
}

ByteWriter new_record() {
  ByteWriter writer;
  writer.number(kVersion);
  return writer;
}

void encode(const FrameClock& clock, ByteWriter& out) {
  out.number(clock.frame_time.count());
  out.number(clock.origin.count());
}

FrameClock decode_clock(ByteReader& in) {
  FrameClock clock;
  clock.frame_time = Seconds(in.number<double>());
  clock.origin = Seconds(in.number<double>());
  return clock;
}

void encode(const TierNames& names, ByteWriter& out) {
  out.number(static_cast<std::uint32_t>(names.sign_tiers.size()));
  for (const TierNames::SignTier& tier : names.sign_tiers) {
    out.text(tier.id);
    out.number(tier.hand);
    out.text(tier.signer);
  }
  out.number(static_cast<std::uint32_t>(names.phase_tiers.size()));
  for (const std::string& tier : names.phase_tiers) out.text(tier);
  out.number(static_cast<std::uint32_t>(names.phase_labels.size()));
  for (const auto& [label, kind] : names.phase_labels) {
    out.text(label);
    out.number(kind);
  }
}

TierNames decode_tier_names(ByteReader& in) {
  TierNames names;
  for (std::size_t n = in.count(9); n > 0; --n) {
    TierNames::SignTier tier;
    tier.id = in.text();
    tier.hand = in.number<Hand>();
    tier.signer = in.text();
    names.sign_tiers.push_back(std::move(tier));
  }
  for (std::size_t n = in.count(4); n > 0; --n) names.phase_tiers.push_back(in.text());
  for (std::size_t n = in.count(5); n > 0; --n) {
    std::string label = in.text();
    names.phase_labels.emplace(std::move(label), in.number<PhaseKind>());
  }
  return names;
}

void encode(const RigNames& names, ByteWriter& out) {
  out.number(static_cast<std::uint32_t>(names.size()));
  for (const auto& [part, joint] : names) {
    out.number(part);
    out.text(joint);
  }
}

RigNames decode_rig(ByteReader& in) {
  RigNames names;
  for (std::size_t n = in.count(5); n > 0; --n) {
    const auto part = in.number<Part>();
    if (static_cast<std::size_t>(part) >= kPartCount) in.fail("a part of the body that does not exist");
    names.emplace(part, in.text());
  }
  return names;
}

void encode(const Declarations& declarations, ByteWriter& out) {
  out.number(static_cast<std::uint32_t>(declarations.size()));
  for (const auto& [name, value] : declarations) {
    out.text(name);
    out.text(value);
  }
}

Declarations decode_declarations(ByteReader& in) {
  Declarations declarations;
  for (std::size_t n = in.count(8); n > 0; --n) {
    std::string name = in.text();
    declarations.emplace_back(std::move(name), in.text());
  }
  return declarations;
}

void encode(const std::vector<Defect>& defects, ByteWriter& out) {
  out.number(static_cast<std::uint32_t>(defects.size()));
  for (const Defect& defect : defects) {
    out.number(defect.kind);
    out.number(static_cast<std::int32_t>(defect.joint));
    out.number(defect.frames.begin);
    out.number(defect.frames.end);
    out.number(defect.value);
    out.text(defect.text);
  }
}

std::vector<Defect> decode_defects(ByteReader& in) {
  std::vector<Defect> defects;
  for (std::size_t n = in.count(29); n > 0; --n) {
    Defect defect;
    defect.kind = in.number<DefectKind>();
    if (defect.kind > kLastDefectKind) in.fail("a kind of defect that does not exist");
    defect.joint = in.number<std::int32_t>();
    defect.frames.begin = in.number<std::int64_t>();
    defect.frames.end = in.number<std::int64_t>();
    defect.value = in.number<float>();
    defect.text = in.text();
    const bool in_order = 0 <= defect.frames.begin && defect.frames.begin <= defect.frames.end;
    if (defect.joint < kNoJoint || !in_order || !std::isfinite(defect.value)) in.fail("an impossible defect");
    defects.push_back(std::move(defect));
  }
  return defects;
}

}  // namespace

bool is_key(ByteSpan key) noexcept {
  const char what = key.empty() ? '\0' : static_cast<char>(key[0]);
  return what == 'C' || what == 'R' || what == 'P';
}

Bytes head_key() {
  return key_of('C');
}

Bytes slot_key(std::uint32_t slot) {
  ByteWriter key;
  key.number('R');
  key.number(slot);
  return key.take();
}

Head read_head(const kv::ReadTransaction& snapshot) {
  auto [version, in] = open_record(snapshot, key_of('C'), "catalogue");
  Head head;
  head.layout = version;
  head.changes = in.number<std::uint64_t>();
  head.next_generation = in.number<std::uint64_t>();
  head.recordings = in.number<std::uint32_t>();
  head.access_mode.kind = in.number<AccessMode::Kind>();
  head.access_mode.frames_per_packet = in.number<std::uint32_t>();
  if (version >= 3) head.tolerance = in.number<float>();
  if (in.left() > 0) head.documents = in.number<DocumentStorage>();  // absent in older databases
  if (head.documents > DocumentStorage::node) in.fail("a storage of documents that does not exist");
  in.finish();
  return head;
}

void write_head(kv::WriteTransaction& transaction, const Head& head) {
  ByteWriter out = new_record();
  out.number(head.changes);
  out.number(head.next_generation);
  out.number(head.recordings);
  out.number(head.access_mode.kind);
  out.number(head.access_mode.frames_per_packet);
  out.number(head.tolerance);
  out.number(head.documents);
  transaction.put(key_of('C'), kv::sealed(out.bytes()));
}

RecordingInfo read_recording(const kv::ReadTransaction& snapshot, std::uint32_t slot) {
  auto [version, in] = open_record(snapshot, slot_key(slot), fmt::format("catalogue entry {}", slot));
  RecordingInfo info;
  MotionFacts& facts = info.motion_facts;
  info.name = in.text();
  info.signer = in.text();
  info.clock = decode_clock(in);
  const auto given = in.number<std::uint8_t>();
  info.clock_given = (given & 1) != 0;
  info.tiers_given = (given & 2) != 0;
  info.signer_given = (given & 4) != 0;
  if (in.number<std::uint8_t>() != 0) info.motion = motion_db::decode(in);
  if (in.number<std::uint8_t>() != 0) facts.layout = bvh::decode_layout(in);
  info.document = in.number<std::uint64_t>();
  info.tiers = decode_tier_names(in);
  facts.file = in.text();
  info.annotation_file = in.text();
  facts.fingerprint = in.number<std::uint64_t>();
  info.annotation_fingerprint = in.number<std::uint64_t>();
  for (std::size_t n = in.count(8); n > 0; --n) {
    Notice notice;
    notice.where = in.text();
    notice.text = in.text();
    info.notices.push_back(std::move(notice));
  }
  info.declarations = decode_declarations(in);
  facts.face_file = in.text();
  facts.face_fingerprint = in.number<std::uint64_t>();
  if (version >= 3) {
    info.rig = decode_rig(in);
    info.defects = decode_defects(in);
  }
  if (info.motion && facts.face_file.empty()) facts.own_tracks = static_cast<std::uint32_t>(info.motion->tracks.size());
  if (in.left() > 0) {  // absent in recordings stored when BVH was the only motion format
    facts.face_offset = Seconds(in.number<double>());
    facts.reading = in.text();
    facts.own_tracks = in.number<std::uint32_t>();
    facts.declarations = decode_declarations(in);
    if (facts.own_tracks > (info.motion ? info.motion->tracks.size() : 0)) in.fail("more tracks than the motion has");
  }
  if (in.left() > 0) {  // absent in recordings stored before notices had remedies
    for (Notice& notice : info.notices) {
      for (std::size_t n = in.count(8); n > 0; --n) {
        std::string parameter = in.text();
        notice.remedies.push_back({std::move(parameter), in.text()});
      }
    }
  }
  in.finish();
  return info;
}

void write_recording(kv::WriteTransaction& transaction, std::uint32_t slot, const RecordingInfo& info) {
  const MotionFacts& facts = info.motion_facts;
  ByteWriter out = new_record();
  out.text(info.name);
  out.text(info.signer);
  encode(info.clock, out);
  out.number(
      static_cast<std::uint8_t>((info.clock_given ? 1 : 0) | (info.tiers_given ? 2 : 0) | (info.signer_given ? 4 : 0)));
  out.number(static_cast<std::uint8_t>(info.motion ? 1 : 0));
  if (info.motion) motion_db::encode(*info.motion, out);
  out.number(static_cast<std::uint8_t>(facts.layout ? 1 : 0));
  if (facts.layout) bvh::encode(*facts.layout, out);
  out.number(info.document);
  encode(info.tiers, out);
  out.text(facts.file);
  out.text(info.annotation_file);
  out.number(facts.fingerprint);
  out.number(info.annotation_fingerprint);
  out.number(static_cast<std::uint32_t>(info.notices.size()));
  for (const Notice& notice : info.notices) {
    out.text(notice.where);
    out.text(notice.text);
  }
  encode(info.declarations, out);
  out.text(facts.face_file);
  out.number(facts.face_fingerprint);
  encode(info.rig, out);
  encode(info.defects, out);
  out.number(facts.face_offset.count());
  out.text(facts.reading);
  out.number(facts.own_tracks);
  encode(facts.declarations, out);
  for (const Notice& notice : info.notices) {
    out.number(static_cast<std::uint32_t>(notice.remedies.size()));
    for (const Remedy& remedy : notice.remedies) {
      out.text(remedy.parameter);
      out.text(remedy.value);
    }
  }
  transaction.put(slot_key(slot), kv::sealed(out.bytes()));
}

void move_recording(kv::WriteTransaction& transaction, std::uint32_t from, std::uint32_t to) {
  const auto record = transaction.get(slot_key(from));
  if (!record) ByteReader({}, fmt::format("catalogue entry {}", from)).fail("it is missing");
  const Bytes copy(record->begin(), record->end());
  transaction.put(slot_key(to), copy);
  transaction.erase(slot_key(from));
}

void erase_recording(kv::WriteTransaction& transaction, std::uint32_t slot) {
  transaction.erase(slot_key(slot));
}

SweepList read_sweep_list(const kv::ReadTransaction& snapshot) {
  if (!snapshot.get(key_of('P'))) return {};
  ByteReader in = open_record(snapshot, key_of('P'), "sweep list").in;
  SweepList list;
  for (std::size_t n = in.count(8); n > 0; --n) list.push_back(motion_db::decode(in));
  in.finish();
  return list;
}

void write_sweep_list(kv::WriteTransaction& transaction, const SweepList& list) {
  ByteWriter out = new_record();
  out.number(static_cast<std::uint32_t>(list.size()));
  for (const motion_db::StoredMotion& motion : list) motion_db::encode(motion, out);
  transaction.put(key_of('P'), kv::sealed(out.bytes()));
}

}  // namespace signweave::catalogue
