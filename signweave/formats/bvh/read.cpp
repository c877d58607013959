#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/text.h"
#include "signweave/core/text_reader.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/bvh/euler.h"
#include "signweave/formats/bvh/frames.h"
#include "signweave/formats/bvh/guess.h"
#include "signweave/formats/bvh/hierarchy.h"
#include "signweave/formats/bvh/space.h"
#include "signweave/formats/bvh/turns.h"

namespace signweave::bvh {
namespace {

/// The root's channels in the order in which its columns are read: with rotation_first the declared rotations, then the
/// positions.
std::vector<Channel> root_columns(const std::vector<Channel>& declared, RootColumns order, const TextReader& reader) {
  if (order == RootColumns::declared) return declared;
  if (!has_positions_then_rotations(declared)) {
    reader.fail(
        "the root's columns can be read rotation first only if CHANNELS names three positions, then three "
        "rotations",
        {{"root_order", "declared"}});
  }
  std::vector<Channel> columns(declared.begin() + 3, declared.end());
  columns.insert(columns.end(), declared.begin(), declared.begin() + 3);
  return columns;
}

/// The destination of a column of positions.
struct PositionColumn {
  std::size_t column;
  std::size_t translation;  ///< [translated joint]
  int axis;
};

std::vector<PositionColumn> position_columns(const std::vector<std::vector<Channel>>& channels,
                                             const std::vector<Joint>& joints) {
  std::vector<PositionColumn> result;
  std::size_t column = 0;
  std::size_t translation = 0;
  for (std::size_t joint = 0; joint < channels.size(); ++joint) {
    for (const Channel channel : channels[joint]) {
      if (!is_rotation(channel)) result.push_back({column, translation, axis_of(channel)});
      ++column;
    }
    if (joints[joint].translated) ++translation;
  }
  return result;
}

/// Reads all frames into a motion that is still in the file's units and axes.
void read_frames(FrameReader& frames, const Hierarchy& hierarchy, std::vector<Channel> root, Motion& motion) {
  std::vector<std::vector<Channel>> channels = hierarchy.channels;
  channels[0] = std::move(root);
  const std::vector<PositionColumn> positions = position_columns(channels, hierarchy.joints);
  Turns turns(channels);
  motion.reserve(frames.frames_to_reserve());
  for (std::span<const double> numbers = frames.next(); !numbers.empty(); numbers = frames.next()) {
    const MutablePoseView pose = motion.append();
    for (const PositionColumn& to : positions) {
      pose.translations[to.translation][to.axis] = static_cast<float>(numbers[to.column]);
    }
    turns.apply(numbers, pose.rotations);
  }
}

void check(const ReadOptions& options) {
  for (const std::optional<double>& unit : {options.unit, options.root_unit}) {
    if (unit && !(*unit >= 1e-6 && *unit <= 1e6)) {
      throw Error(ErrorCode::bad_input, fmt::format("a unit of {} metres; give one between 1e-6 and 1e6", *unit));
    }
  }
}

/// Fills in what the file does not say: from the options, or else guessed, with a notice.
void settle_space(const Motion& motion, const ReadOptions& options, Layout& layout, const std::string& name,
                  std::vector<Notice>& notices) {
  layout.mirrored = options.mirror;
  layout.root_columns = options.root_columns;
  if (options.up && options.unit) {
    layout.up = *options.up;
    layout.unit = *options.unit;
  } else {
    const Guess guess = guess_space(motion, options.up);
    layout.up = guess.up;
    layout.unit = options.unit.value_or(guess.unit);
    const std::string up = fmt::format("up axis {}{}", layout.up == UpAxis::z ? "z" : "y",
                                       options.up || guess.up_certain ? "" : " (the body gives no clear answer)");
    const std::string unit = "unit " + unit_reason(guess);
    if (!options.up && !options.unit) {
      notices.push_back({name, fmt::format("{} and {} guessed", up, unit), {{"up", ""}, {"unit", ""}}});
    } else if (!options.up) {
      notices.push_back({name, fmt::format("{} guessed", up), {{"up", ""}}});
    } else {
      notices.push_back({name, fmt::format("{} guessed", unit), {{"unit", ""}}});
    }
    if (guess.upside_down && !options.up) {
      notices.push_back({name, "the head is below the feet; look at the motion", {{"up", ""}}});
    }
  }
  layout.root_unit = options.root_unit.value_or(layout.unit);
}

/// Converts skeleton and poses from the file's units and axes to ours, in place.
void to_our_space(Motion& motion, Skeleton& skeleton, Hierarchy hierarchy, const Layout& layout) {
  const Space space{.up = layout.up, .mirrored = layout.mirrored};
  const auto converted = [&](const Eigen::Vector3f& v, double unit) {
    const Eigen::Vector3f turned = space.to_ours(v);
    return Eigen::Vector3f(to_metres(turned.x(), unit), to_metres(turned.y(), unit), to_metres(turned.z(), unit));
  };
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const MutablePoseView pose = motion.pose(frame);
    for (Eigen::Quaternionf& rotation : pose.rotations) rotation = space.to_ours(rotation);
    const bool root_moves = hierarchy.joints[0].translated;
    for (std::size_t i = 0; i < pose.translations.size(); ++i) {
      pose.translations[i] = converted(pose.translations[i], i == 0 && root_moves ? layout.root_unit : layout.unit);
    }
  }
  for (std::size_t i = 0; i < hierarchy.joints.size(); ++i) {
    hierarchy.joints[i].offset = converted(hierarchy.joints[i].offset, i == 0 ? layout.root_unit : layout.unit);
  }
  for (Tip& tip : hierarchy.tips) tip.offset = converted(tip.offset, layout.unit);
  skeleton = Skeleton(std::move(hierarchy.joints), std::move(hierarchy.tips));
}

File read(TextReader& reader, const ReadOptions& options) {
  check(options);
  File file;
  Hierarchy hierarchy = read_hierarchy(reader, file.notices);
  if (hierarchy.channel_count == 0) reader.fail("no joint has channels, so the file holds no motion; export it again");
  const MotionHeader header = read_header(reader, file.notices);

  // The unit and the up axis are known only after all frames are read, so the skeleton that the motion shares is
  // replaced then, before any other code has access to it.
  const auto skeleton = std::make_shared<Skeleton>(hierarchy.joints, hierarchy.tips);
  file.motion = Motion(skeleton, header.rate.rate);
  FrameReader frames(reader, hierarchy, header, options);
  read_frames(frames, hierarchy, root_columns(hierarchy.channels[0], options.root_columns, reader), file.motion);

  if (frames.odd_line() != 0) {
    file.notices.push_back({fmt::format("{}:{}", reader.name(), frames.odd_line()),
                            "line breaks do not match the frames, although the count of numbers is right"});
  }
  if (frames.root_is_permuted() && options.root_columns == RootColumns::declared) {
    file.notices.push_back({reader.name(),
                            "the root's columns look permuted: where CHANNELS says rotation they hold the root's "
                            "OFFSET in every frame",
                            {{"root_order", "rotation_first"}, {"root_unit", "m"}}});
  }
  file.layout.frame_time = header.frame_time;
  settle_space(file.motion, options, file.layout, reader.name(), file.notices);
  file.layout.channels = std::move(hierarchy.channels);
  to_our_space(file.motion, *skeleton, std::move(hierarchy), file.layout);
  keep_hemisphere(file.motion);
  if (options.progress) options.progress(1.0);
  return file;
}

}  // namespace

File read(const std::filesystem::path& path, const ReadOptions& options) {
  TextReader reader(path);
  return read(reader, options);
}

File read_text(std::string name, std::string_view text, const ReadOptions& options) {
  TextReader reader(std::move(name), text);
  return read(reader, options);
}

}  // namespace signweave::bvh
