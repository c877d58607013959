#include "signweave/choose/target_cost.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

float median_of(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Raises each value in `worst` to its deviation from the median, if that is larger. Deviations below `least` are
/// ignored, so that nearly equal tokens are not penalized.
void deviate(const std::vector<float>& values, float least, bool above_only, std::vector<float>& worst) {
  const float median = median_of(values);
  std::vector<float> distances;
  for (const float value : values) distances.push_back(std::abs(value - median));
  const float spread = std::max(1.4826f * median_of(distances), least);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float above = (values[i] - median) / spread;
    worst[i] = std::max(worst[i], above_only ? above : std::abs(above));
  }
}

/// The same for the hands' positions at one end, by their distance from the centre of all.
void deviate_places(const std::vector<const JoinPoint*>& points, std::vector<float>& worst) {
  std::vector<float> distances(points.size());
  for (std::size_t value = JoinPoint::kPlace; value < JoinPoint::kVelocity; ++value) {
    std::vector<float> values;
    for (const JoinPoint* point : points) values.push_back(point->values[value]);
    const float median = median_of(values);
    for (std::size_t i = 0; i < values.size(); ++i) distances[i] += (values[i] - median) * (values[i] - median);
  }
  for (float& distance : distances) distance = std::sqrt(distance);
  constexpr float kLeast = 0.1f;  // shoulder widths
  deviate(distances, kLeast, true, worst);
}

}  // namespace

std::string_view name_of(TargetTerm term) noexcept {
  constexpr std::array<std::string_view, kTargetTerms> kNames = {"left",       "right",   "phases", "preparation",
                                                                 "retraction", "outlier", "defects"};
  return kNames[static_cast<std::size_t>(term)];
}

float cost_of(DefectKind kind) noexcept {
  switch (kind) {
    case DefectKind::not_finite:
      return 4;
    case DefectKind::t_pose:
      return 2;
    case DefectKind::jump:
      return 1;
    case DefectKind::frozen_joint:
    case DefectKind::permuted_root:
    case DefectKind::scale:
      return 0.5f;
    case DefectKind::quaternion_flip:  // stored motions stay in one hemisphere from frame to frame
      return 0;
  }
  return 0;
}

float defect_cost(std::span<const Defect> defects, FrameRange frames) noexcept {
  unsigned seen = 0;
  float sum = 0;
  for (const Defect& defect : defects) {
    const unsigned bit = 1u << static_cast<unsigned>(defect.kind);
    const bool overlaps =
        defect.frames.empty() || (defect.frames.begin < frames.end && frames.begin < defect.frames.end);
    if (!overlaps || (seen & bit) != 0) continue;
    seen |= bit;
    sum += cost_of(defect.kind);
  }
  return sum;
}

std::vector<float> outliers_of(std::span<const SignJoin* const> tokens) {
  std::vector<float> beyond(tokens.size());
  std::vector<std::size_t> known;
  std::vector<float> durations;
  std::vector<float> paths;
  std::vector<const JoinPoint*> begins;
  std::vector<const JoinPoint*> ends;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const SignJoin* token = tokens[i];
    if (token == nullptr || token->begin.known == 0 || token->end.known == 0) continue;
    known.push_back(i);
    durations.push_back(std::log(std::max(token->stroke_seconds, 0.01f)));
    paths.push_back(std::log(token->path + 0.05f));
    begins.push_back(&token->begin);
    ends.push_back(&token->end);
  }
  if (known.size() < kFewestTokens) return beyond;
  std::vector<float> worst(known.size());
  constexpr float kLeast = 0.1f;  // a tenth of duration or path
  deviate(durations, kLeast, false, worst);
  deviate(paths, kLeast, false, worst);
  deviate_places(begins, worst);
  deviate_places(ends, worst);
  constexpr float kMost = 4;
  for (std::size_t i = 0; i < known.size(); ++i) beyond[known[i]] = std::clamp(worst[i] - kOutlier, 0.0f, kMost);
  return beyond;
}

}  // namespace signweave
