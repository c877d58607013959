#include "signweave/transition/quieten.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "signweave/features/short_fit.h"
#include "signweave/transition/curves.h"

namespace signweave {
namespace {

constexpr float kShrink = 3;
constexpr double kFade = 0.06;  // seconds

/// The share of a term that remains.
float kept(float square, float noise) noexcept {
  return square > kShrink * noise ? 1 - kShrink * noise / square : 0.0f;
}

/// Processes one side, [frame from the border][x y z][taken]. Returns true if anything was changed.
bool quieten_side(const GapScratch& scratch, const CaptureNoise& noise, std::vector<float>& seen,
                  std::vector<float>& offsets) {
  const std::size_t width = scratch.taken.size();
  const std::size_t samples = width > 0 ? seen.size() / (3 * width) : 0;
  if (samples < ShortFit::kTerms || samples > ShortFit::kMost) return false;
  const ShortFit& fit = ShortFit::of(samples);
  std::array<Eigen::Vector3f, ShortFit::kMost> path;
  bool changed = false;
  for (std::size_t i = 0; i < width; ++i) {
    if (scratch.fills_block(i)) continue;
    const float deviation =
        i < scratch.turned ? noise.rotations[scratch.taken[i]] : noise.translations[scratch.taken[i]];
    if (!(deviation > 0)) continue;
    float all = 0;
    for (std::size_t k = 0; k < samples; ++k) {
      const float* at = seen.data() + 3 * width * k + i;
      path[k] = {at[0], at[width], at[2 * width]};
      all += path[k].squaredNorm();
    }
    const ShortFit::Terms terms = fit.terms_of({path.data(), samples});
    const float variance = 3 * deviation * deviation;  // over all axes
    const float velocity = kept(terms[1].squaredNorm(), variance);
    const float curvature = kept(terms[2].squaredNorm(), variance);
    const float rest_square = all - terms[0].squaredNorm() - terms[1].squaredNorm() - terms[2].squaredNorm();
    const float rest = kept(rest_square, variance * static_cast<float>(samples - 3));
    changed = true;
    for (std::size_t k = 0; k < samples; ++k) {
      const Eigen::Vector3f mean = fit.at(0, k) * terms[0];
      const Eigen::Vector3f line = fit.at(1, k) * terms[1];
      const Eigen::Vector3f bow = fit.at(2, k) * terms[2];
      const Eigen::Vector3f quiet = mean + velocity * line + curvature * bow + rest * (path[k] - mean - line - bow);
      float* at = seen.data() + 3 * width * k + i;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const auto place = static_cast<std::size_t>(axis) * width;
        if (k == 0) offsets[place + i] = path[0][axis] - quiet[axis];
        at[place] = quiet[axis];
      }
    }
  }
  fill_blocks(scratch, seen);
  fill_blocks(scratch, offsets);
  return changed;
}

}  // namespace

bool quieten(const GapJob& job) {
  GapScratch& scratch = job.scratch;
  const std::array<const CaptureNoise*, 2> noise = {job.gap.noise_before, job.gap.noise_after};
  bool changed = false;
  for (std::size_t side = 0; side < 2; ++side) {
    scratch.offsets[side].assign(3 * scratch.taken.size(), 0.0f);
    if (noise[side] == nullptr) continue;
    assert(noise[side]->rotations.size() == job.gap.before.joints());
    assert(noise[side]->translations.size() == job.gap.before.moved());
    changed |= quieten_side(scratch, *noise[side], scratch.seen[side], scratch.offsets[side]);
  }
  return changed;
}

float offset_left(double seconds, double gap) noexcept {
  const double x = std::min(1.0, seconds / std::min(kFade, gap / 2));
  return static_cast<float>(1 - x * x * (3 - 2 * x));
}

}  // namespace signweave
