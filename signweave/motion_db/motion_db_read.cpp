#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

#include "signweave/motion_db/copy.h"
#include "signweave/motion_db/motion_db.h"
#include "signweave/motion_db/packet.h"

namespace signweave::motion_db {

namespace {

/// The context of a read: one stored motion in one snapshot.
struct ReadContext {
  const kv::ReadTransaction& snapshot;
  const StoredMotion& stored;
  const Skeleton& skeleton;
};

/// Requests up to this size (bytes) are allocated at once; larger ones only if the records exist.
constexpr std::uint64_t kMostUnchecked = std::uint64_t{64} << 20;
/// For a large request, every kSampled-th record is looked up before memory is allocated.
constexpr std::uint64_t kSampled = 16;

[[noreturn]] void fail(const StoredMotion& stored, const Record& record, const Skeleton* skeleton, const char* fault) {
  throw Error(ErrorCode::corrupt,
              name_of(stored, record, skeleton) + ": " + fault +
                  "; import the recording again or restore the database from a copy",
              {{"replace_motion", "true"}});
}

/// Reads the value of a record; an error of the engine is extended by the name of the record.
std::optional<ByteSpan> get(const kv::ReadTransaction& snapshot, const StoredMotion& stored, const Record& record,
                            const Skeleton* skeleton, Bytes& buffer) {
  try {
    return snapshot.get(key_of(stored.generation, record), buffer);
  } catch (const Error& error) {
    throw Error(error.code(), name_of(stored, record, skeleton) + ": " + error.what(), error.remedies());
  }
}

/// Rejects frames and joints that the motion does not have: they come from a user.
void check_request(const StoredMotion& stored, const Skeleton& skeleton, FrameRange frames, const JointSet& joints) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::bad_input, "stored motion " + std::to_string(stored.generation) + ": " + what);
  };
  if (skeleton.joint_count() != stored.joints || skeleton.translation_count() != stored.translations) {
    refuse("read with the skeleton of another motion; use the one that read_skeleton gives");
  }
  if (frames.begin < 0 || frames.end < frames.begin || frames.end > stored.frames) {
    refuse("frames [" + std::to_string(frames.begin) + ", " + std::to_string(frames.end) +
           ") were requested; request some of [0, " + std::to_string(stored.frames) + ")");
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i] < 0 || joints[i] >= static_cast<JointIndex>(stored.joints) || (i > 0 && joints[i] <= joints[i - 1])) {
      refuse("a joint set must name joints 0 to " + std::to_string(stored.joints - 1) + ", ascending");
    }
  }
}

/// The layout of a packet's record.
RecordLayout layout_of(const ReadContext& context, const Record& packet) {
  return {width_of(context.skeleton, packet), packing_of(context.stored)};
}

/// A read takes three steps per record: find it, verify it, copy the requested part (copy.h).
///
/// The first step returns the value of a record, which has the right size.
Found find(const ReadContext& context, const Record& record, RecordLayout layout, Bytes& buffer) {
  const std::optional<ByteSpan> value = get(context.snapshot, context.stored, record, &context.skeleton, buffer);
  if (!value) fail(context.stored, record, &context.skeleton, "it is missing");
  if (!can_have_size(record, layout, value->size()))
    fail(context.stored, record, &context.skeleton, "its size is wrong");
  return {record, layout, *value};
}

/// The second step throws unless the record is valid.
void verify(const ReadContext& context, const Found& found) {
  if (const char* fault = fault_of(found.value, context.stored.generation, found.record, found.layout)) {
    fail(context.stored, found.record, &context.skeleton, fault);
  }
}

/// The same, only once for all users of `known`.
void verify_once(const KnownMotion& known, const ReadContext& context, const Found& found) {
  const StoredMotion& stored = context.stored;
  const std::uint64_t block = found.record.block;
  const std::uint64_t number = found.record.kind == RecordKind::tracks ? packet_count(stored) + block
                               : cut_by_joint(stored.mode)             ? block * stored.joints + found.record.part
                                                                       : block;
  if (known.is_sound(number)) return;
  verify(context, found);
  known.mark_sound(number);
}

/// Finds the packets that contain some frames of some joints with `find_packet`, up to kTogether joints of a block at a
/// time, and passes each such group to `use`. The spans are valid during that call.
template <typename FindPacket, typename Use>
void for_each_group(const StoredMotion& stored, FrameRange frames, const JointSet& joints, std::vector<Bytes>& buffers,
                    const FindPacket& find_packet, const Use& use) {
  buffers.resize(kTogether);
  std::array<Found, kTogether> group;
  std::size_t count = 0;
  const auto visit = [&](const Record& record) {
    if (count == kTogether || (count > 0 && group[0].record.block != record.block)) {
      use(std::span<const Found>(group.data(), count));
      count = 0;
    }
    group[count] = find_packet(record, buffers[count]);
    ++count;
  };
  for_each_packet(stored, frames, joints, std::ref(visit));
  if (count > 0) use(std::span<const Found>(group.data(), count));
}

/// A damaged descriptor may claim more than was ever stored: before much memory is allocated, a sample of the records
/// that `for_each` visits is looked up, including the last one.
template <typename ForEach, typename LayoutOf>
void check_stored(const ReadContext& context, std::uint64_t bytes, const ForEach& for_each, const LayoutOf& layout) {
  if (bytes <= kMostUnchecked) return;
  Bytes buffer;
  std::uint64_t visited = 0;
  Record last;
  const auto visit = [&](const Record& record) {
    last = record;
    if (visited++ % kSampled == 0) find(context, record, layout(record), buffer);
  };
  for_each(std::ref(visit));
  if (visited > 0) find(context, last, layout(last), buffer);
}

/// Allocates poses, which are rest poses if only some joints will be read, otherwise unspecified.
Motion allocate(const ReadContext& context, const std::shared_ptr<const Skeleton>& skeleton, FrameRange frames,
                const JointSet& joints) {
  const StoredMotion& stored = context.stored;
  const auto count = static_cast<std::uint64_t>(frames.size());
  check_stored(
      context, count * (std::uint64_t{stored.joints} * 16 + std::uint64_t{stored.translations} * 12),
      [&](const auto& visit) { for_each_packet(stored, frames, joints, visit); },
      [&](const Record& record) { return layout_of(context, record); });
  if (!joints.empty()) return Motion(skeleton, stored.rate, frames.size());
  Motion result;
  result.reset(skeleton, stored.rate, frames.size());
  return result;
}

/// Reads some frames of all tracks.
std::vector<ScalarTrack> read_all_tracks(const ReadContext& context, FrameRange requested, Bytes& buffer,
                                         ReadCost& spent) {
  const StoredMotion& stored = context.stored;
  const RecordLayout layout{track_width(stored)};
  check_stored(
      context, static_cast<std::uint64_t>(requested.size()) * stored.tracks.size() * sizeof(float),
      [&](const auto& visit) { for_each_track_record(stored, requested, visit); },
      [&](const Record&) { return layout; });
  std::vector<ScalarTrack> tracks;
  std::vector<std::span<float>> values;
  tracks.reserve(stored.tracks.size());
  values.reserve(stored.tracks.size());
  for (const std::string& name : stored.tracks) {
    tracks.push_back({name, std::vector<float>(static_cast<std::size_t>(requested.size()))});
    values.emplace_back(tracks.back().values);
  }
  const auto visit = [&](const Record& record) {
    const Found found = find(context, record, layout, buffer);
    verify(context, found);
    copy_values(found, requested, values);
    spent.bytes += found.value.size();
  };
  for_each_track_record(stored, requested, std::ref(visit));
  return tracks;
}

}  // namespace

std::shared_ptr<const Skeleton> read_skeleton(const kv::ReadTransaction& snapshot, const StoredMotion& stored) {
  Bytes buffer;
  const std::optional<ByteSpan> value = get(snapshot, stored, Record{}, nullptr, buffer);
  if (!value) fail(stored, Record{}, nullptr, "it is missing");
  if (const char* fault = fault_of(*value, stored.generation, Record{}, Width{})) {
    fail(stored, Record{}, nullptr, fault);
  }
  auto skeleton = std::make_shared<const Skeleton>(decode_skeleton(*value, name_of(stored, Record{}, nullptr)));
  if (skeleton->joint_count() != stored.joints || skeleton->translation_count() != stored.translations) {
    fail(stored, Record{}, nullptr, "it has other joints than the motion");
  }
  return skeleton;
}

Motion read(const kv::ReadTransaction& snapshot, const StoredMotion& stored,
            const std::shared_ptr<const Skeleton>& skeleton, FrameRange frames, const JointSet& joints,
            ReadCost* cost) {
  check_request(stored, *skeleton, frames, joints);
  const ReadContext context{snapshot, stored, *skeleton};
  ReadCost spent;
  Motion result = allocate(context, skeleton, frames, joints);
  const MutablePoses poses = result.poses({0, frames.size()});
  std::vector<Bytes> buffers(kTogether);
  const auto find_packet = [&](const Record& record, Bytes& buffer) {
    const Found packet = find(context, record, layout_of(context, record), buffer);
    verify(context, packet);
    ++spent.packets;
    spent.bytes += packet.value.size();
    return packet;
  };
  for_each_group(stored, frames, joints, buffers, find_packet,
                 [&](std::span<const Found> group) { copy_group(group, *skeleton, joints, frames, poses); });
  if (joints.empty()) {
    for (ScalarTrack& track : read_all_tracks(context, frames, buffers[0], spent)) result.add_track(std::move(track));
  }
  if (cost) *cost = spent;
  return result;
}

namespace {

/// The largest number of records that are remembered, 16 MiB of bits: a limit to the trust in the descriptor's counts.
constexpr std::uint64_t kMostKnown = std::uint64_t{1} << 27;

/// The largest number of packets whose places are remembered, 1 MiB: hours with one packet per frame block and the
/// default p.
constexpr std::uint64_t kMostPlaces = std::uint64_t{1} << 16;

}  // namespace

KnownMotion::KnownMotion(const kv::ReadTransaction& snapshot, StoredMotion stored)
    : stored_(std::move(stored)),
      skeleton_(read_skeleton(snapshot, stored_)),
      sound_((std::min(packet_count(stored_) + track_record_count(stored_), kMostKnown) + 63) / 64) {}

bool KnownMotion::is_sound(std::uint64_t record) const noexcept {
  if (record / 64 >= sound_.size()) return false;
  return (sound_[record / 64].load(std::memory_order_relaxed) >> (record % 64) & 1) != 0;
}

void KnownMotion::mark_sound(std::uint64_t record) const noexcept {
  if (record / 64 >= sound_.size()) return;
  sound_[record / 64].fetch_or(std::uint64_t{1} << (record % 64), std::memory_order_relaxed);
}

void StoredSource::read(FrameRange frames, MutablePoses out) const {
  const ReadContext context{*snapshot_, motion_->stored(), *motion_->skeleton()};
  check_request(context.stored, context.skeleton, frames, {});
  const auto find_packet = [&](const Record& record, Bytes& buffer) {
    const RecordLayout layout = layout_of(context, record);
    if (record.block < places_.size() && !places_[record.block].empty())
      return Found{record, layout, places_[record.block]};
    const Found packet = find(context, record, layout, buffer);
    verify_once(*motion_, context, packet);
    remember(record, packet.value, buffer);
    return packet;
  };
  for_each_group(context.stored, frames, {}, buffers_, find_packet,
                 [&](std::span<const Found> group) { copy_group(group, context.skeleton, {}, frames, out); });
}

// Looking up the packet of a frame costs more than copying the frame. Packets of one joint are too many to remember.
void StoredSource::remember(const Record& packet, ByteSpan value, const Bytes& buffer) const {
  if (packet.part != kAllJoints || value.data() == buffer.data()) return;
  if (places_.empty()) {
    const std::uint64_t packets = packet_count(motion_->stored());
    if (packets > kMostPlaces) return;
    places_.resize(packets);
  }
  places_[packet.block] = value;
}

void StoredSource::read_tracks(FrameRange frames, std::span<const std::span<float>> out) const {
  const ReadContext context{*snapshot_, motion_->stored(), *motion_->skeleton()};
  check_request(context.stored, context.skeleton, frames, {});
  buffers_.resize(kTogether);
  const auto visit = [&](const Record& record) {
    const Found found = find(context, record, {track_width(context.stored)}, buffers_[0]);
    verify_once(*motion_, context, found);
    copy_values(found, frames, out);
  };
  for_each_track_record(context.stored, frames, std::ref(visit));
}

namespace {

/// The largest number of faults listed for one motion: more are not readable, and a damaged descriptor may claim a
/// billion packets.
constexpr std::size_t kMostFaults = 1000;
struct TooMany {};

}  // namespace

std::vector<std::string> check(const kv::ReadTransaction& snapshot, const StoredMotion& stored,
                               const std::function<void()>& progress) {
  constexpr std::uint64_t kRecordsATime = 64;
  std::uint64_t checked = 0;
  std::vector<std::string> faults;
  std::shared_ptr<const Skeleton> skeleton;
  try {
    skeleton = read_skeleton(snapshot, stored);
  } catch (const Error& error) {
    faults.emplace_back(error.what());
  }
  Bytes buffer;
  const auto check_record = [&](const Record& record, std::optional<Width> width, Packing packing) {
    if (faults.size() >= kMostFaults) throw TooMany{};
    if (progress && ++checked % kRecordsATime == 0) progress();
    try {
      const std::optional<ByteSpan> value = get(snapshot, stored, record, skeleton.get(), buffer);
      const char* const fault = value ? fault_of(*value, stored.generation, record, width, packing) : "it is missing";
      if (fault) faults.push_back(name_of(stored, record, skeleton.get()) + ": " + fault);
    } catch (const Error& error) {  // damaged pages of the engine: other records may be valid
      faults.emplace_back(error.what());
    }
  };
  try {
    for_each_packet(stored, {0, stored.frames}, {}, [&](const Record& record) {
      std::optional<Width> width;
      if (record.part == kAllJoints) {
        width = {static_cast<std::uint16_t>(stored.joints), static_cast<std::uint16_t>(stored.translations)};
      } else if (skeleton) {
        width = width_of(*skeleton, record);
      }
      check_record(record, width, packing_of(stored));
    });
    for_each_track_record(stored, {0, stored.frames},
                          [&](const Record& record) { check_record(record, track_width(stored), Packing::plain); });
  } catch (const TooMany&) {
    faults.push_back("stored motion " + std::to_string(stored.generation) + ": more faults than listed");
  }
  return faults;
}

}  // namespace signweave::motion_db
