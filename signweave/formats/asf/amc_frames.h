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

/// The frames of an AMC file as numbers. Part of formats/asf, not for others.
namespace signweave::asf {

/// Reads the numbers of frame after frame. All that it is given must outlive it.
/// More than fifteen members: a reader's state, of the file and of the frame at hand.
class AmcReader {
 public:
  /// Reads what stands before the first frame. Throws Error{bad_input}.
  AmcReader(TextReader& reader, const Figure& figure, std::function<void(double)> progress,
            std::vector<Notice>& notices);

  /// Where the numbers of a bone begin in those of a frame.
  std::size_t column_of(std::size_t bone) const noexcept { return columns_[bone]; }
  /// Whether the angles are degrees: as this file says, else as the skeleton's.
  bool degrees() const noexcept { return degrees_; }
  /// After the first frame, about how many are still to come, if they are as long as it is: never more than the file
  /// can hold.
  std::int64_t frames_expected() const noexcept;

  /// The numbers of the next frame, [bone][dof], in the file's units; empty after the last. Valid until the next call.
  /// Throws Error{bad_input} where a frame or a bone is missing, comes twice, or holds what is no number.
  std::span<const double> next();

  /// What was odd in the frames, once all are read.
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
  void tell_progress();

  Lines lines_;
  const Figure& figure_;
  std::function<void(double)> progress_;
  std::vector<Notice>& notices_;
  std::unordered_map<std::string_view, std::size_t> bones_;  ///< by name
  std::vector<std::size_t> columns_;                         ///< [bone]
  std::vector<double> numbers_;
  std::vector<std::size_t> seen_at_;  ///< [bone], the line of this frame that held it; before the frame's own: none
  std::size_t header_bytes_ = 0;
  std::size_t moving_ = 0;  ///< bones with degrees of freedom
  std::size_t seen_ = 0;    ///< of them, in this frame
  std::size_t guess_ = 0;   ///< the bone that is likely to come next
  bool degrees_ = true;
  std::int64_t frames_ = 0;     ///< read so far
  std::int64_t number_ = 0;     ///< that the file gives this frame
  std::size_t frame_line_ = 0;  ///< where it stands
  std::uint64_t outside_ = 0;   ///< numbers outside of their limits
  Notice first_outside_;        ///< of which one is shown
  std::size_t told_at_ = 0;     ///< bytes
};

}  // namespace signweave::asf
