#include "signweave/motion_db/copy.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "signweave/motion_db/compact.h"

namespace signweave::motion_db {

namespace {

/// The frames that a record and a request have in common.
struct SharedFrames {
  std::size_t from = 0;  ///< first, counted in the record
  std::size_t to = 0;    ///< first, counted in the request
  std::size_t count = 0;
};

SharedFrames shared_frames(FrameRange has, FrameRange requested) {
  const FrameRange both{std::max(has.begin, requested.begin), std::min(has.end, requested.end)};
  return {static_cast<std::size_t>(both.begin - has.begin), static_cast<std::size_t>(both.begin - requested.begin),
          static_cast<std::size_t>(both.size())};
}

constexpr std::size_t kRotation = sizeof(Eigen::Quaternionf);
constexpr std::size_t kTranslation = sizeof(Eigen::Vector3f);

/// The two parts of a packet's payload.
const std::byte* rotations_of(const Found& packet) {
  return packet.value.data() + kHeaderSize;
}
const std::byte* translations_of(const Found& packet) {
  return rotations_of(packet) +
         static_cast<std::size_t>(packet.record.frames.size()) * packet.layout.width.rotations * kRotation;
}

/// Copies the requested frames from a packet of all joints.
void copy_all_joints(const Found& packet, FrameRange requested, MutablePoses out) {
  const SharedFrames shared = shared_frames(packet.record.frames, requested);
  const auto copy = [&](std::span<std::byte> to, const std::byte* from, std::size_t step) {
    if (step > 0) std::memcpy(to.data() + shared.to * step, from + shared.from * step, shared.count * step);
  };
  copy(std::as_writable_bytes(out.rotations), rotations_of(packet), packet.layout.width.rotations * kRotation);
  copy(std::as_writable_bytes(out.translations), translations_of(packet),
       packet.layout.width.translations * kTranslation);
}

/// The same for some joints of a packet of all joints: consecutive joints at once.
void copy_some_joints(const Found& packet, const Skeleton& skeleton, const JointSet& joints, FrameRange requested,
                      MutablePoses out) {
  const SharedFrames shared = shared_frames(packet.record.frames, requested);
  const auto copy = [&](std::span<std::byte> to, const std::byte* from, std::size_t step, std::size_t at,
                        std::size_t size) {
    for (std::size_t i = 0; i < shared.count; ++i) {
      std::memcpy(to.data() + (shared.to + i) * step + at, from + (shared.from + i) * step + at, size);
    }
  };
  for (std::size_t first = 0, last = 0; first < joints.size(); first = last + 1) {
    for (last = first; last + 1 < joints.size() && joints[last + 1] == joints[last] + 1;) ++last;
    copy(std::as_writable_bytes(out.rotations), rotations_of(packet), packet.layout.width.rotations * kRotation,
         static_cast<std::size_t>(joints[first]) * kRotation, (last + 1 - first) * kRotation);
  }
  for (const JointIndex joint : joints) {
    if (const std::optional<std::size_t> moved = skeleton.translation_of(joint)) {
      copy(std::as_writable_bytes(out.translations), translations_of(packet),
           packet.layout.width.translations * kTranslation, *moved * kTranslation, kTranslation);
    }
  }
}

/// A value per frame to be copied: where the first one is. In a packet of one joint they are contiguous.
struct Column {
  const std::byte* from = nullptr;
  std::byte* to = nullptr;
};

template <std::size_t kSize>
void copy_columns(std::span<const Column> columns, std::size_t to_step, std::size_t frames) {
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (const Column& column : columns) {
      std::memcpy(column.to + frame * to_step, column.from + frame * kSize, kSize);
    }
  }
}

/// Copies packets of one joint each over the same frames.
void copy_joints(std::span<const Found> group, const Skeleton& skeleton, FrameRange requested, MutablePoses out) {
  const SharedFrames shared = shared_frames(group[0].record.frames, requested);
  const std::size_t rotation_step = skeleton.joint_count() * kRotation;
  const std::size_t translation_step = skeleton.translation_count() * kTranslation;
  std::byte* const rotations = std::as_writable_bytes(out.rotations).data() + shared.to * rotation_step;
  std::byte* const translations = std::as_writable_bytes(out.translations).data() + shared.to * translation_step;
  std::array<Column, kTogether> turned, moved;
  std::size_t moved_count = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::uint16_t joint = group[i].record.part;
    turned[i] = {rotations_of(group[i]) + shared.from * kRotation, rotations + joint * kRotation};
    if (const std::optional<std::size_t> at = skeleton.translation_of(joint)) {
      moved[moved_count++] = {translations_of(group[i]) + shared.from * kTranslation,
                              translations + *at * kTranslation};
    }
  }
  copy_columns<kRotation>(std::span(turned).first(group.size()), rotation_step, shared.count);
  copy_columns<kTranslation>(std::span(moved).first(moved_count), translation_step, shared.count);
}

}  // namespace

void copy_group(std::span<const Found> group, const Skeleton& skeleton, const JointSet& joints, FrameRange requested,
                MutablePoses out) {
  if (group[0].layout.packing == Packing::compact) {
    for (const Found& packet : group) {
      unpack(packet.value.subspan(kHeaderSize), packet.record, skeleton, requested, joints, out);
    }
  } else if (group[0].record.part != kAllJoints) {
    copy_joints(group, skeleton, requested, out);
  } else if (joints.empty()) {
    copy_all_joints(group[0], requested, out);
  } else {
    copy_some_joints(group[0], skeleton, joints, requested, out);
  }
}

void copy_values(const Found& found, FrameRange requested, std::span<const std::span<float>> out) {
  const SharedFrames shared = shared_frames(found.record.frames, requested);
  const auto length = static_cast<std::size_t>(found.record.frames.size());
  for (std::size_t track = 0; track < out.size(); ++track) {
    if (out[track].empty()) continue;
    std::memcpy(out[track].data() + shared.to,
                found.value.data() + kHeaderSize + (track * length + shared.from) * sizeof(float),
                shared.count * sizeof(float));
  }
}

}  // namespace signweave::motion_db
