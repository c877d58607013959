#include "signweave/formats/gltf/loss.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/core/text.h"

namespace signweave::gltf {
namespace {

/// The largest distance of one kind, and its node.
struct Loss {
  double most = 0;
  std::size_t node = kNoNode;

  void consider(double off, std::size_t at) {
    if (off <= most) return;
    most = off;
    node = at;
  }
  std::string text(const Content& content, const char* unit, double scale) const {
    if (node == kNoNode) return fmt::format("0 {}", unit);
    return fmt::format("{:.2g} {} ({})", most * scale, unit, node_text(content, node));
  }
};

/// Calls `measure(key, frame)` for the keys of a curve that are between frames.
template <typename Measure>
void for_keys_between_frames(const Curve& curve, const Measure& measure) {
  const std::vector<double>& frames = curve.times->frames;
  for (std::size_t key = 0; key < frames.size(); ++key) {
    if (frames[key] != std::floor(frames[key])) measure(key, frames[key]);
  }
}

double degrees_off(const Curve& curve, double frame_seconds, std::size_t key, double frame) {
  CurveReader reader(curve, frame_seconds);
  const double before = std::floor(frame);
  const Eigen::Quaterniond a = reader.rotation_at(before);
  const Eigen::Quaterniond b = reader.rotation_at(before + 1);
  const Eigen::Quaterniond off = a.slerp(frame - before, b).conjugate() * unit_rotation(curve.key(key));
  return 2 * std::atan2(off.vec().norm(), std::abs(off.w())) * 180 / std::numbers::pi;
}

}  // namespace

void report_loss(const Content& content, const Take& take, const std::vector<JointPlace>& places, const Timing& timing,
                 bool rate_given, std::vector<Notice>& notices) {
  const double frame_seconds = timing.rate.frame_time().count();
  Loss turn;
  Loss place;
  Loss weight;
  for (const JointPlace& joint : places) {
    if (const Curve* const curve = joint.rotation_curve) {
      for_keys_between_frames(*curve, [&](std::size_t key, double frame) {
        turn.consider(degrees_off(*curve, frame_seconds, key, frame), joint.node);
      });
    }
    if (const Curve* const curve = joint.translation_curve) {
      CurveReader reader(*curve, frame_seconds);
      for_keys_between_frames(*curve, [&](std::size_t key, double frame) {
        const double before = std::floor(frame);
        const double part = frame - before;
        const Eigen::Vector3d ours = (1 - part) * reader.vector_at(before) + part * reader.vector_at(before + 1);
        const std::span<const float> own = curve->key(key);
        place.consider(joint.scaled.cwiseProduct(ours - Eigen::Vector3d(own[0], own[1], own[2])).norm(), joint.node);
      });
    }
  }
  for (std::size_t node = 0; node < take.nodes.size(); ++node) {
    const Curve* const curve = take.nodes[node].weights;
    if (curve == nullptr) continue;
    CurveReader reader(*curve, frame_seconds);
    for_keys_between_frames(*curve, [&](std::size_t key, double frame) {
      const double before = std::floor(frame);
      const std::span<const double> first = reader.at(before);
      const std::vector<double> kept(first.begin(), first.end());
      const std::span<const double> second = reader.at(before + 1);
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const double ours = kept[i] + (frame - before) * (second[i] - kept[i]);
        weight.consider(std::abs(ours - static_cast<double>(curve->key(key)[i])), node);
      }
    });
  }
  std::string text =
      fmt::format("{} at {} frames a second, so at its keys the motion is off by up to {} and {}",
                  rate_given ? "its keys do not stand" : "its keys stand unevenly and were read",
                  to_string(timing.rate), turn.text(content, "degrees", 1), place.text(content, "mm", 1000));
  if (weight.node != kNoNode) text += fmt::format(", its weights by {:.2g}", weight.most);
  notices.push_back({content.name, std::move(text), rate_given ? Remedies{} : Remedies{{"source_rate", ""}}});
}

}  // namespace signweave::gltf
