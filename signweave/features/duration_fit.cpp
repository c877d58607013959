#include "signweave/features/duration_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace signweave {
namespace {

/// The inputs of the linear model of the logarithm of the duration; the first is 1.
constexpr int kInputs = 5;
using Inputs = Eigen::Matrix<double, kInputs, 1>;

constexpr double kLeastDistance = 0.02;  // metres: accuracy of a hand's position
/// A fit is used only if its error is below this fraction of the mean's error.
constexpr double kWorthwhile = 0.95;
constexpr double kRidge = 2.0;  // transitions
constexpr int kRounds = 25;
constexpr double kLeastResidual = 0.05;  // in the logarithm: residuals below this count as equal

bool known(const TransitionTask& task) noexcept {
  return task.hands[0].known || task.hands[1].known;
}

/// Returns the hand that moves farther. The task must be known.
const HandTask& busier_of(const TransitionTask& task) noexcept {
  const auto distance = [&](std::size_t side) { return task.hands[side].known ? task.hands[side].distance : -1.0f; };
  return task.hands[distance(1) >= distance(0) ? 1 : 0];
}

Inputs inputs_of(const TransitionTask& task) noexcept {
  const HandTask& busier = busier_of(task);
  const double shape = std::max(task.hands[0].handshape_change, task.hands[1].handshape_change);
  Inputs inputs;
  inputs << 1.0, std::log(static_cast<double>(busier.distance) + kLeastDistance), static_cast<double>(busier.approach),
      static_cast<double>(busier.speed_before) + static_cast<double>(busier.speed_after), shape;
  return inputs;
}

struct Row {
  Inputs inputs;
  double distance = 0;
  double seconds = 0;
  std::size_t part = 0;  ///< group in the cross-validation
};

/// A model fitted to some rows.
struct Model {
  Inputs weights = Inputs::Zero();
  Inputs low = Inputs::Zero();  ///< bounds to which inputs are clamped
  Inputs high = Inputs::Zero();
  double mean = 0;
  double least = 0;
  double most = 0;
  double fastest = 0;

  Inputs within(const Inputs& inputs) const noexcept { return inputs.cwiseMax(low).cwiseMin(high); }
  double seconds(const Inputs& inputs, double distance) const noexcept {
    const double predicted = std::exp(weights.dot(within(inputs)));
    return std::clamp(fastest > 0 ? std::max(predicted, distance / fastest) : predicted, least, most);
  }
};

/// Least absolute deviations of the logarithm by reweighted least squares, inputs in units of their spread.
void solve(std::span<const Row> rows, Model& model) {
  const auto count = static_cast<double>(rows.size());
  Inputs mean = Inputs::Zero();
  Inputs spread = Inputs::Zero();
  for (const Row& row : rows) mean += model.within(row.inputs) / count;
  for (const Row& row : rows) spread += (model.within(row.inputs) - mean).cwiseAbs2() / count;
  spread = spread.cwiseSqrt();
  const auto scaled = [&](const Row& row) {
    Inputs x = model.within(row.inputs) - mean;
    for (int i = 1; i < kInputs; ++i)
      x[i] = spread[i] > 1e-6 ? x[i] / spread[i] : 0.0;  // a constant input carries no information
    x[0] = 1;
    return x;
  };
  Inputs weights = Inputs::Zero();
  for (int round = 0; round <= kRounds; ++round) {
    Eigen::Matrix<double, kInputs, kInputs> squares = Eigen::Matrix<double, kInputs, kInputs>::Zero();
    Inputs right = Inputs::Zero();
    double all = 0;
    for (const Row& row : rows) {
      const Inputs x = scaled(row);
      const double wanted = std::log(row.seconds);
      const double trust = round == 0 ? 1.0 : 1.0 / std::max(kLeastResidual, std::abs(wanted - weights.dot(x)));
      squares += trust * x * x.transpose();
      right += trust * wanted * x;
      all += trust;
    }
    for (int i = 1; i < kInputs; ++i) squares(i, i) += kRidge * all / count;
    weights = squares.ldlt().solve(right);
  }
  for (int i = 1; i < kInputs; ++i) {
    weights[i] = spread[i] > 1e-6 ? weights[i] / spread[i] : 0.0;
    weights[0] -= weights[i] * mean[i];
  }
  model.weights = weights;
}

/// Fits a model to at least one row.
Model learn(std::span<const Row> rows) {
  Model model{.least = rows.front().seconds, .most = rows.front().seconds};
  std::vector<double> sorted(rows.size());
  for (int i = 0; i < kInputs; ++i) {
    std::ranges::transform(rows, sorted.begin(), [i](const Row& row) { return row.inputs[i]; });
    std::ranges::sort(sorted);
    model.low[i] = sorted[sorted.size() / 20];
    model.high[i] = sorted[sorted.size() - 1 - sorted.size() / 20];
  }
  for (const Row& row : rows) {
    model.mean += row.seconds / static_cast<double>(rows.size());
    model.least = std::min(model.least, row.seconds);
    model.most = std::max(model.most, row.seconds);
    model.fastest = std::max(model.fastest, row.distance / row.seconds);
  }
  solve(rows, model);
  return model;
}

/// Errors with one group left out at a time.
struct Errors {
  double mean = 0;
  double fitted = 0;
};
Errors cross_validate(std::span<const Row> rows, std::size_t parts) {
  Errors errors;
  for (std::size_t part = 0; part < parts; ++part) {
    std::vector<Row> learnt;
    std::ranges::copy_if(rows, std::back_inserter(learnt), [part](const Row& row) { return row.part != part; });
    if (learnt.empty()) continue;
    const Model model = learn(learnt);
    for (const Row& row : rows) {
      if (row.part != part) continue;
      errors.mean += std::abs(row.seconds - model.mean) / static_cast<double>(rows.size());
      errors.fitted +=
          std::abs(row.seconds - model.seconds(row.inputs, row.distance)) / static_cast<double>(rows.size());
    }
  }
  return errors;
}

/// Numbers the recordings from 0; a single recording is divided into fifths, in order. Returns the number of groups.
std::size_t part(std::span<const TimedTransition> transitions, std::vector<Row>& rows) {
  std::vector<std::size_t> seen;
  std::size_t at = 0;
  for (const TimedTransition& one : transitions) {
    if (!known(one.task) || one.duration <= Seconds(0)) continue;
    auto found = std::ranges::find(seen, one.recording);
    if (found == seen.end()) found = seen.insert(seen.end(), one.recording);
    rows[at++].part = static_cast<std::size_t>(found - seen.begin());
  }
  if (seen.size() > 1) return seen.size();
  constexpr std::size_t kParts = 5;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].part = i * kParts / rows.size();
  return kParts;
}

}  // namespace

HandTask task_from(const HandThere& from, const HandThere& to) noexcept {
  const Eigen::Vector3f displacement = to.place - from.place;
  HandTask task{.known = true,
                .distance = displacement.norm(),
                .speed_before = from.velocity.norm(),
                .speed_after = to.velocity.norm(),
                .handshape_change = distance(from.shape, to.shape)};
  if (task.distance > 1e-6f) task.approach = (from.velocity + to.velocity).dot(displacement) / task.distance;
  return task;
}

TransitionTask task_between(const PhaseFeatures& before, const PhaseFeatures& after, float shoulder_width) noexcept {
  TransitionTask task{.hands = {}, .shoulder_width = shoulder_width};
  for (std::size_t side = 0; side < 2; ++side) {
    if (!before.hands[side].known || !after.hands[side].known) continue;
    const auto there = [&](const HandAt& at) {
      return HandThere{.place = shoulder_width * at.position, .velocity = at.velocity, .shape = at.handshape};
    };
    task.hands[side] = task_from(there(before.hands[side].end), there(after.hands[side].begin));
  }
  return task;
}

DurationFit fit_durations(std::span<const TimedTransition> transitions) {
  DurationFit fit;
  if (transitions.empty()) return fit;
  fit.mean = Seconds(0);
  std::vector<Row> rows;
  for (const TimedTransition& one : transitions) {
    fit.mean += one.duration;
    if (known(one.task) && one.duration > Seconds(0))
      rows.push_back({inputs_of(one.task), static_cast<double>(busier_of(one.task).distance), one.duration.count()});
  }
  fit.mean /= static_cast<double>(transitions.size());
  fit.count = transitions.size();
  if (rows.size() < kLeastTransitions) return fit;
  const Errors errors = cross_validate(rows, part(transitions, rows));
  fit.mean_error = Seconds(errors.mean);
  fit.fitted_error = Seconds(errors.fitted);
  if (!(errors.fitted < kWorthwhile * errors.mean)) return fit;
  const Model model = learn(rows);
  const auto floats = [](const Inputs& numbers) {
    const Eigen::Matrix<float, kInputs, 1> as_floats = numbers.cast<float>();
    return std::vector<float>(as_floats.data(), as_floats.data() + kInputs);
  };
  fit.weights = floats(model.weights);
  fit.inputs_least = floats(model.low);
  fit.inputs_most = floats(model.high);
  fit.least = Seconds(model.least);
  fit.most = Seconds(model.most);
  fit.fastest = static_cast<float>(model.fastest);
  return fit;
}

Seconds duration_of(const DurationFit& fit, const TransitionTask& task) noexcept {
  if (fit.weights.size() != kInputs || fit.inputs_least.size() != kInputs || fit.inputs_most.size() != kInputs ||
      !known(task)) {
    return fit.mean;
  }
  const auto numbers = [](const std::vector<float>& floats) -> Inputs {
    return Eigen::Map<const Eigen::Matrix<float, kInputs, 1>>(floats.data()).cast<double>();
  };
  const Model model{.weights = numbers(fit.weights),
                    .low = numbers(fit.inputs_least),
                    .high = numbers(fit.inputs_most),
                    .least = fit.least.count(),
                    .most = fit.most.count(),
                    .fastest = static_cast<double>(fit.fastest)};
  return Seconds(model.seconds(inputs_of(task), static_cast<double>(busier_of(task).distance)));
}

namespace {

void put(ByteWriter& out, const std::vector<float>& numbers) {
  for (const float number : numbers) out.number(number);
}

}  // namespace

void encode(const DurationFit& fit, ByteWriter& out) {
  out.number(fit.mean.count());
  out.number(static_cast<std::uint64_t>(fit.count));
  out.number(fit.mean_error.count());
  out.number(fit.fitted_error.count());
  const bool fitted = !fit.weights.empty();
  out.number(static_cast<std::uint8_t>(fitted));
  if (!fitted) return;
  put(out, fit.weights);
  put(out, fit.inputs_least);
  put(out, fit.inputs_most);
  out.number(fit.least.count());
  out.number(fit.most.count());
  out.number(fit.fastest);
}

DurationFit decode_duration_fit(ByteReader& in) {
  const auto seconds = [&] {
    const auto number = in.number<double>();
    if (!std::isfinite(number) || number < 0) in.fail("a duration is not a valid number of seconds");
    return Seconds(number);
  };
  DurationFit fit;
  fit.mean = seconds();
  fit.count = in.number<std::uint64_t>();
  fit.mean_error = seconds();
  fit.fitted_error = seconds();
  const auto fitted = in.number<std::uint8_t>();
  if (fitted > 1) in.fail("the flag of the fit is neither 0 nor 1");
  if (fitted == 0) return fit;
  const auto inputs = [&] {
    std::vector<float> numbers(kInputs);
    for (float& number : numbers) {
      number = in.number<float>();
      if (!std::isfinite(number)) in.fail("a value of the fit is not finite");
    }
    return numbers;
  };
  fit.weights = inputs();
  fit.inputs_least = inputs();
  fit.inputs_most = inputs();
  for (std::size_t i = 0; i < fit.inputs_least.size(); ++i) {
    if (fit.inputs_least[i] > fit.inputs_most[i]) in.fail("a lower bound of the fit exceeds its upper bound");
  }
  fit.least = seconds();
  fit.most = seconds();
  fit.fastest = in.number<float>();
  if (fit.least > fit.most || !std::isfinite(fit.fastest) || fit.fastest < 0)
    in.fail("a bound of the fit is out of range");
  return fit;
}

bool nearly_same(const DurationFit& a, const DurationFit& b) noexcept {
  const auto near = [](double x, double y) {
    return std::abs(x - y) <= 1e-3 * std::max({1.0, std::abs(x), std::abs(y)});
  };
  const auto all_near = [&](const std::vector<float>& x, const std::vector<float>& y) {
    return std::ranges::equal(
        x, y, [&](float one, float other) { return near(static_cast<double>(one), static_cast<double>(other)); });
  };
  return a.count == b.count && near(a.mean.count(), b.mean.count()) && all_near(a.weights, b.weights) &&
         all_near(a.inputs_least, b.inputs_least) && all_near(a.inputs_most, b.inputs_most) &&
         near(a.least.count(), b.least.count()) && near(a.most.count(), b.most.count()) &&
         near(static_cast<double>(a.fastest), static_cast<double>(b.fastest));
}

}  // namespace signweave
