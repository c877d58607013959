#include "signweave/motion_db/packet.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "signweave/core/text.h"
#include "signweave/motion_db/compact.h"

// The value of every record (numbers are little-endian):
//    0  u64  checksum: XXH3-64 of all the bytes that follow
//    8  u64  generation
//   16  u8   kind of record
//   17  u8   version of this layout: 1, or 2 for compact packets
//   18  u16  joint of a packet (0xFFFF: all joints); else 0
//   20  u32  first frame
//   24  u32  frames
//   28  u16  rotations per frame; for scalar tracks their number
//   30  u16  translations per frame
//   32       payload
//
// A plain packet's payload is all its rotations, then all its translations, each by frame and within a frame by joint:
// rotations [frame][joint] of f32 x, y, z, w, and translations [frame][translated joint] of f32 x, y, z in metres. So
// any range of its frames is two contiguous ranges of bytes, and with all joints their order is that of a Motion: two
// copies suffice. The payload of scalar tracks is f32 values by track and within a track by frame. A skeleton's payload
// is: u32 joints, each a text, i32 parent, f32 x, y, z, u8 translated; u32 tips, each an i32 joint, f32 x, y, z.
// Compact packets: compact_layout.h.

namespace signweave::motion_db {

namespace {

static_assert(sizeof(Eigen::Quaternionf) == 16 && sizeof(Eigen::Vector3f) == 12, "packets hold their bytes");

Bytes begin_record(std::uint64_t generation, const Record& record, RecordLayout layout, std::size_t payload) {
  ByteWriter header;
  header.number(std::uint64_t{0});  // placeholder for the checksum, see `seal`
  header.number(generation);
  header.number(record.kind);
  header.number(layout.packing);
  header.number(record.part);
  header.number(static_cast<std::uint32_t>(record.frames.begin));
  header.number(static_cast<std::uint32_t>(record.frames.size()));
  header.number(layout.width.rotations);
  header.number(layout.width.translations);
  assert(header.size() == kHeaderSize);
  Bytes bytes = header.take();
  bytes.reserve(kHeaderSize + payload);
  return bytes;
}

void append(Bytes& bytes, ByteSpan more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void seal(Bytes& bytes) {
  const std::uint64_t sum = checksum(ByteSpan(bytes).subspan(sizeof(std::uint64_t)));
  std::memcpy(bytes.data(), &sum, sizeof sum);
}

template <typename T>
T number_at(ByteSpan bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.subspan(at, sizeof(T)).data(), sizeof(T));
  return value;
}

/// Writes a number with the most significant byte first, so that engines with ordered keys store a motion's records
/// next to each other in writing order. Returns the position after the number.
template <typename T>
std::byte* put_ordered(std::byte* at, T value) {
  for (int shift = 8 * (static_cast<int>(sizeof(T)) - 1); shift >= 0; shift -= 8) {
    *at++ = static_cast<std::byte>(value >> shift);
  }
  return at;
}

}  // namespace

Key key_of(std::uint64_t generation, const Record& record) noexcept {
  Key key;
  std::byte* at = key.data();
  *at++ = std::byte{'m'};
  at = put_ordered(at, generation);
  at = put_ordered(at, static_cast<std::uint8_t>(record.kind));
  at = put_ordered(at, record.block);
  at = put_ordered(at, record.part);
  assert(at == key.data() + key.size());
  return key;
}

bool cut_by_joint(AccessMode mode) noexcept {
  return mode.kind == AccessMode::Kind::by_joint || mode.kind == AccessMode::Kind::by_joint_and_frame;
}

std::int64_t packet_frames(const StoredMotion& stored) noexcept {
  const bool by_frame =
      stored.mode.kind == AccessMode::Kind::by_frame || stored.mode.kind == AccessMode::Kind::by_joint_and_frame;
  return std::max<std::int64_t>(1, by_frame ? stored.mode.frames_per_packet : stored.frames);
}

Width width_of(const Skeleton& skeleton, const Record& packet) noexcept {
  if (packet.part == kAllJoints) {
    return {static_cast<std::uint16_t>(skeleton.joint_count()),
            static_cast<std::uint16_t>(skeleton.translation_count())};
  }
  return {1, static_cast<std::uint16_t>(skeleton.joint(packet.part).translated ? 1 : 0)};
}

std::size_t value_size(const Record& record, Width width) noexcept {
  const std::size_t frame = record.kind == RecordKind::tracks ? width.rotations * sizeof(float) : width.frame_bytes();
  return kHeaderSize + static_cast<std::size_t>(record.frames.size()) * frame;
}

Packing packing_of(const StoredMotion& stored) noexcept {
  return stored.tolerance > 0 ? Packing::compact : Packing::plain;
}

bool can_have_size(const Record& record, RecordLayout layout, std::size_t bytes) noexcept {
  if (layout.packing == Packing::plain) return bytes == value_size(record, layout.width);
  return bytes >= kHeaderSize + smallest_payload(record, layout.width);
}

void for_each_packet(const StoredMotion& stored, FrameRange frames, const JointSet& joints,
                     const std::function<void(const Record&)>& visit) {
  if (frames.empty()) return;
  const std::int64_t p = packet_frames(stored);
  for (std::int64_t block = frames.begin / p; block * p < frames.end; ++block) {
    Record record{.kind = RecordKind::packet,
                  .part = kAllJoints,
                  .block = static_cast<std::uint32_t>(block),
                  .frames = {block * p, std::min((block + 1) * p, stored.frames)}};
    if (!cut_by_joint(stored.mode)) {
      visit(record);
      continue;
    }
    const std::size_t count = joints.empty() ? stored.joints : joints.size();
    for (std::size_t i = 0; i < count; ++i) {
      record.part = static_cast<std::uint16_t>(joints.empty() ? static_cast<JointIndex>(i) : joints[i]);
      visit(record);
    }
  }
}

std::int64_t track_frames(std::size_t tracks) noexcept {
  constexpr std::size_t kPayload = 4 * kPageSize - kPageLoss - kHeaderSize;
  return static_cast<std::int64_t>(
      std::max<std::size_t>(1, kPayload / (sizeof(float) * std::max<std::size_t>(1, tracks))));
}

Width track_width(const StoredMotion& stored) noexcept {
  return {static_cast<std::uint16_t>(stored.tracks.size()), 0};
}

void for_each_track_record(const StoredMotion& stored, FrameRange frames,
                           const std::function<void(const Record&)>& visit) {
  if (frames.empty() || stored.tracks.empty()) return;
  const std::int64_t p = track_frames(stored.tracks.size());
  for (std::int64_t block = frames.begin / p; block * p < frames.end; ++block) {
    visit({.kind = RecordKind::tracks,
           .part = 0,
           .block = static_cast<std::uint32_t>(block),
           .frames = {block * p, std::min((block + 1) * p, stored.frames)}});
  }
}

std::uint64_t track_record_count(const StoredMotion& stored) noexcept {
  if (stored.tracks.empty()) return 0;
  const std::int64_t p = track_frames(stored.tracks.size());
  return static_cast<std::uint64_t>((stored.frames + p - 1) / p);
}

Bytes encode_skeleton(std::uint64_t generation, const Skeleton& skeleton) {
  ByteWriter out;
  out.number(static_cast<std::uint32_t>(skeleton.joint_count()));
  for (const Joint& joint : skeleton.joints()) {
    out.text(joint.name);
    out.number(static_cast<std::int32_t>(joint.parent));
    for (const float value : joint.offset) out.number(value);
    out.number(static_cast<std::uint8_t>(joint.translated ? 1 : 0));
  }
  out.number(static_cast<std::uint32_t>(skeleton.tips().size()));
  for (const Tip& tip : skeleton.tips()) {
    out.number(static_cast<std::int32_t>(tip.joint));
    for (const float value : tip.offset) out.number(value);
  }
  Bytes bytes = begin_record(generation, Record{}, {}, out.size());
  append(bytes, out.bytes());
  seal(bytes);
  return bytes;
}

Bytes encode_packet(std::uint64_t generation, const Motion& motion, const Record& packet, Packing packing) {
  const Width width = width_of(motion.skeleton(), packet);
  if (packing == Packing::compact) {
    const Bytes payload = pack(motion, packet);
    Bytes bytes = begin_record(generation, packet, {width, packing}, payload.size());
    append(bytes, payload);
    seal(bytes);
    return bytes;
  }
  Bytes bytes = begin_record(generation, packet, {width, packing}, value_size(packet, width) - kHeaderSize);
  const auto first = static_cast<std::size_t>(packet.frames.begin);
  const auto count = static_cast<std::size_t>(packet.frames.size());
  if (packet.part == kAllJoints) {
    append(bytes, std::as_bytes(motion.rotations().subspan(first * width.rotations, count * width.rotations)));
    append(bytes, std::as_bytes(motion.translations().subspan(first * width.translations, count * width.translations)));
  } else {
    const std::size_t joints = motion.skeleton().joint_count();
    for (std::size_t frame = first; frame < first + count; ++frame) {
      append(bytes, std::as_bytes(motion.rotations().subspan(frame * joints + packet.part, 1)));
    }
    if (const std::optional<std::size_t> at = motion.skeleton().translation_of(packet.part)) {
      const std::size_t translations = motion.skeleton().translation_count();
      for (std::size_t frame = first; frame < first + count; ++frame) {
        append(bytes, std::as_bytes(motion.translations().subspan(frame * translations + *at, 1)));
      }
    }
  }
  seal(bytes);
  return bytes;
}

Bytes encode_tracks(std::uint64_t generation, const std::vector<ScalarTrack>& tracks, const Record& record) {
  const Width width{static_cast<std::uint16_t>(tracks.size()), 0};
  Bytes bytes = begin_record(generation, record, {width, Packing::plain}, value_size(record, width) - kHeaderSize);
  for (const ScalarTrack& track : tracks) {
    append(bytes, std::as_bytes(std::span(track.values)
                                    .subspan(static_cast<std::size_t>(record.frames.begin),
                                             static_cast<std::size_t>(record.frames.size()))));
  }
  seal(bytes);
  return bytes;
}

const char* fault_of(ByteSpan value, std::uint64_t generation, const Record& record, std::optional<Width> width,
                     Packing packing) {
  if (value.size() < kHeaderSize) return "it is cut short";
  const Width stored_width{number_at<std::uint16_t>(value, 28), number_at<std::uint16_t>(value, 30)};
  if (!width) {
    if (stored_width.rotations != 1 || stored_width.translations > 1) return "its header is damaged";
    width = stored_width;
  }
  if (record.kind != RecordKind::skeleton && !can_have_size(record, {*width, packing}, value.size())) {
    return "its size is wrong";
  }
  if (number_at<std::uint64_t>(value, 0) != checksum(value.subspan(sizeof(std::uint64_t)))) {
    return "its checksum is wrong";
  }
  if (number_at<Packing>(value, 17) != packing) return "it has a layout that this version does not support";
  if (number_at<std::uint64_t>(value, 8) != generation || number_at<RecordKind>(value, 16) != record.kind ||
      number_at<std::uint16_t>(value, 18) != record.part ||
      number_at<std::uint32_t>(value, 20) != static_cast<std::uint32_t>(record.frames.begin) ||
      number_at<std::uint32_t>(value, 24) != static_cast<std::uint32_t>(record.frames.size()) ||
      stored_width != *width) {
    return "another record is in its place";
  }
  if (packing == Packing::compact) return compact_fault(value.subspan(kHeaderSize), record, *width);
  return nullptr;
}

Skeleton decode_skeleton(ByteSpan value, const std::string& where) {
  ByteReader in(value.subspan(kHeaderSize), where);
  const auto vector = [&] {
    const auto x = in.number<float>();
    const auto y = in.number<float>();
    const auto z = in.number<float>();
    return Eigen::Vector3f(x, y, z);
  };
  std::vector<Joint> joints(in.count(21));
  for (Joint& joint : joints) {
    joint.name = in.text();
    joint.parent = in.number<std::int32_t>();
    joint.offset = vector();
    joint.translated = in.number<std::uint8_t>() != 0;
  }
  std::vector<Tip> tips(in.count(16));
  for (Tip& tip : tips) {
    tip.joint = in.number<std::int32_t>();
    tip.offset = vector();
  }
  in.finish();
  try {
    return Skeleton(std::move(joints), std::move(tips));
  } catch (const Error& error) {
    in.fail(error.what());
  }
}

std::string name_of(const StoredMotion& stored, const Record& record, const Skeleton* skeleton) {
  std::string name = "stored motion " + std::to_string(stored.generation);
  if (record.kind == RecordKind::skeleton) return name + ", skeleton";
  if (record.kind == RecordKind::tracks) {
    name += ", scalar tracks";
  } else if (record.part == kAllJoints) {
    name += ", all joints";
  } else {
    name += ", joint " + std::to_string(record.part);
    if (skeleton) name += " (" + printable(skeleton->joint(record.part).name) + ')';
  }
  return name + ", frames [" + std::to_string(record.frames.begin) + ", " + std::to_string(record.frames.end) + ')';
}

}  // namespace signweave::motion_db
