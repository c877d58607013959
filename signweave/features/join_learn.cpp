#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "signweave/features/join.h"

// Pairwise ranking: the probability that the recorded join is preferred to the other is 1 / (1 + exp(-w · x)), with x =
// the other's terms minus the recorded one's. The weights of maximum likelihood are found by Newton's method; a weight
// that would become negative stays at 0.

namespace signweave {
namespace {

constexpr int kTerms = static_cast<int>(kJoinTerms);
using Vector = Eigen::Matrix<double, kTerms, 1>;
using Matrix = Eigen::Matrix<double, kTerms, kTerms>;

Vector of(const JoinTerms& terms) {
  Vector vector;
  for (int i = 0; i < kTerms; ++i) vector[i] = static_cast<double>(terms[static_cast<std::size_t>(i)]);
  return vector;
}

struct Example {
  Vector x;           ///< other minus recorded, scaled
  double weight = 1;  ///< 1 / number of comparisons of its pair
  std::uint32_t recording = 0;
};

/// The input of a fit: all examples except those of one fold, and the strength of the regularisation towards equal
/// weights. The magnitude of the equal weights only expresses certainty, so it is fitted first.
struct Fit {
  const std::vector<Example>& examples;
  std::uint32_t folds = 0;  ///< 0: no fold is left out
  std::uint32_t left_out = 0;
  double prior = 0;  ///< pairs
  double equal = 1;  ///< the common value of equal weights

  template <typename See>
  void each(const See& see) const {
    for (const Example& example : examples) {
      if (folds == 0 || example.recording % folds != left_out) see(example);
    }
  }
  double pull() const { return prior / (kTerms * equal * equal); }
};

/// The loss of a difference, which is correct if positive.
double loss_of(double z) {
  return z > 0 ? std::log1p(std::exp(-z)) : std::log1p(std::exp(z)) - z;
}

double loss(const Fit& fit, const Vector& w) {
  double sum = 0.5 * fit.pull() * (w - Vector::Constant(fit.equal)).squaredNorm();
  fit.each([&](const Example& example) { sum += example.weight * loss_of(w.dot(example.x)); });
  return sum;
}

/// Returns the best common weight, between 1/20 and 20.
double equal_weight(const Fit& fit) {
  double low = std::log(0.05);
  double high = std::log(20.0);
  const auto at = [&](double logarithm) {
    double sum = 0;
    fit.each([&](const Example& example) { sum += example.weight * loss_of(std::exp(logarithm) * example.x.sum()); });
    return sum;
  };
  for (int round = 0; round < 30; ++round) {  // ternary search: the loss is convex in the weight
    const double left = low + (high - low) / 3;
    const double right = high - (high - low) / 3;
    if (at(left) < at(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return std::exp((low + high) / 2);
}

Vector solve(Fit fit) {
  fit.equal = equal_weight(fit);
  Vector w = Vector::Constant(fit.equal);
  double now = loss(fit, w);
  for (int round = 0; round < 50; ++round) {
    Vector gradient = fit.pull() * (w - Vector::Constant(fit.equal));
    Matrix hessian = Matrix::Identity() * fit.pull();
    fit.each([&](const Example& example) {
      const double p = 1.0 / (1.0 + std::exp(w.dot(example.x)));  // probability that the other is preferred
      gradient -= example.weight * p * example.x;
      hessian += example.weight * p * (1 - p) * example.x * example.x.transpose();
    });
    for (int i = 0; i < kTerms; ++i) {  // a weight that is 0 and would decrease is fixed
      if (w[i] > 0 || gradient[i] < 0) continue;
      gradient[i] = 0;
      hessian.row(i).setZero();
      hessian.col(i).setZero();
      hessian(i, i) = 1;
    }
    const Vector step = hessian.ldlt().solve(gradient);
    double length = 1;
    Vector next = (w - step).cwiseMax(0);
    double there = loss(fit, next);
    while (there > now && length > 1e-6) {
      length /= 2;
      next = (w - length * step).cwiseMax(0);
      there = loss(fit, next);
    }
    if (!(there < now)) break;
    const bool done = now - there < 1e-10 * (1 + now);
    w = next;
    now = there;
    if (done) break;
  }
  return w;
}

/// The performance of a prior.
struct Judged {
  double prior = 0;
  double loss = 0;  ///< on the pairs left out, without the regularisation term
  double wins = 0;  ///< in [0, 1], on the same pairs
};

Judged judge(const std::vector<Example>& examples, std::uint32_t folds, double prior) {
  Judged judged{.prior = prior};
  double all = 0;
  for (std::uint32_t fold = 0; fold < std::max(folds, 1u); ++fold) {
    const Vector w = solve({.examples = examples, .folds = folds, .left_out = fold, .prior = prior});
    for (const Example& example : examples) {
      if (folds > 0 && example.recording % folds != fold) continue;
      const double z = w.dot(example.x);
      all += example.weight;
      judged.loss += example.weight * loss_of(z);
      if (z > 0) judged.wins += example.weight;
    }
  }
  judged.wins /= all;
  return judged;
}

/// Returns the best prior by cross-validation; without cross-validation, kPriorPairs.
Judged judge_priors(const std::vector<Example>& examples, std::uint32_t folds) {
  if (folds == 0) return judge(examples, 0, kPriorPairs);
  Judged best = judge(examples, folds, 256 * kPriorPairs);
  for (const double times : {16.0, 4.0, 1.0, 0.25}) {
    const Judged one = judge(examples, folds, times * kPriorPairs);
    if (one.loss < best.loss) best = one;
  }
  return best;
}

}  // namespace

JoinWeights learn_join_weights(std::span<const JoinComparison> comparisons, float speed_limit) {
  JoinWeights learned;
  if (comparisons.empty()) return learned;
  learned.speed_limit = speed_limit;
  const JoinWeights defaults;
  Vector mean = Vector::Zero();
  for (const JoinComparison& one : comparisons) mean += of(one.other);
  mean /= static_cast<double>(comparisons.size());
  // A term that hardly varies in a corpus must not become decisive: no weight may exceed about kMost times its default.
  constexpr double kMost = 10;
  Vector scale = mean;
  for (int i = 0; i < kTerms; ++i) {
    const auto common = static_cast<double>(defaults.weights[static_cast<std::size_t>(i)]);
    // 0: the term never occurs, and nothing is learned about it.
    scale[i] = mean[i] > 1e-9 ? std::max(mean[i], 1.0 / (kTerms * kMost * common)) : 0;
  }
  std::vector<Example> examples;
  std::set<std::uint32_t> recordings;
  for (std::size_t begin = 0; begin < comparisons.size();) {
    std::size_t end = begin;
    while (end < comparisons.size() && comparisons[end].pair == comparisons[begin].pair) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      Vector x = of(comparisons[i].other) - of(comparisons[i].recorded);
      for (int k = 0; k < kTerms; ++k) x[k] = scale[k] > 0 ? x[k] / scale[k] : 0;
      examples.push_back({x, 1.0 / static_cast<double>(end - begin), comparisons[i].recording});
      recordings.insert(comparisons[i].recording);
    }
    ++learned.pairs;
    begin = end;
  }
  // Recordings are renumbered, so that each fold has some.
  const std::vector<std::uint32_t> order(recordings.begin(), recordings.end());
  for (Example& example : examples) {
    example.recording =
        static_cast<std::uint32_t>(std::lower_bound(order.begin(), order.end(), example.recording) - order.begin());
  }
  learned.comparisons = static_cast<std::uint32_t>(examples.size());
  constexpr std::uint32_t kMostFolds = 5;
  learned.folds = order.size() < 2 ? 0 : std::min<std::uint32_t>(kMostFolds, static_cast<std::uint32_t>(order.size()));
  const Judged best = judge_priors(examples, learned.folds);
  const Vector w = solve({.examples = examples, .prior = best.prior});
  double won = 0;
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const JoinComparison& one = comparisons[i];
    const bool wins = cost_of(one.recorded, defaults.weights) < cost_of(one.other, defaults.weights);
    if (wins) won += examples[i].weight;
  }
  learned.default_wins = static_cast<float>(std::min(1.0, won / learned.pairs));
  // Weights that do not beat the defaults on recordings left out are discarded.
  const bool better = static_cast<float>(best.wins) > learned.default_wins;
  learned.wins = better ? static_cast<float>(best.wins) : learned.default_wins;
  Vector weights = of(defaults.weights);
  for (int i = 0; i < kTerms; ++i) {
    if (better && scale[i] > 0) weights[i] = w[i] / scale[i];
  }
  // A randomly chosen join must cost 1 on average. A term that never occurs does not contribute, and keeps its default.
  const double random_cost = weights.dot(mean);
  for (int i = 0; i < kTerms; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (scale[i] > 0 && random_cost > 0) learned.weights[k] = static_cast<float>(weights[i] / random_cost);
  }
  // In transitions of average duration hands do not hurry, so this weight cannot be learned from them.
  float& speed = learned.weights[static_cast<std::size_t>(JoinTerm::speed)];
  speed = std::max(speed, defaults.weights[static_cast<std::size_t>(JoinTerm::speed)]);
  return learned;
}

}  // namespace signweave
