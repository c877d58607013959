#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/formats/asf/lines.h"
#include "signweave/formats/asf/skeleton.h"

/// The frames of an AMC file as numbers. Internal to formats/asf.
namespace signweave::asf {

/// Reads the numbers of one frame after another. All constructor arguments must outlive it.
/// It has more than fifteen members: the state of the reader, of the file and of the current frame.
class AmcReader {
 public:
  /// Reads everything before the first frame. Throws Error{bad_input}.
  AmcReader(TextReader& reader, const Figure& figure, std::function<void(double)> progress,
            std::vector<Notice>& notices);

  /// The column of a bone's first number in a frame.
  std::size_t column_of(std::size_t bone) const noexcept { return columns_[bone]; }
  /// Whether the angles are degrees, as this file says; if it does not, as the skeleton says.
  bool degrees() const noexcept { return degrees_; }
  /// After the first frame, estimates the number of frames still to come, assuming they are as long as the first: never
  /// more than the file can hold.
  std::int64_t frames_expected() const noexcept;

  /// The numbers of the next frame, [bone][dof], in the file's units; empty after the last. Valid until the next call.
  /// Throws Error{bad_input} if a frame or a bone is missing or occurs twice, or if a number is malformed.
  std::span<const double> next();

  /// Adds notices for what was unusual in the frames, once all are read.
  void report();

 private:
  void read_header();
  void read_number();
  void read_bone();
  std::size_t bone_of(std::string_view name);
  void check_limits(std::size_t at);
  void check_complete() const;
  void check_size() const;
  bool is_sparse() const noexcept;
  void report_progress();

  Lines lines_;
  const Figure& figure_;
  std::function<void(double)> progress_;
  std::vector<Notice>& notices_;
  std::unordered_map<std::string_view, std::size_t> bones_;  ///< by name
  std::vector<std::size_t> columns_;                         ///< [bone]
  std::vector<double> numbers_;
  std::vector<std::size_t> seen_at_;  ///< [bone], its line in this frame; not yet seen if before `frame_line_`
  std::size_t header_bytes_ = 0;
  std::size_t moving_ = 0;  ///< bones with degrees of freedom
  std::size_t seen_ = 0;    ///< of them, in this frame
  std::size_t guess_ = 0;   ///< the bone that is expected next
  bool degrees_ = true;
  std::int64_t frames_ = 0;      ///< read so far
  std::int64_t number_ = 0;      ///< of this frame, as the file gives it
  std::size_t frame_line_ = 0;   ///< line of the current frame's number
  std::uint64_t outside_ = 0;    ///< numbers outside of their limits
  Notice first_outside_;         ///< one of them, as an example
  std::size_t reported_at_ = 0;  ///< bytes at the last progress call
};

}  // namespace signweave::asf
