#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "signweave/core/text_reader.h"
#include "signweave/formats/asf/amc_frames.h"
#include "signweave/formats/asf/asf.h"
#include "signweave/formats/asf/pose.h"
#include "signweave/formats/asf/skeleton.h"
#include "signweave/formats/bvh/guess.h"
#include "signweave/formats/bvh/space.h"

namespace signweave::asf {
namespace {

constexpr FrameRate kAcclaimRate{120, 1};
/// The guess examines each path from a head to a foot; with thousands of bones with such names it would take hours.
constexpr std::size_t kMostBonesOfAGuess = 1000;

void check_unit_option(const ReadOptions& options) {
  if (options.unit && !(*options.unit >= 1e-6 && *options.unit <= 1e6)) {
    throw Error(ErrorCode::bad_input, fmt::format("a unit of {} metres; give one between 1e-6 and 1e6", *options.unit));
  }
}

/// Metres per unit of length: from the options, or else guessed, with a notice.
double settle_unit(const Motion& motion, const Figure& figure, const ReadOptions& options, bvh::UpAxis up,
                   const std::string& name, std::vector<Notice>& notices) {
  if (options.unit) return *options.unit;
  if (figure.bones.size() > kMostBonesOfAGuess) {
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: {} bones are no body whose unit can be guessed", name, figure.bones.size()),
                {{"unit", ""}});
  }
  const bvh::Guess guess = bvh::guess_space(motion, up);
  const std::string divided =
      figure.length_unit == 1 ? "" : fmt::format(" for lengths divided by the {:g} of :units", figure.length_unit);
  notices.push_back({name, fmt::format("unit {} guessed{}", bvh::unit_reason(guess), divided), {{"unit", ""}}});
  if (guess.upside_down) notices.push_back({name, "the head is below the feet; look at the motion", {{"up", ""}}});
  return guess.unit;
}

/// Converts poses and rest pose from the file's axes and lengths to metres, Y up.
void to_metres_y_up(Motion& motion, RestFigure& rest, bvh::UpAxis up, double unit) {
  const bvh::Space space{.up = up, .mirrored = false};
  const auto converted = [&](const Eigen::Vector3f& v) {
    const Eigen::Vector3f turned = space.to_ours(v);
    return Eigen::Vector3f(bvh::to_metres(turned.x(), unit), bvh::to_metres(turned.y(), unit),
                           bvh::to_metres(turned.z(), unit));
  };
  const MutablePoses poses = motion.poses({0, motion.frame_count()});
  for (Eigen::Quaternionf& rotation : poses.rotations) rotation = space.to_ours(rotation);
  for (Eigen::Vector3f& translation : poses.translations) translation = converted(translation);
  for (Joint& joint : rest.joints) joint.offset = converted(joint.offset);
  for (Tip& tip : rest.tips) tip.offset = converted(tip.offset);
}

void note_length_dofs(const Figure& figure, const RestFigure& rest, const std::string& name,
                      std::vector<Notice>& notices) {
  const auto has_length_dof = [](const Bone& bone) {
    return std::find(bone.dofs.begin(), bone.dofs.end(), Dof::l) != bone.dofs.end();
  };
  if (std::none_of(figure.bones.begin(), figure.bones.end(), has_length_dof)) return;
  notices.push_back({name, "dof l is read as an addition to a bone's length, so 0 is the rest pose"});
  for (const Tip& tip : rest.tips) {
    const Bone& bone = figure.bones[static_cast<std::size_t>(tip.joint)];
    if (!has_length_dof(bone)) continue;
    notices.push_back(
        {fmt::format("{}:{}", name, bone.line),
         fmt::format("{} has no children, so its l moves only its tip, which stays at rest", in_quotes(bone.name))});
    return;
  }
}

File read_pair(TextReader& asf, TextReader& amc, const ReadOptions& options) {
  check_unit_option(options);
  File file;
  const Figure figure = read_figure(asf, file.notices);
  RestFigure rest = rest_of(figure);
  note_length_dofs(figure, rest, asf.name(), file.notices);

  // The unit is known only after all frames are read, so the skeleton that the motion shares is replaced then, before
  // any other code has access to it.
  const auto skeleton = std::make_shared<Skeleton>(rest.joints, rest.tips);
  file.motion = Motion(skeleton, options.rate.value_or(kAcclaimRate));
  AmcReader frames(amc, figure, options.progress, file.notices);
  Poser poser(figure, frames.degrees());
  for (std::span<const double> numbers = frames.next(); !numbers.empty(); numbers = frames.next()) {
    poser.apply(numbers, file.motion.append());
    if (file.motion.frame_count() == 1) file.motion.reserve(1 + frames.frames_expected());
  }
  frames.report();
  if (!options.rate) {
    file.notices.push_back(
        {amc.name(),
         fmt::format("the format does not give the frame rate; {} frames a second taken", to_string(kAcclaimRate)),
         {{"source_rate", ""}}});
  }
  const bvh::UpAxis up = options.up.value_or(bvh::UpAxis::y);
  const double unit = settle_unit(file.motion, figure, options, up, asf.name(), file.notices);
  to_metres_y_up(file.motion, rest, up, unit);
  *skeleton = Skeleton(std::move(rest.joints), std::move(rest.tips));
  keep_hemisphere(file.motion);
  if (options.progress) options.progress(1.0);
  return file;
}

}  // namespace

File read(const std::filesystem::path& amc, const ReadOptions& options) {
  TextReader motion(amc);
  const std::filesystem::path skeleton = options.skeleton ? *options.skeleton : skeleton_of(amc);
  TextReader bones(skeleton);
  File file = read_pair(bones, motion, options);
  file.skeleton = skeleton;
  return file;
}

File read_text(const std::string& asf_name, std::string_view asf, const std::string& amc_name, std::string_view amc,
               const ReadOptions& options) {
  TextReader bones(asf_name, asf);
  TextReader motion(amc_name, amc);
  File file = read_pair(bones, motion, options);
  file.skeleton = asf_name;
  return file;
}

}  // namespace signweave::asf
