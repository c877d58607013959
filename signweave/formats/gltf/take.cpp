#include "signweave/formats/gltf/take.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "signweave/core/text.h"

namespace signweave::gltf {
namespace {

constexpr double kLongestTake =
    24 * 60 * 60;  // seconds; a float's precision is insufficient for frames long before that
constexpr std::size_t kTakesNamed = 8;

[[noreturn]] void refuse_take(const Content& content, const std::string& what, ErrorCode code = ErrorCode::bad_input) {
  throw Error(code, fmt::format("{}: {}", content.name, what));
}

std::string take_name(const Content& content, std::size_t animation) {
  const std::string& name = content.model.animations[animation].name;
  return name.empty() ? std::to_string(animation + 1) : name;
}

std::string names_of_takes(const Content& content) {
  std::string text;
  const std::size_t count = content.model.animations.size();
  for (std::size_t i = 0; i < std::min(count, kTakesNamed); ++i) {
    text += fmt::format("{}'{}'", i == 0 ? "" : ", ", printable(take_name(content, i)));
  }
  if (count > kTakesNamed) text += fmt::format(" and {} more", count - kTakesNamed);
  return text;
}

std::size_t chosen_take(const Content& content, const std::string& wanted, std::vector<Notice>& notices) {
  const std::size_t count = content.model.animations.size();
  if (count == 0) refuse_take(content, "it holds no animation; export it with one");
  if (wanted.empty()) {
    if (count > 1) {
      notices.push_back({content.name,
                         fmt::format("it has {} takes, {}; the first was read", count, names_of_takes(content)),
                         {{"take", ""}}});
    }
    return 0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (content.model.animations[i].name == wanted) return i;
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  const bool is_number = error == std::errc() && end == wanted.data() + wanted.size();
  if (is_number && number >= 1 && number <= count) return number - 1;
  refuse_take(content, fmt::format("no take '{}'; it has {}", printable(wanted), names_of_takes(content)),
              ErrorCode::not_found);
}

/// Reads the curves of one animation.
class TakeReader {
 public:
  TakeReader(const Content& content, Accessors& accessors, Budget& budget, std::size_t animation)
      : content_(content),
        accessors_(accessors),
        budget_(budget),
        animation_(content.model.animations[animation]),
        place_(fmt::format("animation {}", animation)) {
    take_.animation = animation;
    take_.name = take_name(content, animation);
    take_.nodes.resize(content.model.nodes.size());
  }

  Take read(std::vector<Notice>& notices) {
    for (std::size_t i = 0; i < animation_.channels.size(); ++i) read_channel(i);
    if (ignored_ > 0) {
      notices.push_back(
          {content_.name, fmt::format("{}: {} channels that move no node were left out", place_, ignored_)});
    }
    if (longest_off_ > 0.01) {
      notices.push_back({content_.name, fmt::format("{}: rotations whose length is off by up to {:.2g}, made unit",
                                                    place_, longest_off_)});
    }
    return std::move(take_);
  }

 private:
  [[noreturn]] void refuse(const std::string& place, const std::string& what) const {
    refuse_take(content_, place + ": " + what);
  }

  void read_channel(std::size_t index) {
    const tinygltf::AnimationChannel& channel = animation_.channels[index];
    if (channel.target_path == "ignored") {
      ++ignored_;
      return;
    }
    const std::string place = fmt::format("{}, channel {}", place_, index);
    const auto node = static_cast<std::size_t>(channel.target_node);
    NodeCurves& curves = take_.nodes[node];
    const Curve*& slot = channel.target_path == "translation" ? curves.translation
                         : channel.target_path == "rotation"  ? curves.rotation
                         : channel.target_path == "scale"     ? curves.scale
                                                              : curves.weights;
    if (slot != nullptr)
      refuse(place, fmt::format("the {} of {} again", channel.target_path, node_text(content_, node)));
    if (channel.target_path == "weights" && content_.model.nodes[node].mesh < 0) {
      refuse(place, fmt::format("{} has no mesh whose weights could change", node_text(content_, node)));
    }
    const auto& sampler = animation_.samplers[static_cast<std::size_t>(channel.sampler)];
    auto curve = std::make_unique<Curve>();
    curve->place = place;
    curve->interpolation = interpolation_of(sampler, place);
    curve->times = times_of(sampler.input);
    read_values(*curve, sampler.output, channel.target_path, node);
    slot = curve.get();
    take_.curves.push_back(std::move(curve));
  }

  Interpolation interpolation_of(const tinygltf::AnimationSampler& sampler, const std::string& place) const {
    if (sampler.interpolation == "STEP") return Interpolation::step;
    if (sampler.interpolation == "CUBICSPLINE") return Interpolation::cubic;
    if (sampler.interpolation == "LINEAR" || sampler.interpolation.empty()) return Interpolation::linear;
    refuse(place, fmt::format("no interpolation '{}'", printable(sampler.interpolation)));
  }

  std::shared_ptr<KeyTimes> times_of(int accessor) {
    std::shared_ptr<KeyTimes>& times = times_[accessor];
    if (times) return times;
    const tinygltf::Accessor& of = content_.model.accessors[static_cast<std::size_t>(accessor)];
    const std::string place = fmt::format("accessor {}", accessor);
    // Without a view all elements are 0 except the sparse ones, so most times would be equal.
    const bool zeros = of.bufferView < 0 &&
                       of.count > (of.sparse.isSparse ? static_cast<std::size_t>(std::max(of.sparse.count, 0)) : 0) + 1;
    if (zeros) refuse(place, "its key times do not ascend; export it again");
    const Numbers numbers = accessors_.read(accessor, {.type = TINYGLTF_TYPE_SCALAR});
    for (std::size_t i = 0; i < numbers.count; ++i) {
      const float time = numbers.values[i];
      if (time < 0) refuse(place, fmt::format("key {} is at {} seconds, before the animation begins", i, time));
      if (time > kLongestTake) {
        refuse(place, fmt::format("key {} is at {:.6g} seconds; a take may last 24 hours", i, time));
      }
      if (i > 0 && time <= numbers.values[i - 1]) {
        refuse(place, fmt::format("its key times do not ascend: key {} is at {} seconds, the one before at {}", i, time,
                                  numbers.values[i - 1]));
      }
    }
    budget_.spend(numbers.count, sizeof(double), place);
    times = std::make_shared<KeyTimes>();
    times->seconds = numbers.values;
    return times;
  }

  void read_values(Curve& curve, int accessor, const std::string& path, std::size_t node) {
    const std::size_t rows = curve.key_count() * (curve.interpolation == Interpolation::cubic ? 3 : 1);
    Wanted wanted;
    if (path == "weights") {
      const std::size_t count = content_.model.accessors[static_cast<std::size_t>(accessor)].count;
      const auto& mesh = content_.meshes[static_cast<std::size_t>(content_.model.nodes[node].mesh)];
      curve.parts = mesh.targets > 0 ? mesh.targets : count / rows;
      if (curve.parts == 0 || count % rows != 0 || count / rows != curve.parts) {
        refuse(curve.place, fmt::format("{} weights for {} keys of {} morph targets", count, rows, curve.parts));
      }
      wanted = {.type = TINYGLTF_TYPE_SCALAR, .normalized_too = true, .count = count};
    } else if (path == "rotation") {
      curve.parts = 4;
      wanted = {.type = TINYGLTF_TYPE_VEC4, .normalized_too = true, .count = rows};
      wanted.checked_by_caller = curve.interpolation != Interpolation::cubic;  // check_rotations skips their tangents
    } else {
      curve.parts = 3;
      wanted = {.type = TINYGLTF_TYPE_VEC3, .count = rows};
    }
    curve.values = accessors_.read(accessor, wanted).values;
    // Many channels may refer to one accessor, and each is examined separately.
    budget_.spend(curve.values.size(), sizeof(float), curve.place);
    if (path == "rotation") check_rotations(curve);
  }

  void check_rotations(const Curve& curve) {
    for (std::size_t key = 0; key < curve.key_count(); ++key) {
      const std::span<const float> q = curve.key(key);
      const float square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
      if (!(square > 1e-12f) || !std::isfinite(square)) {
        refuse(curve.place, fmt::format("key {} is a rotation without length; export it again", key));
      }
      if (std::abs(square - 1) > 0.02f) longest_off_ = std::max(longest_off_, std::abs(std::sqrt(square) - 1));
    }
  }

  const Content& content_;
  Accessors& accessors_;
  Budget& budget_;
  const tinygltf::Animation& animation_;
  std::string place_;
  Take take_;
  std::map<int, std::shared_ptr<KeyTimes>> times_;
  std::size_t ignored_ = 0;
  float longest_off_ = 0;
};

}  // namespace

std::string node_text(const Content& content, std::size_t node) {
  const std::string& name = content.model.nodes[node].name;
  return name.empty() ? fmt::format("node {}", node) : fmt::format("node {} '{}'", node, printable(name));
}

Take take_of(const Content& content, Accessors& accessors, Budget& budget, const std::string& wanted,
             std::vector<Notice>& notices) {
  const std::size_t animation = chosen_take(content, wanted, notices);
  return TakeReader(content, accessors, budget, animation).read(notices);
}

}  // namespace signweave::gltf
