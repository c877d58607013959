#include <algorithm>
#include <cstring>

#include "signweave/motion_db/motion_db.h"
#include "signweave/motion_db/packet.h"

namespace signweave::motion_db {

namespace {

/// A record that a read needs, borrowed from the snapshot.
struct Found {
  Record record;
  ByteSpan value;
};

[[noreturn]] void fail(const StoredMotion& stored, const Record& record, const Skeleton* skeleton, const char* fault) {
  throw Error(ErrorCode::corrupt, name_of(stored, record, skeleton) + ": " + fault +
                                      "; import the recording again or restore the database from a copy");
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

/// Copies the frames that a sound packet and `asked` share.
void copy_frames(const Found& packet, const Skeleton& skeleton, FrameRange asked, const JointSet& joints,
                 MutablePoses out) {
  const Width width = width_of(skeleton, packet.record);
  const FrameRange has = packet.record.frames;
  const FrameRange shared{std::max(has.begin, asked.begin), std::min(has.end, asked.end)};
  const auto from = static_cast<std::size_t>(shared.begin - has.begin);
  const auto to = static_cast<std::size_t>(shared.begin - asked.begin);
  const auto count = static_cast<std::size_t>(shared.size());
  const std::byte* const rotations = packet.value.data() + kHeaderSize;
  const std::byte* const translations = rotations + static_cast<std::size_t>(has.size()) * width.rotations * 16;
  auto* const out_rotations = reinterpret_cast<std::byte*>(out.rotations.data());
  auto* const out_translations = reinterpret_cast<std::byte*>(out.translations.data());
  const std::size_t joint_count = skeleton.joint_count();
  const std::size_t translation_count = skeleton.translation_count();

  if (packet.record.part == kAllJoints && joints.empty()) {
    std::memcpy(out_rotations + to * joint_count * 16, rotations + from * joint_count * 16, count * joint_count * 16);
    if (translation_count > 0) {
      std::memcpy(out_translations + to * translation_count * 12, translations + from * translation_count * 12,
                  count * translation_count * 12);
    }
    return;
  }
  const auto copy_joint = [&](JointIndex joint, std::size_t at) {
    const auto index = static_cast<std::size_t>(joint);
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(out_rotations + ((to + i) * joint_count + index) * 16,
                  rotations + ((from + i) * width.rotations + at) * 16, 16);
    }
    const std::optional<std::size_t> moved = skeleton.translation_of(joint);
    if (!moved) return;
    const std::size_t moved_at = packet.record.part == kAllJoints ? *moved : 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(out_translations + ((to + i) * translation_count + *moved) * 12,
                  translations + ((from + i) * width.translations + moved_at) * 12, 12);
    }
  };
  if (packet.record.part != kAllJoints) {
    copy_joint(packet.record.part, 0);
  } else {
    for (const JointIndex joint : joints) copy_joint(joint, static_cast<std::size_t>(joint));
  }
}

/// Copies the values that a sound record of the tracks and `asked` share; tracks whose span is empty are left out.
void copy_values(const Found& found, FrameRange asked, std::span<const std::span<float>> out) {
  const FrameRange has = found.record.frames;
  const FrameRange shared{std::max(has.begin, asked.begin), std::min(has.end, asked.end)};
  const auto length = static_cast<std::size_t>(has.size());
  const auto from = static_cast<std::size_t>(shared.begin - has.begin);
  for (std::size_t track = 0; track < out.size(); ++track) {
    if (out[track].empty()) continue;
    std::memcpy(out[track].data() + (shared.begin - asked.begin),
                found.value.data() + kHeaderSize + (track * length + from) * sizeof(float),
                static_cast<std::size_t>(shared.size()) * sizeof(float));
  }
}

/// The values of some frames of all tracks; sizes were checked when the records were found.
std::vector<ScalarTrack> tracks_of(const StoredMotion& stored, FrameRange asked, std::span<const Found> records) {
  std::vector<ScalarTrack> tracks;
  std::vector<std::span<float>> values;
  tracks.reserve(stored.tracks.size());
  for (const std::string& name : stored.tracks) {
    tracks.push_back({name, std::vector<float>(static_cast<std::size_t>(asked.size()))});
    values.emplace_back(tracks.back().values);
  }
  for (const Found& found : records) {
    if (const char* fault = fault_of(found.value, stored.generation, found.record, track_width(stored))) {
      fail(stored, found.record, nullptr, fault);
    }
    copy_values(found, asked, values);
  }
  return tracks;
}

}  // namespace

std::shared_ptr<const Skeleton> read_skeleton(const kv::ReadTransaction& snapshot, const StoredMotion& stored) {
  const std::optional<ByteSpan> value = snapshot.get(key_of(stored.generation, Record{}));
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
  // First find everything, with its size, so that a damaged descriptor cannot ask for memory that no record backs.
  ReadCost spent;
  const auto find = [&](const Record& record, Width width) {
    const std::optional<ByteSpan> value = snapshot.get(key_of(stored.generation, record));
    if (!value) fail(stored, record, skeleton.get(), "it is missing");
    if (value->size() != value_size(record, width)) fail(stored, record, skeleton.get(), "its size is wrong");
    spent.bytes += value->size();
    return Found{record, *value};
  };
  std::vector<Found> packets;
  for_each_packet(stored, frames, joints,
                  [&](const Record& record) { packets.push_back(find(record, width_of(*skeleton, record))); });
  spent.packets = packets.size();
  std::vector<Found> track_records;
  if (joints.empty()) {
    for_each_track_record(stored, frames,
                          [&](const Record& record) { track_records.push_back(find(record, track_width(stored))); });
  }

  Motion result(skeleton, stored.rate, frames.size());
  for (const Found& packet : packets) {
    if (const char* fault =
            fault_of(packet.value, stored.generation, packet.record, width_of(*skeleton, packet.record))) {
      fail(stored, packet.record, skeleton.get(), fault);
    }
    copy_frames(packet, *skeleton, frames, joints, result.poses({0, frames.size()}));
  }
  if (joints.empty()) {
    for (ScalarTrack& track : tracks_of(stored, frames, track_records)) result.add_track(std::move(track));
  }
  if (cost) *cost = spent;
  return result;
}

namespace {

/// So many records are remembered at most, 16 MiB of bits: the descriptor's counts are believed no further.
constexpr std::uint64_t kMostKnown = std::uint64_t{1} << 27;

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
  const StoredMotion& stored = motion_->stored();
  const Skeleton& skeleton = *motion_->skeleton();
  check_asked(stored, skeleton, frames, {});
  const std::uint64_t parts = cut_by_joint(stored.mode) ? stored.joints : 1;
  for_each_packet(stored, frames, {}, [&](const Record& record) {
    const Width width = width_of(skeleton, record);
    const std::optional<ByteSpan> value = snapshot_->get(key_of(stored.generation, record));
    if (!value) fail(stored, record, &skeleton, "it is missing");
    if (value->size() != value_size(record, width)) fail(stored, record, &skeleton, "its size is wrong");
    const std::uint64_t number = record.block * parts + (parts > 1 ? record.part : 0);
    verify(record, *value, width, number);
    copy_frames({record, *value}, skeleton, frames, {}, out);
  });
}

void StoredSource::read_tracks(FrameRange frames, std::span<const std::span<float>> out) const {
  const StoredMotion& stored = motion_->stored();
  check_asked(stored, *motion_->skeleton(), frames, {});
  const Width width = track_width(stored);
  const std::uint64_t packets = packet_count(stored);
  for_each_track_record(stored, frames, [&](const Record& record) {
    const std::optional<ByteSpan> value = snapshot_->get(key_of(stored.generation, record));
    if (!value) fail(stored, record, nullptr, "it is missing");
    if (value->size() != value_size(record, width)) fail(stored, record, nullptr, "its size is wrong");
    verify(record, *value, width, packets + record.block);
    copy_values({record, *value}, frames, out);
  });
}

void StoredSource::verify(const Record& record, ByteSpan value, Width width, std::uint64_t number) const {
  if (motion_->is_sound(number)) return;
  if (const char* fault = fault_of(value, motion_->stored().generation, record, width)) {
    fail(motion_->stored(), record, motion_->skeleton().get(), fault);
  }
  motion_->found_sound(number);
}

namespace {

/// So many faults of one motion are named: nobody reads more, and a damaged descriptor may tell of a billion packets.
constexpr std::size_t kMostFaults = 1000;
struct TooMany {};

}  // namespace

std::vector<std::string> check(const kv::ReadTransaction& snapshot, const StoredMotion& stored) {
  std::vector<std::string> faults;
  std::shared_ptr<const Skeleton> skeleton;
  try {
    skeleton = read_skeleton(snapshot, stored);
  } catch (const Error& error) {
    faults.emplace_back(error.what());
  }
  const auto check_record = [&](const Record& record, std::optional<Width> width) {
    if (faults.size() >= kMostFaults) throw TooMany{};
    const std::optional<ByteSpan> value = snapshot.get(key_of(stored.generation, record));
    const char* const fault = value ? fault_of(*value, stored.generation, record, width) : "it is missing";
    if (fault) faults.push_back(name_of(stored, record, skeleton.get()) + ": " + fault);
  };
  try {
    for_each_packet(stored, {0, stored.frames}, {}, [&](const Record& record) {
      std::optional<Width> width;
      if (record.part == kAllJoints) {
        width = {static_cast<std::uint16_t>(stored.joints), static_cast<std::uint16_t>(stored.translations)};
      } else if (skeleton) {
        width = width_of(*skeleton, record);
      }
      check_record(record, width);
    });
    for_each_track_record(stored, {0, stored.frames},
                          [&](const Record& record) { check_record(record, track_width(stored)); });
  } catch (const TooMany&) {
    faults.push_back("stored motion " + std::to_string(stored.generation) + ": more faults than these");
  }
  return faults;
}

}  // namespace signweave::motion_db
