#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/text_reader.h"
#include "signweave/core/time.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/bvh/hierarchy.h"

/// The MOTION half of a BVH file as numbers. Internal to formats/bvh.
namespace signweave::bvh {

/// The lines between HIERARCHY and the numbers.
struct MotionHeader {
  std::int64_t frames = 0;
  std::string frame_time;  ///< as printed in the file
  SnappedRate rate;
};

/// Reads from MOTION up to the frame time. Throws Error{bad_input}.
MotionHeader read_header(TextReader& reader, std::vector<Notice>& notices);

/// Detects an exporter's error: CHANNELS declares positions, then rotations, but the columns hold a rotation and then
/// the root's OFFSET.
class PermutedRoot {
 public:
  PermutedRoot(const std::vector<Channel>& declared, const Eigen::Vector3f& offset);

  /// Examines the numbers of one frame.
  void see(std::span<const double> numbers) noexcept;
  bool found() const noexcept { return suspect_ && positions_move_; }

 private:
  const std::vector<Channel>& declared_;
  Eigen::Vector3d offset_;
  bool suspect_ = false;
  bool positions_move_ = false;
};

/// Reads the numbers of one frame after another. All constructor arguments must outlive it.
class FrameReader {
 public:
  FrameReader(TextReader& reader, const Hierarchy& hierarchy, const MotionHeader& header, const ReadOptions& options);

  /// The number of frames to reserve memory for. A number takes at least two bytes, so a wrong frame count never
  /// reserves more than the file can fill.
  std::int64_t frames_to_reserve() const;

  /// Returns the numbers of the next frame, in the file's order and units; empty after the last. Valid until the next
  /// call. Throws Error{bad_input} if the file ends too early or too late, or if a number is malformed.
  std::span<const double> next();

  bool root_is_permuted() const noexcept { return permuted_.found(); }
  /// The first line that does not hold exactly one frame, or 0.
  std::size_t odd_line() const noexcept { return odd_line_; }

 private:
  void begin_frame(std::size_t line) noexcept;
  bool is_sparse() const noexcept;
  void check_size() const;
  void note_odd_line(std::size_t line) noexcept;
  std::string odd_line_hint() const;
  [[noreturn]] void fail_short(std::size_t numbers);
  [[noreturn]] void fail_long();
  void report();

  TextReader& reader_;
  const Hierarchy& hierarchy_;
  const ReadOptions& options_;
  std::int64_t frames_;     ///< announced by the file
  std::int64_t frame_ = 0;  ///< read so far
  std::vector<double> numbers_;
  PermutedRoot permuted_;
  std::size_t first_line_ = 0;  ///< of the frame being read
  std::size_t last_line_ = 0;   ///< of the previous frame
  std::size_t odd_line_ = 0;
  std::size_t reported_ = 0;
};

}  // namespace signweave::bvh
