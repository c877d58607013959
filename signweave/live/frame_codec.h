#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "signweave/motion/motion.h"

namespace signweave {

/// How many numbers a frame of a stream has; the same for all its frames.
struct FrameShape {
  std::size_t joints = 0;
  std::size_t translations = 0;
  std::size_t tracks = 0;
  friend bool operator==(const FrameShape&, const FrameShape&) = default;
};

/// One frame with its scalar tracks, borrowed.
struct FrameView {
  PoseView pose;
  std::span<const float> tracks;  ///< [track]
};
struct MutableFrameView {
  MutablePoseView pose;
  std::span<float> tracks;
  operator FrameView() const noexcept { return {pose, tracks}; }
};

// A binary message of a stream: a header of 16 bytes, then its frames. All numbers are little-endian.
//
//   offset  size  what
//        0     1  1: this layout
//        1     1  flags, 0
//        2     2  number of frames
//        4     4  frames left out so far, because the client was slow
//        8     8  number of the first frame, from 0; the others follow it
//
// A frame, its fields without padding:
//
//   12 · translations  i32 x, y, z of each translated joint, units of 10 µm
//    4 · tracks        f32 value of each scalar track
//    8 · joints        i16 x, y, z, w of each rotation, units of 1/32767
//
// For example a message of one frame, number 258, after 3 that were left out: one translation (1, −0.5, 2.00001) m, one
// track of 0.25, one joint turned by 90° about y, (0, √½, 0, √½):
//
//   01 00  01 00  03 00 00 00  02 01 00 00 00 00 00 00
//   a0 86 01 00  b0 3c ff ff  41 0d 03 00  00 00 80 3e  00 00 82 5a 00 00 82 5a
//
// A rotation comes out within kRotationError of what it was, a translation within kTranslationError on each axis;
// tracks to the bit. At the demo signer's fingertips that is 0.11 mm at worst (tests/stream_error_test.cpp).

inline constexpr std::size_t kMessageHeaderBytes = 16;
/// Radians: each of four numbers is off by half a unit at most, their length away from a unit quaternion by as many as
/// √4 halves, and a rotation turns by twice that; with it what single precision takes.
inline constexpr double kRotationError = 2.0 / 32'767 + 1e-6;
/// Metres on each axis, within 160 m of the origin: half a unit, and what single precision takes.
inline constexpr double kTranslationError = 5e-6 + 8e-6;

struct MessageHeader {
  std::uint16_t frames = 0;
  std::uint32_t left_out = 0;
  std::uint64_t first_frame = 0;
  friend bool operator==(const MessageHeader&, const MessageHeader&) = default;
};

constexpr std::size_t bytes_of(const FrameShape& shape) noexcept {
  return 12 * shape.translations + 4 * shape.tracks + 8 * shape.joints;
}

/// Writes a header to 16 bytes.
void encode(const MessageHeader& header, std::span<std::byte> out) noexcept;
/// Writes a frame of this shape to bytes_of(shape) bytes. What lies outside the range of a whole number becomes its
/// end, what is no number 0; tracks pass as they are.
void encode(const FrameView& frame, std::span<std::byte> out) noexcept;

/// Reads a whole message's header. Throws Error{bad_input} where the bytes are not of this layout, or their count is
/// not that of so many frames of the shape.
MessageHeader decode_header(std::span<const std::byte> message, const FrameShape& shape);
/// Reads one frame from bytes_of(shape) bytes; rotations are made unit again.
void decode(std::span<const std::byte> bytes, MutableFrameView out) noexcept;

}  // namespace signweave
