#include "signweave/inflection/captured_stroke.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "signweave/inflection/slots.h"

namespace signweave {
namespace {

using inflection::slot;

CapturedStroke::Sample sample_of(StrokeChanger& changer, const StrokeSpace& space, Pose pose, float time) {
  CapturedStroke::Sample sample{.pose = std::move(pose), .time = time};
  const PoseView view = std::as_const(sample.pose).view();
  for (const Side side : kSides) {
    if (!changer.has(side)) continue;
    sample.hands[slot(side)] = changer.look(view, space, side);
    sample.bend[slot(side)] = changer.bend(side);
  }
  return sample;
}

}  // namespace

Eigen::Vector3f CapturedStroke::palm(const Sample& sample, Side side) const noexcept {
  if (together()) return (sample.hands[0].palm + sample.hands[1].palm) / 2;
  return sample.hands[slot(side)].palm;
}

CapturedStroke captured_stroke(StrokeChanger& changer, const MotionSource& source, FrameRange core) {
  CapturedStroke stroke{.core = core};
  const std::int64_t count = std::min(core.size(), kStrokeSamples);
  for (auto& depths : stroke.depth) depths.fill(-std::numeric_limits<float>::max());
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t frame = count > 1 ? i * (core.size() - 1) / (count - 1) : 0;
    Pose pose(changer.skeleton());
    source.read({core.begin + frame, core.begin + frame + 1}, {pose.rotations, pose.translations});
    if (i == 0) stroke.space = changer.space_of(std::as_const(pose).view());
    const float time = static_cast<float>(frame) / static_cast<float>(std::max<std::int64_t>(core.size() - 1, 1));
    CapturedStroke::Sample& sample =
        stroke.samples.emplace_back(sample_of(changer, stroke.space, std::move(pose), time));
    HandMeter& meter = changer.meter();
    meter.look(std::as_const(sample.pose).view());
    for (const Side side : kSides) {
      if (!changer.has(side) || !meter.has(side)) continue;
      sample.touched[slot(side)] = meter.touched(side);
      for (std::size_t k = 0; k < kBodyObstacles.size(); ++k) {
        float& deepest = stroke.depth[slot(side)][k];
        deepest = std::max(deepest, -meter.to(side, kBodyObstacles[k]).clearance);
      }
      if (i > 0) {
        const CapturedStroke::Sample& before = stroke.samples[static_cast<std::size_t>(i) - 1];
        stroke.path_length[slot(side)] += (sample.hands[slot(side)].palm - before.hands[slot(side)].palm).norm();
      }
    }
    if (changer.has(Side::left) && changer.has(Side::right)) meter.meet(stroke.meeting);
  }
  stroke.dominant =
      !changer.has(Side::right) || (changer.has(Side::left) && stroke.path_length[0] > 1.2f * stroke.path_length[1])
          ? Side::left
          : Side::right;
  if (changer.has(Side::left) && changer.has(Side::right)) {
    stroke.touch = std::ranges::any_of(stroke.samples, [](const CapturedStroke::Sample& one) {
      return signweave::has(one.touched[0], Contact::hands) || signweave::has(one.touched[1], Contact::hands);
    });
    const float shorter = std::min(stroke.path_length[0], stroke.path_length[1]);
    const float longer = std::max(stroke.path_length[0], stroke.path_length[1]);
    const float waist = changer.body().heights[static_cast<std::size_t>(Height::chest)] * changer.body().shoulder_width;
    const auto rests = [&](Side side) {
      return stroke.first(side).palm.y() < waist && stroke.last(side).palm.y() < waist;
    };
    stroke.both_move = shorter > kMovesToo * longer && !rests(Side::left) && !rests(Side::right);
  }
  return stroke;
}

}  // namespace signweave
