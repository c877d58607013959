#include "signweave/formats/fbx/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "signweave/core/text.h"
#include "signweave/formats/fbx/local.h"

namespace signweave::fbx {
namespace {

/// Below this, in metres, a bone's length counts as constant.
constexpr float kNoDrift = 1e-6f;

/// One vector per frame, or one for all frames.
struct Samples {
  std::array<std::vector<double>, 3> parts;
  Eigen::Vector3d at(std::size_t frame) const {
    Eigen::Vector3d result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[static_cast<Eigen::Index>(i)] = parts[i][parts[i].size() == 1 ? 0 : frame];
    }
    return result;
  }
  bool moves() const noexcept { return parts[0].size() > 1 || parts[1].size() > 1 || parts[2].size() > 1; }
};

Samples samples_of(const Ingredients& from, const Channel* channel, const Eigen::Vector3d& own) {
  Samples samples;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = own[static_cast<Eigen::Index>(i)];
    if (channel == nullptr) {
      samples.parts[i] = {value};
    } else if (channel->curves[i] == nullptr) {
      samples.parts[i] = {channel->values[i].value_or(value)};
    } else {
      samples.parts[i] = sampled(from.curves.at(channel->curves[i]), from.frames.ticks);
    }
  }
  return samples;
}

/// A joint over all frames; one element if it does not change.
struct JointFrames {
  std::vector<Eigen::Quaternionf> rotations;
  std::vector<Eigen::Vector3f> translations;  ///< metres
  std::vector<double>
      passed_on;  ///< the product of its own scale and those above; the lengths of the children are multiplied by it
  std::vector<double> own_scale;
};

double at(const std::vector<double>& values, std::size_t frame) noexcept {
  return values[values.size() == 1 ? 0 : frame];
}

class MotionMaker {
 public:
  MotionMaker(const Ingredients& from, std::vector<Notice>& notices)
      : from_(from), notices_(notices), space_(from.scene.settings), joint_of_(from.scene.nodes.size(), kNoJoint) {
    for (std::size_t i = 0; i < from.bones.size(); ++i) joint_of_[from.bones[i]] = static_cast<JointIndex>(i);
    for (const Channel& channel : from.take.channels) {
      const Channel*& place = channels_[{channel.node, channel.what}];
      if (place != nullptr) {
        from.source.fail(from.scene.nodes[channel.node].place,
                         fmt::format("two animations of '{}' of node '{}' in one take; bake it into one",
                                     printable(channel.property), printable(from.scene.nodes[channel.node].name)));
      }
      place = &channel;
    }
  }

  Motion make() {
    std::vector<JointFrames> joints;
    joints.reserve(from_.bones.size());
    std::vector<Joint> skeleton;
    for (std::size_t i = 0; i < from_.bones.size(); ++i) {
      joints.push_back(frames_of_joint(i, joints));
      skeleton.push_back(joint_of(i, joints.back()));
      if (from_.progress) from_.progress(0.9 * static_cast<double>(i) / static_cast<double>(from_.bones.size()));
    }
    const auto count = static_cast<std::int64_t>(from_.frames.ticks.size());
    Motion motion(std::make_shared<const Skeleton>(std::move(skeleton), std::vector<Tip>()), from_.frames.rate, count);
    for (std::int64_t frame = 0; frame < count; ++frame) {
      const MutablePoseView pose = motion.pose(frame);
      const auto index = static_cast<std::size_t>(frame);
      std::size_t translated = 0;
      for (std::size_t i = 0; i < joints.size(); ++i) {
        pose.rotations[i] = joints[i].rotations[joints[i].rotations.size() == 1 ? 0 : index];
        if (!motion.skeleton().joints()[i].translated) continue;
        pose.translations[translated++] = joints[i].translations[joints[i].translations.size() == 1 ? 0 : index];
      }
    }
    add_tracks(motion);
    return motion;
  }

 private:
  const Channel* channel_of(std::size_t node, Animated what) const {
    const auto found = channels_.find({node, what});
    return found == channels_.end() ? nullptr : found->second;
  }

  JointIndex parent_of(std::size_t index) const {
    const std::size_t parent = from_.scene.nodes[from_.bones[index]].parent;
    return index == 0 ? kNoJoint : joint_of_[parent];
  }

  bool has_joints_below(const Node& node) const {
    return std::any_of(node.children.begin(), node.children.end(),
                       [&](std::size_t child) { return joint_of_[child] != kNoJoint; });
  }

  JointFrames frames_of_joint(std::size_t index, const std::vector<JointFrames>& joints) {
    const std::size_t number = from_.bones[index];
    const Node& node = from_.scene.nodes[number];
    if (node.rotation_active && node.rotation_order == 6) {
      from_.source.fail(node.place, fmt::format("node '{}' has spheric rotations, which are not read; bake it to Euler "
                                                "angles",
                                                printable(node.name)));
    }
    const bool silent = !node.rotation_active &&
                        (node.rotation_order != 0 || !node.pre_rotation.isZero() || !node.post_rotation.isZero());
    if (silent && !inactive_reported_) {
      inactive_reported_ = true;
      notices_.push_back({from_.source.name, fmt::format("node '{}' has a pre- or post-rotation or an order that its "
                                                         "RotationActive turns off; left out, here and in others",
                                                         printable(node.name))});
    }
    const Samples translation = samples_of(from_, channel_of(number, Animated::translation), node.translation);
    const Samples rotation = samples_of(from_, channel_of(number, Animated::rotation), node.rotation);
    const Samples scaling = samples_of(from_, channel_of(number, Animated::scaling), node.scaling);
    const JointIndex parent_index = parent_of(index);
    const JointFrames* parent = parent_index == kNoJoint ? nullptr : &joints[static_cast<std::size_t>(parent_index)];

    const bool turns = rotation.moves();
    const bool scales = scaling.moves() || (parent != nullptr && (parent->passed_on.size() > 1));
    const bool shifts = translation.moves() || turns || scales;
    const std::size_t count = from_.frames.ticks.size();
    const bool carries = has_joints_below(node);
    JointFrames out;
    for (std::size_t frame = 0; frame < (shifts ? count : 1); ++frame) {
      const Eigen::Vector3d scale = scaling.at(frame);
      if (carries && !is_uniform(scale)) refuse_scale(node, scale, frame, scaling.moves());
      const Local local = local_of(node, translation.at(frame), rotation.at(frame), scale);
      const double above = parent == nullptr ? 1 : at(parent->passed_on, frame);
      Eigen::Quaterniond turn = space_.inside(local.rotation);
      Eigen::Vector3d place = space_.inside(local.translation) * (above * from_.unit);
      if (parent == nullptr) {
        turn = space_.turn() * turn;
        place = space_.turn() * place;
      }
      if (!(place.cwiseAbs().maxCoeff() <= 1e9)) {
        from_.source.fail(node.place,
                          fmt::format("node '{}' is farther than 1e+09 metres from its parent", printable(node.name)));
      }
      out.translations.push_back(place.cast<float>());
      if (turns || frame == 0) out.rotations.push_back(turn.normalized().cast<float>());
      if (!scales && frame > 0) continue;
      // A node of InheritType Rrs inherits everything from above except its parent's own scale.
      const double inherited = node.inherit == 2 && parent != nullptr ? above / at(parent->own_scale, frame) : above;
      const double own = carries ? scale.sum() / 3 : 1;
      out.own_scale.push_back(own);
      out.passed_on.push_back(inherited * own);
    }
    return out;
  }

  [[noreturn]] void refuse_scale(const Node& node, const Eigen::Vector3d& scale, std::size_t frame, bool moves) const {
    from_.source.fail(node.place,
                      fmt::format("node '{}' is scaled by {:.6g}, {:.6g}, {:.6g}{} and has bones below it, which would "
                                  "be stretched or mirrored; apply its scale before exporting",
                                  printable(node.name), scale.x(), scale.y(), scale.z(),
                                  moves ? fmt::format(" in frame {}", frame) : ""));
  }

  Joint joint_of(std::size_t index, JointFrames& frames) {
    const Eigen::Vector3f first = frames.translations.front();
    const bool still = std::all_of(frames.translations.begin(), frames.translations.end(), [&](const auto& place) {
      return (place - first).cwiseAbs().maxCoeff() <= kNoDrift;
    });
    if (still) frames.translations = {first};
    return {.name = from_.scene.nodes[from_.bones[index]].name,
            .parent = parent_of(index),
            .offset = first,
            .translated = !still};
  }

  void add_tracks(Motion& motion) {
    std::map<std::string, std::size_t> seen;
    std::vector<ScalarTrack> tracks;
    for (const Morph& morph : from_.take.morphs) {
      ScalarTrack track{.name = morph.name, .values = {}};
      for (const double percent : sampled(from_.curves.at(morph.curve), from_.frames.ticks)) {
        track.values.push_back(static_cast<float>(percent / 100));
      }
      const auto [place, is_new] = seen.emplace(track.name, tracks.size());
      if (is_new) {
        tracks.push_back(std::move(track));
      } else if (tracks[place->second].values != track.values) {
        notices_.push_back({from_.source.name, fmt::format("two blend shapes are called '{}' and move differently; the "
                                                           "first is kept",
                                                           printable(track.name))});
      }
    }
    for (ScalarTrack& track : tracks) motion.add_track(std::move(track));
  }

  const Ingredients& from_;
  std::vector<Notice>& notices_;
  Space space_;
  std::vector<JointIndex> joint_of_;
  std::map<std::pair<std::size_t, Animated>, const Channel*> channels_;
  bool inactive_reported_ = false;
};

}  // namespace

std::vector<const Record*> records_of(const Take& take) {
  std::vector<const Record*> records;
  for (const Channel& channel : take.channels) {
    for (const Record* curve : channel.curves) {
      if (curve != nullptr) records.push_back(curve);
    }
  }
  for (const Morph& morph : take.morphs) records.push_back(morph.curve);
  return records;
}

std::vector<std::int64_t> keys_of(const Take& take, const Curves& curves) {
  std::vector<std::int64_t> keys;
  const std::vector<std::int64_t>* last = nullptr;
  for (const Record* record : records_of(take)) {
    const std::vector<std::int64_t>& ticks = curves.at(record).ticks;
    if (last != nullptr && *last == ticks) continue;  // most curves have the same times
    last = &ticks;
    keys.insert(keys.end(), ticks.begin(), ticks.end());
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

Motion motion_of(const Ingredients& from, std::vector<Notice>& notices) {
  return MotionMaker(from, notices).make();
}

}  // namespace signweave::fbx
