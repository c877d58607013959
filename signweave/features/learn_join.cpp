#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "signweave/features/join.h"

// Pairwise ranking: the probability that a recorded join is told from another is 1 / (1 + exp(-w · x)), with x the
// other's terms less the recorded one's. The weights that make the recorded ones most likely are found by Newton's
// method; a weight that would fall below 0 stays there.

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
  Vector x;           ///< other less recorded, scaled
  double weight = 1;  ///< of its pair's comparisons each the same part of 1
  std::uint32_t recording = 0;
};

/// What a fit looks at: all examples but those of one fold, and how strongly it is drawn to equal weights. How large
/// those are tells only how sure one can be, so that is fitted first.
struct Fit {
  const std::vector<Example>& examples;
  std::uint32_t folds = 0;  ///< 0: none is left out
  std::uint32_t left_out = 0;
  double prior = 0;  ///< pairs
  double equal = 1;  ///< the weight that all have where they are equal

  template <typename See>
  void each(const See& see) const {
    for (const Example& example : examples) {
      if (folds == 0 || example.recording % folds != left_out) see(example);
    }
  }
  double pull() const { return prior / (kTerms * equal * equal); }
};

/// Of a difference that is right where it is positive.
double loss_of(double z) {
  return z > 0 ? std::log1p(std::exp(-z)) : std::log1p(std::exp(z)) - z;
}

double loss(const Fit& fit, const Vector& w) {
  double sum = 0.5 * fit.pull() * (w - Vector::Constant(fit.equal)).squaredNorm();
  fit.each([&](const Example& example) { sum += example.weight * loss_of(w.dot(example.x)); });
  return sum;
}

/// The equal weights that do best, between a twentieth and 20.
double equal_weight(const Fit& fit) {
  double low = std::log(0.05);
  double high = std::log(20.0);
  const auto at = [&](double logarithm) {
    double sum = 0;
    fit.each([&](const Example& example) { sum += example.weight * loss_of(std::exp(logarithm) * example.x.sum()); });
    return sum;
  };
  for (int round = 0; round < 30; ++round) {  // the loss is convex in the weight, so it has one valley
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
      const double p = 1.0 / (1.0 + std::exp(w.dot(example.x)));  // that the other wins
      gradient -= example.weight * p * example.x;
      hessian += example.weight * p * (1 - p) * example.x * example.x.transpose();
    });
    for (int i = 0; i < kTerms; ++i) {  // a weight that is 0 and would fall is left alone
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

/// How well a prior does.
struct Judged {
  double prior = 0;
  double loss = 0;  ///< of the pairs that were left out, without the prior's own part
  double wins = 0;  ///< in [0, 1], of the same
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

/// The prior that does best by cross-validation; where there is none, the one in the middle.
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
  // What hardly varies in a corpus is not made decisive: no weight may become more than about kMost times its default.
  constexpr double kMost = 10;
  Vector scale = mean;
  for (int i = 0; i < kTerms; ++i) {
    const auto common = static_cast<double>(defaults.weights[static_cast<std::size_t>(i)]);
    // 0: it is never there, and nothing is learned of it.
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
  // Recordings are numbered anew, so that each fold has some.
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
  // What does not beat the defaults on recordings left out is not taken.
  const bool better = static_cast<float>(best.wins) > learned.default_wins;
  learned.wins = better ? static_cast<float>(best.wins) : learned.default_wins;
  Vector weights = of(defaults.weights);
  for (int i = 0; i < kTerms; ++i) {
    if (better && scale[i] > 0) weights[i] = w[i] / scale[i];
  }
  // A blindly chosen join is to cost 1. A term that is never there has no part in that, and keeps its default.
  const double blind = weights.dot(mean);
  for (int i = 0; i < kTerms; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (scale[i] > 0 && blind > 0) learned.weights[k] = static_cast<float>(weights[i] / blind);
  }
  // In the time that transitions have on average nobody hurries, so this is not learned of the hurried ones.
  float& speed = learned.weights[static_cast<std::size_t>(JoinTerm::speed)];
  speed = std::max(speed, defaults.weights[static_cast<std::size_t>(JoinTerm::speed)]);
  return learned;
}

}  // namespace signweave
