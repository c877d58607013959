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
/// A joint sits at the head of each bone and is called like the bone; joint 0 is `root`. The bones that hang on a bone
/// stand at its tail, `direction` times `length` away; a bone on which none hangs has a tip there.
/// Rotations follow each other as `dof` (of the root: `order`) lists them, each about a fixed axis: the first is
/// innermost. With C the turn of a bone's `axis`, its joint turns by C · R · C⁻¹ and its translation dofs move it by
/// C · t from its place in the rest pose; `l` is added to its length. The root turns by R · O and stands at P + t,
/// where P and O are `position` and `orientation`. So the rest pose has no rotation but the root's O.
namespace signweave::asf {

struct ReadOptions {
  std::optional<std::filesystem::path> skeleton{};  ///< the .asf; `skeleton_of` finds it where not given
  /// Metres per unit of the file's lengths after they are divided by the `length` of :units, which is what the format
  /// means by it: 0.0254 for the files of CMU, whose `length 0.45` makes inches of their numbers. Guessed from the
  /// body's stature where not given, as for BVH; of more than 1000 bones it must be given.
  std::optional<double> unit{};
  std::optional<bvh::UpAxis> up{};                  ///< y where not given
  std::optional<FrameRate> rate{};                  ///< the file does not tell; 120 with a notice where not given
  std::function<void(double fraction)> progress{};  ///< called now and then; may throw to cancel
};

/// A recording as read: metres, Y up, right-handed.
struct File {
  Motion motion;
  std::filesystem::path skeleton;  ///< the .asf that was read; of text, its name
  std::vector<Notice> notices;     ///< what was guessed, assumed, found odd
};

/// Reads a recording and its skeleton. Throws Error{bad_input, "FILE:LINE: …"} for anything that is no whole pair of
/// files, Error{not_found} where there is no skeleton, Error{io}.
File read(const std::filesystem::path& amc, const ReadOptions& options = {});
/// The same from text; the names stand for the files in errors, and `options.skeleton` is not looked at.
File read_text(const std::string& asf_name, std::string_view asf, const std::string& amc_name, std::string_view amc,
               const ReadOptions& options = {});

/// Which skeleton of the recording's folder belongs to it: the one of its stem; else of its stem up to a `_`, the last
/// first (07_01.amc has 07.asf); else the only one there is. Upper and lower case of the ending `.asf` are one.
/// Throws Error{not_found} that tells what was looked for, Error{io} where the folder cannot be read.
std::filesystem::path skeleton_of(const std::filesystem::path& amc);

}  // namespace signweave::asf
