#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/motion/motion.h"

/// Acclaim's motion files: a skeleton (.asf) and, for any number of recordings, the angles of its bones (.amc).
///
/// A joint lies at the head of each bone and has the bone's name; joint 0 is `root`. The children of a bone start at
/// its tail, `direction` times `length` away; a bone without children has a tip there.
/// Rotations are applied in the order of `dof` (for the root: `order`), each about a fixed axis: the first is
/// innermost. With C the rotation of a bone's `axis`, its joint's rotation is C · R · C⁻¹ and its translation dofs move
/// it by C · t from its position in the rest pose; `l` is added to its length. The root's rotation is R · O and its
/// position P + t, where P and O are `position` and `orientation`. The rest pose therefore has no rotation except the
/// root's O.
namespace signweave::asf {

struct ReadOptions {
  std::optional<std::filesystem::path> skeleton{};  ///< the .asf; if not given, the result of `skeleton_of`
  /// Metres per unit of the file's lengths after they are divided by the `length` of :units, as the format defines
  /// them: 0.0254 for the files of CMU, whose `length 0.45` converts their numbers to inches. If not given, it is
  /// guessed from the body's stature, as for BVH; for more than 1000 bones it must be given.
  std::optional<double> unit{};
  std::optional<bvh::UpAxis> up{};                  ///< if not given, y
  std::optional<FrameRate> rate{};                  ///< the file does not contain it; if not given, 120 with a notice
  std::function<void(double fraction)> progress{};  ///< called from time to time; may throw to cancel
};

/// A recording as read: metres, Y up, right-handed.
struct File {
  Motion motion;
  std::filesystem::path skeleton;  ///< the .asf that was read; for text, its name
  std::vector<Notice> notices;     ///< what was guessed, assumed or found to be unusual
};

/// Reads a recording and its skeleton. Throws Error{bad_input, "FILE:LINE: …"} if they are not a complete pair of
/// files, Error{not_found} if there is no skeleton, Error{io}.
File read(const std::filesystem::path& amc, const ReadOptions& options = {});
/// Reads from text; the names stand for the files in errors, and `options.skeleton` is ignored.
File read_text(const std::string& asf_name, std::string_view asf, const std::string& amc_name, std::string_view amc,
               const ReadOptions& options = {});

/// The skeleton in the recording's folder that belongs to it: the one with its stem; otherwise with its stem up to a
/// `_`, trying the last `_` first (07_01.amc has 07.asf); otherwise the only one in the folder. The case of the
/// extension `.asf` is ignored. Throws Error{not_found} with the names that were tried, Error{io} if the folder cannot
/// be read.
std::filesystem::path skeleton_of(const std::filesystem::path& amc);

}  // namespace signweave::asf
