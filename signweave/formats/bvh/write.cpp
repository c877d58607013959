#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/bvh/decimal.h"
#include "signweave/formats/bvh/euler.h"
#include "signweave/formats/bvh/hierarchy.h"
#include "signweave/formats/bvh/space.h"

namespace signweave::bvh {
namespace {

constexpr std::size_t kFlushAt = std::size_t{1} << 16;
constexpr std::size_t kDeepestIndent = 24;  ///< otherwise a chain of 60,000 joints would be mostly tabs
constexpr std::size_t kNotTranslated = static_cast<std::size_t>(-1);
constexpr int kAngleDecimals = 5;  ///< degrees; further digits are the rounding of float quaternions
using Sink = std::function<void(std::string_view)>;

/// The shortest decimal of six places or more that reads back as this rate, or else the one nearest to it.
std::string frame_time_text(FrameRate rate) {
  for (int decimals = 6; decimals < 17; ++decimals) {
    std::string text = fmt::format("{:.{}f}", rate.frame_time().count(), decimals);
    const std::optional<SnappedRate> read = snap_frame_time(text);
    if (read && read->rate == rate) return text;
  }
  return fmt::format("{:.15f}", rate.frame_time().count());
}

std::vector<RotationOrder> rotation_orders(const std::vector<std::vector<Channel>>& channels) {
  std::vector<RotationOrder> orders;
  for (const std::vector<Channel>& of_joint : channels) orders.push_back(rotation_order(of_joint));
  return orders;
}

class Writer {
 public:
  Writer(const Motion& motion, const Layout& layout, const Sink& sink)
      : motion_(motion),
        skeleton_(motion.skeleton()),
        layout_(layout),
        space_{.up = layout.up, .mirrored = layout.mirrored},
        sink_(sink),
        columns_(layout.channels),
        finder_(rotation_orders(layout.channels)),
        rotations_(layout.channels.size()) {
    if (!fits(layout, skeleton_)) {
      throw Error(ErrorCode::bad_input,
                  "this BVH layout does not fit the motion's skeleton: it needs the same joints, and positions for "
                  "every joint that moves; write with the default layout");
    }
    if (layout.root_columns == RootColumns::rotation_first) {
      std::rotate(columns_[0].begin(), columns_[0].begin() + 3, columns_[0].end());
    }
    for (const Joint& joint : skeleton_.joints()) {
      if (joint.name.find_first_of(std::string_view("\r\n\0", 3)) != std::string::npos) {
        throw Error(ErrorCode::bad_input, fmt::format("joint '{}' has a line break in its name, which BVH cannot hold; "
                                                      "rename it",
                                                      printable(joint.name)));
      }
    }
    for (std::size_t joint = 0; joint < columns_.size(); ++joint) {
      translations_.push_back(skeleton_.translation_of(static_cast<JointIndex>(joint)).value_or(kNotTranslated));
    }
  }

  void write(const std::function<void(double fraction)>& progress = {}) {
    constexpr std::int64_t kEvery = 256;
    write_hierarchy();
    write_header();
    for (std::int64_t frame = 0; frame < motion_.frame_count(); ++frame) {
      if (progress && frame % kEvery == 0) {
        progress(static_cast<double>(frame) / static_cast<double>(motion_.frame_count()));
      }
      write_frame(frame);
    }
    sink_(text_);
  }

 private:
  double unit_of(std::size_t joint) const noexcept { return joint == 0 ? layout_.root_unit : layout_.unit; }

  void indent(std::size_t depth) { text_.append(std::min(depth, kDeepestIndent), '\t'); }

  void flush() {
    if (text_.size() < kFlushAt) return;
    sink_(text_);
    text_.clear();
  }

  void write_offset(const Eigen::Vector3f& offset, double unit) {
    const Eigen::Vector3f turned = space_.to_file(offset);
    text_ += "OFFSET";
    numbers_.clear();
    for (const float value : turned) {
      numbers_.letter(' ');
      numbers_.length(value, unit);
    }
    text_ += numbers_.view();
    text_ += '\n';
  }

  /// Opens a joint: writes everything except its children and its closing brace.
  void write_joint(std::size_t joint, std::size_t depth) {
    indent(depth);
    text_ += joint == 0 ? "ROOT " : "JOINT ";
    text_ += skeleton_.joints()[joint].name;
    text_ += '\n';
    indent(depth);
    text_ += "{\n";
    indent(depth + 1);
    write_offset(skeleton_.joints()[joint].offset, unit_of(joint));
    indent(depth + 1);
    text_ += fmt::format("CHANNELS {}", layout_.channels[joint].size());
    for (const Channel channel : layout_.channels[joint]) {
      text_ += ' ';
      text_ += kChannelNames[static_cast<std::size_t>(channel)];
    }
    text_ += '\n';
  }

  void write_tip(const Tip& tip, std::size_t depth) {
    indent(depth);
    text_ += "End Site\n";
    indent(depth);
    text_ += "{\n";
    indent(depth + 1);
    write_offset(tip.offset, layout_.unit);
    indent(depth);
    text_ += "}\n";
  }

  /// Depth first with an explicit list, because files nest thousands deep. The order visited is the order of the
  /// columns.
  void write_hierarchy() {
    const std::size_t joints = skeleton_.joint_count();
    std::vector<std::vector<std::size_t>> children(joints);
    std::vector<std::vector<std::size_t>> tips(joints);
    for (std::size_t i = 1; i < joints; ++i) {
      children[static_cast<std::size_t>(skeleton_.joints()[i].parent)].push_back(i);
    }
    for (std::size_t i = 0; i < skeleton_.tips().size(); ++i) {
      tips[static_cast<std::size_t>(skeleton_.tips()[i].joint)].push_back(i);
    }
    struct Open {
      std::size_t joint;
      std::size_t next_child = 0;
    };
    std::vector<Open> open;
    const auto enter = [&](std::size_t joint) {
      write_joint(joint, open.size());
      open.push_back({.joint = joint});
      order_.push_back(joint);
      for (const std::size_t tip : tips[joint]) write_tip(skeleton_.tips()[tip], open.size());
    };
    text_ += "HIERARCHY\n";
    enter(0);
    while (!open.empty()) {
      Open& last = open.back();
      if (last.next_child < children[last.joint].size()) {
        enter(children[last.joint][last.next_child++]);
      } else {
        open.pop_back();
        indent(open.size());
        text_ += "}\n";
      }
      flush();
    }
  }

  void write_header() {
    // The file's own text is used only for the rate it was read as; a motion with another rate prints its own.
    const std::optional<SnappedRate> printed = snap_frame_time(layout_.frame_time);
    const bool keep = printed && printed->rate == motion_.rate();
    text_ += fmt::format("MOTION\nFrames: {}\nFrame Time: {}\n", motion_.frame_count(),
                         keep ? layout_.frame_time : frame_time_text(motion_.rate()));
  }

  void write_frame(std::int64_t frame) {
    const PoseView pose = motion_.pose(frame);
    numbers_.clear();
    for (std::size_t joint = 0; joint < rotations_.size(); ++joint) {
      rotations_[joint] = of_length_1(space_.to_file(pose.rotations[joint]).cast<double>());
    }
    const std::span<const Angles> found = finder_.next(rotations_);
    for (const std::size_t joint : order_) {
      const Angles& angles = found[joint];
      const std::size_t translation = translations_[joint];
      const Eigen::Vector3f position = space_.to_file(translation != kNotTranslated ? pose.translations[translation]
                                                                                    : skeleton_.joints()[joint].offset);
      std::size_t rotations = 0;
      for (const Channel channel : columns_[joint]) {
        if (is_rotation(channel)) {
          numbers_.fixed(angles[rotations++] * (180 / std::numbers::pi), kAngleDecimals);
        } else {
          numbers_.length(position[axis_of(channel)], unit_of(joint));
        }
        numbers_.letter(' ');
      }
    }
    text_ += numbers_.view();
    text_.back() = '\n';
    flush();
  }

  /// Float quaternions have length 1 except for rounding, which is sufficient for angles.
  static Eigen::Quaterniond of_length_1(const Eigen::Quaterniond& rotation) noexcept {
    return std::abs(rotation.squaredNorm() - 1) < 1e-5 ? rotation : rotation.normalized();
  }

  const Motion& motion_;
  const Skeleton& skeleton_;
  const Layout& layout_;
  Space space_;
  const Sink& sink_;
  std::vector<std::vector<Channel>> columns_;  ///< [joint], in the order of a frame
  AngleFinder finder_;
  std::vector<Eigen::Quaterniond> rotations_;  ///< [joint], of the frame being written
  std::vector<std::size_t> order_;             ///< joints in the file's order
  std::vector<std::size_t> translations_;      ///< [joint], or kNotTranslated
  DecimalText numbers_;                        ///< of the line being written
  std::string text_;
};

}  // namespace

void write(const std::filesystem::path& path, const Motion& motion, const Layout& layout,
           const std::function<void(double fraction)>& progress) {
  AtomicFile file(path);
  const Sink sink = [&](std::string_view text) { file.write(text); };
  Writer(motion, layout, sink).write(progress);
  file.commit();
}

std::string write_text(const Motion& motion, const Layout& layout) {
  std::string result;
  const Sink sink = [&](std::string_view text) { result += text; };
  Writer(motion, layout, sink).write();
  return result;
}

}  // namespace signweave::bvh
