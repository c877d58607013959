// Unpacking. All joints of a packet are unpacked four at a time with vectors of four; some joints, or a packet of one
// joint, number by number. Both give the same bits (compact_test.cpp), because both compute as `restored` does.

#include <algorithm>

#include "signweave/motion_db/compact.h"
#include "signweave/motion_db/compact_layout.h"
#include "signweave/motion_db/unpack_four.h"

namespace signweave::motion_db {

namespace {

/// Reads one number of the stream.
std::uint32_t number_in(const std::byte* stream, std::size_t lane, std::uint64_t bit, std::uint32_t width) noexcept {
  const std::byte* const at = stream + (static_cast<std::size_t>(bit / 32) * kLanes + lane) * 4;
  const std::uint64_t two = loaded<std::uint32_t>(at) | std::uint64_t{loaded<std::uint32_t>(at + 4 * kLanes)} << 32;
  return static_cast<std::uint32_t>(two >> (bit % 32)) & ((1u << width) - 1);
}

/// A number on its grid. Wraps around if damaged bytes cause an overflow.
float value_of(std::int32_t base, std::uint32_t above, std::uint8_t level) noexcept {
  return static_cast<float>(static_cast<std::int32_t>(static_cast<std::uint32_t>(base) + above)) * step_of(level);
}

/// The context of `unpack` for one run.
struct Task {
  const RunView& run;
  const Counts& counts;
  FrameRange has;     ///< frames of the run
  FrameRange shared;  ///< the requested ones of these
  std::size_t to;     ///< position of the first of those in `out`
  std::size_t joint_count;
  std::size_t translation_count;
  MutablePoses out;

  std::size_t from() const noexcept { return static_cast<std::size_t>(shared.begin - has.begin); }
  std::size_t count() const noexcept { return static_cast<std::size_t>(shared.size()); }
  std::uint64_t row_begin(std::size_t frame) const noexcept {
    return std::uint64_t{run.row_bits} * (counts.one_joint ? frame / kLanes : frame);
  }
  std::size_t lane(std::size_t place, std::size_t frame) const noexcept {
    return counts.one_joint ? frame % kLanes : place % kLanes;
  }
  Eigen::Quaternionf& rotation(std::size_t i, std::size_t joint) const noexcept {
    return out.rotations[(to + i) * joint_count + joint];
  }
};

/// Unpacks a group's numbers over some frames: `three_at` reads the three whole numbers of a row, `finish` exchanges
/// components.
template <typename ThreeAt, typename Finish>
[[gnu::always_inline]] inline void unpack_group(const FourRotations& four, const Task& task, const Places& places,
                                                std::uint64_t bit, const ThreeAt& three_at,
                                                const Finish& finish) noexcept {
  float* out = reinterpret_cast<float*>(task.out.rotations.data()) + 4 * task.to * task.joint_count;
  for (std::size_t i = 0; i < task.count(); ++i) {
    const std::array<U4, 3> above = three_at(bit);
    const FourQuaternions q =
        with_w_dropped(values_of(above[0], four.bases[0], four.step), values_of(above[1], four.bases[1], four.step),
                       values_of(above[2], four.bases[2], four.step), four.sign);
    store(finish(q), places, out);
    bit += task.run.row_bits;
    out += 4 * task.joint_count;
  }
}

void unpack_all_rotations(const Task& task, const std::byte* order) noexcept {
  std::uint64_t bit = task.row_begin(task.from());
  const std::byte* const stream = task.run.stream;
  for (std::size_t group = 0; group < task.counts.rotation_groups(); ++group) {
    const FourRotations four(task.run, task.counts, group);
    const Places places = places_of(order, group, task.counts.rotations);
    const std::uint32_t second = four.widths[0];
    const std::uint32_t third = four.widths[0] + four.widths[1];
    const U4 first_mask = mask_of(four.widths[0]);
    const U4 second_mask = mask_of(four.widths[1]);
    const U4 third_mask = mask_of(four.widths[2]);
    // In nearly every group the three numbers together have at most 32 bits.
    const auto short_row = [=](std::uint64_t at) -> std::array<U4, 3> {
      const U4 bits = window(stream, at);
      return {bits & first_mask, bits >> second & second_mask, bits >> third & third_mask};
    };
    const auto long_row = [=](std::uint64_t at) -> std::array<U4, 3> {
      return {window(stream, at) & first_mask, window(stream, at + second) & second_mask,
              window(stream, at + third) & third_mask};
    };
    const auto unchanged = [](const FourQuaternions& q) { return q; };
    const auto exchange = [&](const FourQuaternions& q) { return exchanged(q, four.component); };
    if (four.bits() > 32 || third > 31) {
      unpack_group(four, task, places, bit, long_row, exchange);
    } else if (four.all_w) {
      unpack_group(four, task, places, bit, short_row, unchanged);
    } else {
      unpack_group(four, task, places, bit, short_row, exchange);
    }
    bit += four.bits();
  }
}

/// Unpacks all translations: the numbers of a group are adjacent in a frame.
void unpack_all_translations(const Task& task) noexcept {
  const std::size_t numbers = 3 * task.counts.translations;
  std::uint64_t bit = task.row_begin(task.from()) + task.run.row_bits;
  for (std::size_t group = task.counts.translation_groups(); group-- > 0;) {
    const NumberGroup it(task.run, task.counts, group);
    bit -= it.width;
    const U4 mask = mask_of(it.width);
    const U4 base = loaded<U4>(it.bases);
    const F4 step = reinterpret_cast<F4>((__builtin_convertvector(loaded<B4>(it.levels), U4) + 388) << 21);
    const std::size_t bytes = 4 * std::min(kLanes, numbers - group * kLanes);
    float* out =
        reinterpret_cast<float*>(task.out.translations.data()) + task.to * 3 * task.translation_count + group * kLanes;
    std::uint64_t at = bit;
    for (std::size_t i = 0; i < task.count(); ++i) {
      const F4 values = values_of(window(task.run.stream, at) & mask, base, step);
      if (bytes == sizeof values) {
        std::memcpy(out, &values, sizeof values);
      } else {
        std::memcpy(out, &values, bytes);
      }
      at += task.run.row_bits;
      out += 3 * task.translation_count;
    }
  }
}

void unpack_rotation(const Task& task, std::size_t place, std::size_t joint) noexcept {
  const std::size_t in_group = task.counts.in_group();
  std::uint64_t bit = 0;
  for (std::size_t group = 0; group < place / in_group; ++group) {
    bit += RotationGroup(task.run, task.counts, group).bits();
  }
  const RotationGroup group(task.run, task.counts, place / in_group);
  const auto widths = widths_of(group.widths);
  const std::size_t at = place % in_group;
  const auto level = loaded<std::uint8_t>(group.levels + at);
  const auto form = loaded<std::uint8_t>(group.forms + at);
  const Dropped dropped{form & 3, (form & 4) != 0};
  std::array<std::int32_t, 3> bases{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t number = i * in_group + at;
    bases[i] =
        task.run.wide ? loaded<std::int32_t>(group.bases + 4 * number) : loaded<std::int16_t>(group.bases + 2 * number);
  }
  for (std::size_t i = 0; i < task.count(); ++i) {
    const std::size_t frame = task.from() + i;
    const std::size_t lane = task.lane(place, frame);
    std::uint64_t from = task.row_begin(frame) + bit;
    std::array<float, 3> kept{};
    for (std::size_t k = 0; k < 3; ++k) {
      kept[k] = value_of(bases[k], number_in(task.run.stream, lane, from, widths[k]), level);
      from += widths[k];
    }
    task.rotation(i, joint) = restored(dropped, kept[0], kept[1], kept[2]);
  }
}

/// Unpacks a translation of the packet to its position in a pose.
void unpack_translation(const Task& task, std::size_t at, std::size_t to) noexcept {
  const std::size_t in_group = task.counts.in_group();
  std::uint64_t bit = task.run.row_bits;
  for (std::size_t group = task.counts.translation_groups(); group-- > 3 * at / in_group;) {
    bit -= NumberGroup(task.run, task.counts, group).width;
  }
  for (std::size_t number = 3 * at; number < 3 * at + 3; ++number) {
    const NumberGroup group(task.run, task.counts, number / in_group);
    const auto base = loaded<std::int32_t>(group.bases + 4 * (number % in_group));
    const auto level = loaded<std::uint8_t>(group.levels + number % in_group);
    for (std::size_t i = 0; i < task.count(); ++i) {
      const std::size_t frame = task.from() + i;
      const std::uint32_t above =
          number_in(task.run.stream, task.lane(number, frame), task.row_begin(frame) + bit, group.width);
      task.out.translations[(task.to + i) * task.translation_count + to][static_cast<Eigen::Index>(number - 3 * at)] =
          value_of(base, above, level);
    }
    if (number % in_group == in_group - 1) bit += group.width;
  }
}

/// Overwrites the values that are stored raw. In a packet of one joint `only` is that joint.
void copy_raw(const Task& task, const JointSet& joints, const Skeleton& skeleton, std::optional<JointIndex> only) {
  const RunView& run = task.run;
  const std::size_t frame_bytes = 16 * run.raw_rotations + 12 * run.raw_translations;
  const auto is_requested = [&](JointIndex joint) {
    return only || joints.empty() || std::binary_search(joints.begin(), joints.end(), joint);
  };
  for (std::size_t k = 0; k < run.raw_rotations; ++k) {
    const std::size_t place = loaded<std::uint16_t>(run.raw_places + 2 * k);
    const std::size_t joint = only ? static_cast<std::size_t>(*only) : place;
    if (!is_requested(static_cast<JointIndex>(joint))) continue;
    for (std::size_t i = 0; i < task.count(); ++i) {
      std::memcpy(task.rotation(i, joint).coeffs().data(), run.raw_values + (task.from() + i) * frame_bytes + 16 * k,
                  16);
    }
  }
  for (std::size_t k = 0; k < run.raw_translations; ++k) {
    const std::size_t place = loaded<std::uint16_t>(run.raw_places + 2 * (run.raw_rotations + k));
    const std::size_t to = only ? *skeleton.translation_of(*only) : place;
    if (!is_requested(skeleton.translated_joints()[to])) continue;
    for (std::size_t i = 0; i < task.count(); ++i) {
      std::memcpy(task.out.translations[(task.to + i) * task.translation_count + to].data(),
                  run.raw_values + (task.from() + i) * frame_bytes + 16 * run.raw_rotations + 12 * k, 12);
    }
  }
}

/// The place of a joint in a packet of all joints.
std::size_t place_of(const std::byte* order, std::size_t joint) noexcept {
  std::size_t place = 0;
  while (loaded<std::uint16_t>(order + 2 * place) != joint) ++place;
  return place;
}

}  // namespace

void unpack(ByteSpan payload, const Record& packet, const Skeleton& skeleton, FrameRange requested,
            const JointSet& joints, MutablePoses out) {
  const Counts counts(packet, width_of(skeleton, packet));
  const FrameRange shared{std::max(packet.frames.begin, requested.begin), std::min(packet.frames.end, requested.end)};
  const std::int64_t first_run = packet.frames.begin / kRunFrames;
  const Runs runs(shared);
  for (std::int64_t number = runs.first; number < runs.end; ++number) {
    const std::size_t which = counts.order_bytes() + 4 * static_cast<std::size_t>(number - first_run);
    const FrameRange has = frames_of_run(number, packet.frames);
    const RunView run(payload.data() + loaded<std::uint32_t>(payload.data() + which), counts,
                      static_cast<std::size_t>(has.size()));
    const FrameRange requested_frames = frames_of_run(number, shared);
    const Task task{.run = run,
                    .counts = counts,
                    .has = has,
                    .shared = requested_frames,
                    .to = static_cast<std::size_t>(requested_frames.begin - requested.begin),
                    .joint_count = skeleton.joint_count(),
                    .translation_count = skeleton.translation_count(),
                    .out = out};
    if (counts.one_joint) {
      unpack_rotation(task, 0, packet.part);
      if (counts.translations > 0) unpack_translation(task, 0, *skeleton.translation_of(packet.part));
      copy_raw(task, joints, skeleton, packet.part);
      continue;
    }
    if (joints.empty()) {
      unpack_all_rotations(task, payload.data());
      unpack_all_translations(task);
    } else {
      for (const JointIndex joint : joints) {
        const auto index = static_cast<std::size_t>(joint);
        unpack_rotation(task, place_of(payload.data(), index), index);
        if (const auto moved = skeleton.translation_of(joint)) unpack_translation(task, *moved, *moved);
      }
    }
    copy_raw(task, joints, skeleton, std::nullopt);
  }
}

}  // namespace signweave::motion_db
