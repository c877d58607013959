#include "signweave/features/phase_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace signweave {
namespace {

constexpr std::size_t kHidden = PhaseModel::kHidden;
constexpr float kPackedUnit = 4096;

constexpr int kBuiltIn[] = {
#include "signweave/features/phase_weights.inc"
};

/// Calls `visit` with every parameter of a model, always in the same order.
template <class Model, class Visit>
void for_each_number(Model& model, const Visit& visit) {
  for (auto& number : model.mean) visit(number);
  for (auto& number : model.scale) visit(number);
  for (auto& row : model.step) {
    for (auto& number : row) visit(number);
  }
  for (auto& network : model.networks) {
    for (auto& number : network) visit(number);
  }
}

}  // namespace

std::array<float, kPhaseFeatures> scaled_features(const PhaseModel& model,
                                                  std::span<const float, kPhaseFeatures> features) noexcept {
  std::array<float, kPhaseFeatures> scaled;
  for (std::size_t i = 0; i < kPhaseFeatures; ++i) {
    scaled[i] = std::clamp((features[i] - model.mean[i]) * model.scale[i], -4.0F, 4.0F);
  }
  return scaled;
}

PhaseProbabilities answer_of(std::span<const float, PhaseModel::kWeights> network,
                             std::span<const float, kPhaseFeatures> scaled,
                             std::span<float, PhaseModel::kHidden> hidden) noexcept {
  const float* weight = network.data();
  for (float& one : hidden) {
    float sum = 0;
    for (const float feature : scaled) sum += *weight++ * feature;
    one = std::tanh(sum + *weight++);
  }
  PhaseProbabilities answer;
  for (float& one : answer) {
    one = 0;
    for (const float middle : hidden) one += *weight++ * middle;
    one += *weight++;
  }
  const float largest = *std::max_element(answer.begin(), answer.end());
  float sum = 0;
  for (float& one : answer) sum += one = std::exp(one - largest);
  for (float& one : answer) one /= sum;
  return answer;
}

std::vector<PhaseProbabilities> phase_probabilities(const PhaseModel& model, std::span<const float> features) {
  assert(features.size() % kPhaseFeatures == 0 && !model.networks.empty());
  std::vector<PhaseProbabilities> result(features.size() / kPhaseFeatures);
  std::array<float, kHidden> hidden;
  const float share = 1.0F / static_cast<float>(model.networks.size());
  for (std::size_t frame = 0; frame < result.size(); ++frame) {
    const auto scaled = scaled_features(model, features.subspan(frame * kPhaseFeatures).first<kPhaseFeatures>());
    PhaseProbabilities& sum = result[frame] = {};
    for (const auto& network : model.networks) {
      const PhaseProbabilities one = answer_of(network, scaled, hidden);
      for (std::size_t phase = 0; phase < kMotionPhases; ++phase) sum[phase] += share * one[phase];
    }
  }
  return result;
}

std::vector<MotionPhase> most_likely_phases(const PhaseModel& model, std::span<const PhaseProbabilities> frames) {
  if (frames.empty()) return {};
  std::array<double, kMotionPhases> best{};  // double precision for sums over an hour of frames
  std::vector<std::array<std::uint8_t, kMotionPhases>> from(frames.size());
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const std::array<double, kMotionPhases> before = best;
    for (std::size_t to = 0; to < kMotionPhases; ++to) {
      std::size_t source = to;
      if (frame > 0) {
        for (std::size_t phase = 0; phase < kMotionPhases; ++phase) {
          if (before[phase] + model.step[phase][to] > before[source] + model.step[source][to]) source = phase;
        }
        best[to] = before[source] + model.step[source][to];
      }
      // A confident prediction of the networks must still be able to be overruled.
      best[to] += std::log(frames[frame][to] + 1e-3F);
      from[frame][to] = static_cast<std::uint8_t>(source);
    }
  }
  std::vector<MotionPhase> result(frames.size());
  auto phase = static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
  for (std::size_t frame = frames.size(); frame-- > 0;) {
    result[frame] = static_cast<MotionPhase>(phase);
    phase = from[frame][phase];
  }
  return result;
}

std::vector<int> packed(const PhaseModel& model) {
  std::vector<int> numbers;
  for_each_number(model, [&](float number) { numbers.push_back(static_cast<int>(std::lround(number * kPackedUnit))); });
  return numbers;
}

PhaseModel unpacked(std::span<const int> numbers) {
  constexpr std::size_t kHead = 2 * kPhaseFeatures + kMotionPhases * kMotionPhases;
  assert(numbers.size() > kHead && (numbers.size() - kHead) % PhaseModel::kWeights == 0);
  PhaseModel model;
  model.networks.resize((numbers.size() - kHead) / PhaseModel::kWeights);
  std::size_t next = 0;
  for_each_number(model, [&](float& number) { number = static_cast<float>(numbers[next++]) / kPackedUnit; });
  return model;
}

const PhaseModel& built_in_phase_model() {
  static const PhaseModel model = unpacked(kBuiltIn);
  return model;
}

}  // namespace signweave
