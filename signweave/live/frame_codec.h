#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "signweave/motion/motion.h"

namespace signweave {

/// The number of values in a frame; the same for all frames of a stream.
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
//        0     1  version of this layout: 1
//        1     1  flags, 0
//        2     2  number of frames
//        4     4  frames skipped so far because the client was slow
//        8     8  number of the first frame, from 0; the others are consecutive
//
// A frame, without padding:
//
//   12 · translations  i32 x, y, z of each translated joint, units of 10 µm
//    4 · tracks        f32 value of each scalar track
//    8 · joints        i16 x, y, z, w of each rotation, units of 1/32767
//
// For example, a message of one frame, number 258, after 3 skipped frames: one translation (1, −0.5, 2.00001) m, one
// track of 0.25, one joint rotated by 90° about y, (0, √½, 0, √½):
//
//   01 00  01 00  03 00 00 00  02 01 00 00 00 00 00 00
//   a0 86 01 00  b0 3c ff ff  41 0d 03 00  00 00 80 3e  00 00 82 5a 00 00 82 5a
//
// A decoded rotation is within kRotationError of the original, a translation within kTranslationError on each axis;
// tracks are exact. At the demo signer's fingertips the error is at most 0.11 mm (tests/stream_error_test.cpp).

inline constexpr std::size_t kMessageHeaderBytes = 16;
/// Radians. Each of four values is off by at most half a unit, so the quaternion by at most √4 halves, and the rotation
/// by twice that; plus the error of single precision.
inline constexpr double kRotationError = 2.0 / 32'767 + 1e-6;
/// Metres on each axis, within 160 m of the origin: half a unit plus the error of single precision.
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
/// Writes a frame of this shape to bytes_of(shape) bytes. Values outside the integer range are clamped, NaN becomes 0;
/// tracks are copied unchanged.
void encode(const FrameView& frame, std::span<std::byte> out) noexcept;

/// Reads the header of a complete message. Throws Error{bad_input} if the bytes do not have this layout, or their count
/// does not match the number of frames.
MessageHeader decode_header(std::span<const std::byte> message, const FrameShape& shape);
/// Reads one frame from bytes_of(shape) bytes; rotations are normalized.
void decode(std::span<const std::byte> bytes, MutableFrameView out) noexcept;

}  // namespace signweave
