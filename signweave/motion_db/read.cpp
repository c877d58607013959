#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

#include "signweave/motion_db/copy.h"
#include "signweave/motion_db/motion_db.h"
#include "signweave/motion_db/packet.h"

namespace signweave::motion_db {

namespace {

/// Where a read looks: one stored motion in one snapshot.
struct Place {
  const kv::ReadTransaction& snapshot;
  const StoredMotion& stored;
  const Skeleton& skeleton;
};

/// What is asked for is allocated at once up to here; what is larger must be seen to be there first.
constexpr std::uint64_t kMostUnseen = std::uint64_t{64} << 20;
/// Of a large motion every so many-th record is looked for before memory is given.
constexpr std::uint64_t kSampled = 16;

[[noreturn]] void fail(const StoredMotion& stored, const Record& record, const Skeleton* skeleton, const char* fault) {
  throw Error(ErrorCode::corrupt,
              name_of(stored, record, skeleton) + ": " + fault +
                  "; import the recording again or restore the database from a copy",
              {{"replace_motion", "true"}});
}

/// The value of a record; a fault of the engine says which record it met it in.
std::optional<ByteSpan> get(const kv::ReadTransaction& snapshot, const StoredMotion& stored, const Record& record,
                            const Skeleton* skeleton, Bytes& buffer) {
  try {
    return snapshot.get(key_of(stored.generation, record), buffer);
  } catch (const Error& error) {
    throw Error(error.code(), name_of(stored, record, skeleton) + ": " + error.what(), error.remedies());
  }
}

/// Refuses what the motion does not have: frames and joints come from a user.
void check_asked(const StoredMotion& stored, const Skeleton& skeleton, FrameRange frames, const JointSet& joints) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::bad_input, "stored motion " + std::to_string(stored.generation) + ": " + what);
  };
  if (skeleton.joint_count() != stored.joints || skeleton.translation_count() != stored.translations) {
    refuse("read with the skeleton of another motion; use the one that read_skeleton gives");
  }
  if (frames.begin < 0 || frames.end < frames.begin || frames.end > stored.frames) {
    refuse("frames [" + std::to_string(frames.begin) + ", " + std::to_string(frames.end) +
           ") were asked for; ask for some of [0, " + std::to_string(stored.frames) + ")");
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i] < 0 || joints[i] >= static_cast<JointIndex>(stored.joints) || (i > 0 && joints[i] <= joints[i - 1])) {
      refuse("a joint set must name joints 0 to " + std::to_string(stored.joints - 1) + ", ascending");
    }
  }
}

/// How the packets of a motion lie in their records.
Layout layout_of(const Place& place, const Record& packet) {
  return {width_of(place.skeleton, packet), packing_of(place.stored)};
}

/// A read takes three steps with a record: find it, verify it, copy what is asked for (copy.h).
///
/// The first: the value of a record, which has the right size.
Found find(const Place& place, const Record& record, Layout layout, Bytes& buffer) {
  const std::optional<ByteSpan> value = get(place.snapshot, place.stored, record, &place.skeleton, buffer);
  if (!value) fail(place.stored, record, &place.skeleton, "it is missing");
  if (!can_have_size(record, layout, value->size())) fail(place.stored, record, &place.skeleton, "its size is wrong");
  return {record, layout, *value};
}

/// The second: throws unless the record is sound.
void verify(const Place& place, const Found& found) {
  if (const char* fault = fault_of(found.value, place.stored.generation, found.record, found.layout)) {
    fail(place.stored, found.record, &place.skeleton, fault);
  }
}

/// The same, once for all who share `known`.
void verify_once(const KnownMotion& known, const Place& place, const Found& found) {
  const StoredMotion& stored = place.stored;
  const std::uint64_t block = found.record.block;
  const std::uint64_t number = found.record.kind == RecordKind::tracks ? packet_count(stored) + block
                               : cut_by_joint(stored.mode)             ? block * stored.joints + found.record.part
                                                                       : block;
  if (known.is_sound(number)) return;
  verify(place, found);
  known.found_sound(number);
}

/// Finds the packets that hold some frames of some joints by `find_packet`, up to kTogether joints of a block at a
/// time, and gives each such group to `use`, whose spans end with the call.
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

/// A damaged descriptor may tell of more than was ever stored: before much memory is given, some of the records that
/// `for_each` visits are looked for, the last among them.
template <typename ForEach, typename LayoutOf>
void check_backed(const Place& place, std::uint64_t bytes, const ForEach& for_each, const LayoutOf& layout) {
  if (bytes <= kMostUnseen) return;
  Bytes buffer;
  std::uint64_t visited = 0;
  Record last;
  const auto visit = [&](const Record& record) {
    last = record;
    if (visited++ % kSampled == 0) find(place, record, layout(record), buffer);
  };
  for_each(std::ref(visit));
  if (visited > 0) find(place, last, layout(last), buffer);
}

/// Poses yet to be written, or at rest where only some joints will be.
Motion allocate(const Place& place, const std::shared_ptr<const Skeleton>& skeleton, FrameRange frames,
                const JointSet& joints) {
  const StoredMotion& stored = place.stored;
  const auto count = static_cast<std::uint64_t>(frames.size());
  check_backed(
      place, count * (std::uint64_t{stored.joints} * 16 + std::uint64_t{stored.translations} * 12),
      [&](const auto& visit) { for_each_packet(stored, frames, joints, visit); },
      [&](const Record& record) { return layout_of(place, record); });
  if (!joints.empty()) return Motion(skeleton, stored.rate, frames.size());
  Motion result;
  result.reset(skeleton, stored.rate, frames.size());
  return result;
}

/// The values of some frames of all tracks.
std::vector<ScalarTrack> read_all_tracks(const Place& place, FrameRange asked, Bytes& buffer, ReadCost& spent) {
  const StoredMotion& stored = place.stored;
  const Layout layout{track_width(stored)};
  check_backed(
      place, static_cast<std::uint64_t>(asked.size()) * stored.tracks.size() * sizeof(float),
      [&](const auto& visit) { for_each_track_record(stored, asked, visit); }, [&](const Record&) { return layout; });
  std::vector<ScalarTrack> tracks;
  std::vector<std::span<float>> values;
  tracks.reserve(stored.tracks.size());
  values.reserve(stored.tracks.size());
  for (const std::string& name : stored.tracks) {
    tracks.push_back({name, std::vector<float>(static_cast<std::size_t>(asked.size()))});
    values.emplace_back(tracks.back().values);
  }
  const auto visit = [&](const Record& record) {
    const Found found = find(place, record, layout, buffer);
    verify(place, found);
    copy_values(found, asked, values);
    spent.bytes += found.value.size();
  };
  for_each_track_record(stored, asked, std::ref(visit));
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
  check_asked(stored, *skeleton, frames, joints);
  const Place place{snapshot, stored, *skeleton};
  ReadCost spent;
  Motion result = allocate(place, skeleton, frames, joints);
  const MutablePoses poses = result.poses({0, frames.size()});
  std::vector<Bytes> buffers(kTogether);
  const auto find_packet = [&](const Record& record, Bytes& buffer) {
    const Found packet = find(place, record, layout_of(place, record), buffer);
    verify(place, packet);
    ++spent.packets;
    spent.bytes += packet.value.size();
    return packet;
  };
  for_each_group(stored, frames, joints, buffers, find_packet,
                 [&](std::span<const Found> group) { copy_group(group, *skeleton, joints, frames, poses); });
  if (joints.empty()) {
    for (ScalarTrack& track : read_all_tracks(place, frames, buffers[0], spent)) result.add_track(std::move(track));
  }
  if (cost) *cost = spent;
  return result;
}

namespace {

/// So many records are remembered at most, 16 MiB of bits: the descriptor's counts are believed no further.
constexpr std::uint64_t kMostKnown = std::uint64_t{1} << 27;

/// And the places of so many packets, 1 MiB: hours by frame, where p is the default.
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

void KnownMotion::found_sound(std::uint64_t record) const noexcept {
  if (record / 64 >= sound_.size()) return;
  sound_[record / 64].fetch_or(std::uint64_t{1} << (record % 64), std::memory_order_relaxed);
}

void StoredSource::read(FrameRange frames, MutablePoses out) const {
  const Place place{*snapshot_, motion_->stored(), *motion_->skeleton()};
  check_asked(place.stored, place.skeleton, frames, {});
  const auto find_packet = [&](const Record& record, Bytes& buffer) {
    const Layout layout = layout_of(place, record);
    if (record.block < places_.size() && !places_[record.block].empty())
      return Found{record, layout, places_[record.block]};
    const Found packet = find(place, record, layout, buffer);
    verify_once(*motion_, place, packet);
    remember(record, packet.value, buffer);
    return packet;
  };
  for_each_group(place.stored, frames, {}, buffers_, find_packet,
                 [&](std::span<const Found> group) { copy_group(group, place.skeleton, {}, frames, out); });
}

// Looking up the packet of a frame costs more than copying the frame. Of packets of one joint there are too many.
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
  const Place place{*snapshot_, motion_->stored(), *motion_->skeleton()};
  check_asked(place.stored, place.skeleton, frames, {});
  buffers_.resize(kTogether);
  const auto visit = [&](const Record& record) {
    const Found found = find(place, record, {track_width(place.stored)}, buffers_[0]);
    verify_once(*motion_, place, found);
    copy_values(found, frames, out);
  };
  for_each_track_record(place.stored, frames, std::ref(visit));
}

namespace {

/// So many faults of one motion are named: nobody reads more, and a damaged descriptor may tell of a billion packets.
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
    } catch (const Error& error) {  // the engine's own pages: what lies elsewhere may be sound
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
    faults.push_back("stored motion " + std::to_string(stored.generation) + ": more faults than these");
  }
  return faults;
}

}  // namespace signweave::motion_db
