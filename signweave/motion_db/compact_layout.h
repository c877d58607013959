#pragma once

#include <array>
#include <cstring>

#include "signweave/motion_db/grid.h"
#include "signweave/motion_db/packet.h"

// Layout of the payload of a compact packet (docs/store.md has a worked example):
//
//   u16 [joint]    the joint in each place; only in a packet of all joints
//   u32 [run]      the offset of each run from the start of the payload
//   runs           of 16 frames, counted from the motion's frame 0: the first and the last may have fewer
//   32 bytes of 0, so that 16 bytes can be read at once from any number
//
// A run:
//   u32            bits per row
//   u16            1: bases have 32 bits, 0: 16
//   u16, u16       the numbers of rotations and translations that are stored raw
//   groups         of four places (one in a packet of one joint): base [3][place], u8 level [place],
//                  u8 form [place] (bits 0 and 1 the dropped component, bit 2 its sign), u16 widths (5 bits each)
//   groups         of four numbers (one) of the translations [translation][3]: i32 base [number], u8 level [number],
//                  u8 width
//   u16 []         the places of the rotations and the translations that are stored raw
//   f32 []         their numbers, by frame: all rotations, then all translations
//   stream         four interleaved lanes of u32 words: word, lane. A row has for each group its three numbers minus
//                  their bases, then for each group of translations its one; the group's i-th place lies in lane i.
//                  Row r starts at bit r · (bits per row). In a packet of one joint lane and row are frame % 4 and
//                  frame / 4.

namespace signweave::motion_db {

inline constexpr std::size_t kLanes = 4;
inline constexpr std::size_t kPadding = 32;
inline constexpr std::size_t kRunHeader = 10;

template <typename T>
T loaded(const std::byte* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

/// The runs that contain some frames.
struct Runs {
  std::int64_t first = 0;
  std::int64_t end = 0;

  explicit Runs(FrameRange frames) noexcept
      : first(frames.begin / kRunFrames), end(frames.empty() ? first : (frames.end + kRunFrames - 1) / kRunFrames) {}
  std::size_t count() const noexcept { return static_cast<std::size_t>(end - first); }
};

/// The frames of a run that lie in a packet.
inline FrameRange frames_of_run(std::int64_t run, FrameRange packet) noexcept {
  return {std::max(packet.begin, run * kRunFrames), std::min(packet.end, (run + 1) * kRunFrames)};
}

/// The numbers and sizes of the elements of a packet's runs.
struct Counts {
  bool one_joint = false;
  std::size_t rotations = 0;
  std::size_t translations = 0;

  Counts(const Record& packet, Width width) noexcept
      : one_joint(packet.part != kAllJoints), rotations(width.rotations), translations(width.translations) {}
  /// The number of places in a group.
  std::size_t in_group() const noexcept { return one_joint ? 1 : kLanes; }
  std::size_t rotation_groups() const noexcept { return (rotations + in_group() - 1) / in_group(); }
  std::size_t translation_groups() const noexcept { return (3 * translations + in_group() - 1) / in_group(); }
  std::size_t rotation_group_bytes(bool wide) const noexcept { return in_group() * (wide ? 14 : 8) + 2; }
  std::size_t translation_group_bytes() const noexcept { return in_group() * 5 + 1; }
  std::size_t order_bytes() const noexcept { return one_joint ? 0 : 2 * rotations; }
  std::size_t rows(std::size_t frames) const noexcept { return one_joint ? (frames + kLanes - 1) / kLanes : frames; }
};

/// Pointers to the parts of one run in a payload.
struct RunView {
  std::uint32_t row_bits = 0;
  bool wide = false;
  std::size_t raw_rotations = 0;
  std::size_t raw_translations = 0;
  const std::byte* rotation_groups = nullptr;
  const std::byte* translation_groups = nullptr;
  const std::byte* raw_places = nullptr;
  const std::byte* raw_values = nullptr;
  const std::byte* stream = nullptr;

  /// `at` must have kRunHeader bytes.
  RunView(const std::byte* at, const Counts& counts, std::size_t frames) noexcept
      : row_bits(loaded<std::uint32_t>(at)),
        wide(loaded<std::uint16_t>(at + 4) != 0),
        raw_rotations(loaded<std::uint16_t>(at + 6)),
        raw_translations(loaded<std::uint16_t>(at + 8)),
        rotation_groups(at + kRunHeader),
        translation_groups(rotation_groups + counts.rotation_groups() * counts.rotation_group_bytes(wide)),
        raw_places(translation_groups + counts.translation_groups() * counts.translation_group_bytes()),
        raw_values(raw_places + 2 * (raw_rotations + raw_translations)),
        stream(raw_values + frames * (16 * raw_rotations + 12 * raw_translations)) {}
};

/// The three widths of a group's stored numbers.
inline std::array<std::uint32_t, 3> widths_of(std::uint16_t widths) noexcept {
  return {widths & 31u, widths >> 5 & 31u, widths >> 10 & 31u};
}

/// Pointers to the parts of a group of rotations.
struct RotationGroup {
  const std::byte* bases;  ///< [number][place]
  const std::byte* levels;
  const std::byte* forms;
  std::uint16_t widths;

  RotationGroup(const RunView& run, const Counts& counts, std::size_t group) noexcept
      : bases(run.rotation_groups + group * counts.rotation_group_bytes(run.wide)),
        levels(bases + 3 * counts.in_group() * (run.wide ? 4 : 2)),
        forms(levels + counts.in_group()),
        widths(loaded<std::uint16_t>(forms + counts.in_group())) {}
  std::uint32_t bits() const noexcept {
    const auto each = widths_of(widths);
    return each[0] + each[1] + each[2];
  }
};

/// Pointers to the parts of a group of translation components.
struct NumberGroup {
  const std::byte* bases;
  const std::byte* levels;
  std::uint8_t width;

  NumberGroup(const RunView& run, const Counts& counts, std::size_t group) noexcept
      : bases(run.translation_groups + group * counts.translation_group_bytes()),
        levels(bases + 4 * counts.in_group()),
        width(loaded<std::uint8_t>(levels + counts.in_group())) {}
};

/// The size in bytes of a run's stream.
inline std::size_t stream_bytes(std::uint64_t row_bits, std::size_t rows) noexcept {
  return static_cast<std::size_t>((row_bits * rows + 31) / 32) * 4 * kLanes;
}

}  // namespace signweave::motion_db
