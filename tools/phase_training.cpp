#include "tools/phase_training.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace signweave {
namespace {

using Network = std::array<float, PhaseModel::kWeights>;
constexpr std::size_t kHidden = PhaseModel::kHidden;

/// Random numbers that are the same on every machine, unlike the distributions of the standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }
  float normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return static_cast<float>(radius * std::cos(2 * std::numbers::pi * uniform()));
  }

 private:
  std::mt19937_64 bits_;
};

/// The moment of the recording nearest to each frame.
std::vector<std::size_t> nearest_moments(const PhaseFrames& frames, const std::vector<Seconds>& times) {
  std::vector<std::size_t> result(frames.frames);
  for (std::size_t frame = 0; frame < frames.frames; ++frame) {
    const Seconds time = frames.begin + Seconds(static_cast<double>(frame) / kSegmenterRate);
    const auto after = std::lower_bound(times.begin(), times.end(), time);
    auto at = static_cast<std::size_t>(std::min<std::ptrdiff_t>(after - times.begin(), std::ssize(times) - 1));
    if (at > 0 && time - times[at - 1] <= times[at] - time) --at;
    result[frame] = at;
  }
  return result;
}

void add_examples(const LabelledTrack& recording, double tempo, std::vector<TrainingExample>& examples) {
  UpperBodyTrack track = recording.track;
  for (Seconds& time : track.times) time *= tempo;
  for (const PhaseFrames& frames : phase_features(track)) {
    const std::vector<std::size_t> moments = nearest_moments(frames, track.times);
    for (std::size_t frame = 0; frame < frames.frames; ++frame) {
      const std::vector<float>& values = frames.features[static_cast<std::size_t>(frames.leading(frame))];
      TrainingExample& example = examples.emplace_back();
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(frame * kPhaseFeatures), kPhaseFeatures,
                  example.features.begin());
      example.phase = recording.labels[moments[frame]];
    }
  }
}

void set_scale(PhaseModel& model, std::span<const TrainingExample> examples) {
  for (std::size_t i = 0; i < kPhaseFeatures; ++i) {
    double sum = 0;
    double squares = 0;
    for (const TrainingExample& example : examples) sum += example.features[i];
    const double mean = sum / static_cast<double>(examples.size());
    for (const TrainingExample& example : examples)
      squares += (example.features[i] - mean) * (example.features[i] - mean);
    model.mean[i] = static_cast<float>(mean);
    // Limited, so that rounding to 1/4096 does not matter elsewhere: a feature that hardly varies carries no
    // information.
    model.scale[i] = static_cast<float>(1 / std::max(0.01, std::sqrt(squares / static_cast<double>(examples.size()))));
  }
}

void set_steps(PhaseModel& model, std::span<const LabelledTrack* const> recordings, float weight) {
  std::array<std::array<double, kMotionPhases>, kMotionPhases> counts{};
  for (const LabelledTrack* recording : recordings) {
    for (std::size_t i = 1; i < recording->labels.size(); ++i) {
      counts[static_cast<std::size_t>(recording->labels[i - 1])][static_cast<std::size_t>(recording->labels[i])] += 1;
    }
  }
  for (std::size_t from = 0; from < kMotionPhases; ++from) {
    for (double& count : counts[from]) count += 0.05;  // an unseen transition is unlikely, not impossible
    const double sum = std::accumulate(counts[from].begin(), counts[from].end(), 0.0);
    for (std::size_t to = 0; to < kMotionPhases; ++to) {
      model.step[from][to] = weight * static_cast<float>(std::log(counts[from][to] / sum));
    }
  }
}

/// Weights that give every phase the same influence, whatever its share of the frames; their mean is 1.
std::array<float, kMotionPhases> phase_weights(std::span<const TrainingExample> examples) {
  std::array<double, kMotionPhases> counts{};
  for (const TrainingExample& example : examples) counts[static_cast<std::size_t>(example.phase)] += 1;
  const auto present = static_cast<double>(std::ranges::count_if(counts, [](double count) { return count > 0; }));
  std::array<float, kMotionPhases> weights{};
  for (std::size_t phase = 0; phase < kMotionPhases; ++phase) {
    if (counts[phase] > 0) {
      weights[phase] = static_cast<float>(static_cast<double>(examples.size()) / (present * counts[phase]));
    }
  }
  return weights;
}

/// Adds the gradient of one example's loss. `kept` has 0 or 1 / (1 - dropout) for each hidden unit.
void add_gradient(const Network& network, std::span<const float, kPhaseFeatures> scaled, MotionPhase phase,
                  float weight, float doubt, std::span<const float, kHidden> kept, Network& gradient) {
  std::array<float, kHidden> hidden;
  Network thinned = network;  // the last layer sees the hidden one through `kept`
  float* const last = thinned.data() + kHidden * (kPhaseFeatures + 1);
  for (std::size_t to = 0; to < kMotionPhases; ++to) {
    for (std::size_t h = 0; h < kHidden; ++h) last[to * (kHidden + 1) + h] *= kept[h];
  }
  const PhaseProbabilities answer = answer_of(thinned, scaled, hidden);
  std::array<float, kHidden> back{};
  float* const last_gradient = gradient.data() + kHidden * (kPhaseFeatures + 1);
  for (std::size_t to = 0; to < kMotionPhases; ++to) {
    const float wanted = (to == static_cast<std::size_t>(phase) ? 1 - doubt : 0.0F) + doubt / kMotionPhases;
    const float error = weight * (answer[to] - wanted);
    for (std::size_t h = 0; h < kHidden; ++h) {
      last_gradient[to * (kHidden + 1) + h] += error * hidden[h] * kept[h];
      back[h] += error * last[to * (kHidden + 1) + h];
    }
    last_gradient[to * (kHidden + 1) + kHidden] += error;
  }
  for (std::size_t h = 0; h < kHidden; ++h) {
    const float error = back[h] * (1 - hidden[h] * hidden[h]);
    float* const row = gradient.data() + h * (kPhaseFeatures + 1);
    for (std::size_t i = 0; i < kPhaseFeatures; ++i) row[i] += error * scaled[i];
    row[kPhaseFeatures] += error;
  }
}

/// Adam (Kingma and Ba 2015) with decoupled weight decay.
struct Adam {
  Network first{};
  Network second{};
  int steps = 0;

  void step(Network& network, const Network& gradient, float rate, float decay) {
    ++steps;
    const auto n = static_cast<float>(steps);
    const float first_share = 1 - std::pow(0.9F, n);
    const float second_share = 1 - std::pow(0.999F, n);
    for (std::size_t i = 0; i < network.size(); ++i) {
      first[i] = 0.9F * first[i] + 0.1F * gradient[i];
      second[i] = 0.999F * second[i] + 0.001F * gradient[i] * gradient[i];
      const float by = (first[i] / first_share) / (std::sqrt(second[i] / second_share) + 1e-8F);
      network[i] -= rate * (by + decay * network[i]);
    }
  }
};

Network first_weights(Random& random) {
  Network network{};
  for (std::size_t h = 0; h < kHidden; ++h) {
    for (std::size_t i = 0; i < kPhaseFeatures; ++i) {
      network[h * (kPhaseFeatures + 1) + i] = random.normal() / std::sqrt(static_cast<float>(kPhaseFeatures));
    }
  }
  for (std::size_t to = 0; to < kMotionPhases; ++to) {
    for (std::size_t h = 0; h < kHidden; ++h) {
      network[kHidden * (kPhaseFeatures + 1) + to * (kHidden + 1) + h] =
          random.normal() / std::sqrt(static_cast<float>(kHidden));
    }
  }
  return network;
}

Network trained_network(std::span<const TrainingExample> scaled, const TrainingOptions& options, std::uint64_t seed) {
  Random random(seed);
  Network network = first_weights(random);
  Adam adam;
  const std::array<float, kMotionPhases> weights = phase_weights(scaled);
  std::vector<std::size_t> order(scaled.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t batches = std::max<std::size_t>(1, scaled.size() / options.batch);
  const auto steps = static_cast<float>(batches * static_cast<std::size_t>(options.epochs));
  for (int epoch = 0; epoch < options.epochs; ++epoch) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (std::size_t batch = 0; batch < batches; ++batch) {
      Network gradient{};
      const std::size_t begin = batch * options.batch;
      const std::size_t end = std::min(begin + options.batch, scaled.size());
      for (std::size_t i = begin; i < end; ++i) {
        const TrainingExample& example = scaled[order[i]];
        std::array<float, kPhaseFeatures> noisy = example.features;
        for (float& feature : noisy) feature += options.noise * random.normal();
        std::array<float, kHidden> kept;
        for (float& one : kept) one = random.uniform() < options.dropout ? 0.0F : 1 / (1 - options.dropout);
        add_gradient(network, noisy, example.phase,
                     weights[static_cast<std::size_t>(example.phase)] / static_cast<float>(end - begin),
                     options.label_doubt, kept, gradient);
      }
      adam.step(network, gradient, options.rate * (1 - static_cast<float>(adam.steps) / steps), options.decay);
    }
  }
  return network;
}

}  // namespace

PhaseModel train(std::span<const LabelledTrack* const> recordings, const TrainingOptions& options) {
  assert(!recordings.empty());
  std::vector<TrainingExample> examples;
  for (const LabelledTrack* recording : recordings) {
    for (const double tempo : options.tempos) add_examples(*recording, tempo, examples);
  }
  PhaseModel model;
  set_scale(model, examples);
  set_steps(model, recordings, options.step_weight);
  for (TrainingExample& example : examples) example.features = scaled_features(model, example.features);
  for (std::size_t i = 0; i < options.networks; ++i) {
    model.networks.push_back(trained_network(examples, options, 1 + i));
  }
  return unpacked(packed(model));
}

std::vector<MotionPhase> predicted_phases(const PhaseModel& model, const LabelledTrack& recording) {
  std::vector<MotionPhase> result(recording.labels.size(), MotionPhase::rest);
  std::size_t moment = 0;
  for (const PhaseFrames& frames : phase_features(recording.track)) {
    std::vector<float> leading(frames.frames * kPhaseFeatures);
    for (std::size_t frame = 0; frame < frames.frames; ++frame) {
      const auto at = static_cast<std::ptrdiff_t>(frame * kPhaseFeatures);
      const std::vector<float>& values = frames.features[static_cast<std::size_t>(frames.leading(frame))];
      std::copy_n(values.begin() + at, kPhaseFeatures, leading.begin() + at);
    }
    const std::vector<MotionPhase> phases = most_likely_phases(model, phase_probabilities(model, leading));
    const Seconds end = frames.begin + Seconds((static_cast<double>(frames.frames) + 1) / kSegmenterRate);
    for (; moment < result.size() && recording.track.times[moment] < end; ++moment) {
      const double frame = (recording.track.times[moment] - frames.begin).count() * kSegmenterRate;
      result[moment] = phases[std::min(static_cast<std::size_t>(std::lround(frame)), phases.size() - 1)];
    }
  }
  return result;
}

}  // namespace signweave
