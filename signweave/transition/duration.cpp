#include "signweave/transition/duration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "signweave/features/hand_points.h"
#include "signweave/motion/kinematics.h"
#include "signweave/rig/signer_space.h"

namespace signweave {
namespace {

/// What the logarithm of the duration is linear in; the first is 1.
constexpr int kInputs = 5;
using Inputs = Eigen::Matrix<double, kInputs, 1>;

constexpr double kLeastDistance = 0.02;  // metres: how well a hand's place is known
/// Of the mean's error: what a fit must get below to be taken.
constexpr double kWorthwhile = 0.95;
constexpr double kRidge = 2.0;  // transitions
constexpr int kRounds = 25;
constexpr double kLeastResidual = 0.05;  // of the logarithm: nearer is as good as met

bool known(const TransitionTask& task) noexcept {
  return task.hands[0].known || task.hands[1].known;
}

/// The hand that goes farther. The task must be known.
const HandTask& busier_of(const TransitionTask& task) noexcept {
  const auto way = [&](std::size_t side) { return task.hands[side].known ? task.hands[side].distance : -1.0f; };
  return task.hands[way(1) >= way(0) ? 1 : 0];
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
  std::size_t part = 0;  ///< of the cross-validation
};

/// What is learned of some rows.
struct Model {
  Inputs weights = Inputs::Zero();
  Inputs low = Inputs::Zero();  ///< inputs are not looked at beyond
  Inputs high = Inputs::Zero();
  double mean = 0;
  double least = 0;
  double most = 0;
  double fastest = 0;

  Inputs within(const Inputs& inputs) const noexcept { return inputs.cwiseMax(low).cwiseMin(high); }
  double seconds(const Inputs& inputs, double distance) const noexcept {
    const double told = std::exp(weights.dot(within(inputs)));
    return std::clamp(fastest > 0 ? std::max(told, distance / fastest) : told, least, most);
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
    for (int i = 1; i < kInputs; ++i) x[i] = spread[i] > 1e-6 ? x[i] / spread[i] : 0.0;  // no change tells nothing
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

/// Rows: at least one.
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

/// Errors with one part left out at a time.
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

/// Recordings numbered from 0; one alone is parted into fifths, in order. Returns how many parts there are.
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

/// A hand at a border, seen from the signer: metres, metres a second.
struct HandThere {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();
  Handshape shape;
};

HandTask task_from(const HandThere& from, const HandThere& to) noexcept {
  const Eigen::Vector3f way = to.place - from.place;
  HandTask task{.known = true,
                .distance = way.norm(),
                .speed_before = from.velocity.norm(),
                .speed_after = to.velocity.norm(),
                .handshape_change = distance(from.shape, to.shape)};
  if (task.distance > 1e-6f) task.approach = (from.velocity + to.velocity).dot(way) / task.distance;
  return task;
}

/// Measures hands in single poses.
class HandReader {
 public:
  HandReader(const Gap& gap, const SignerModel& signer)
      : signer_(signer), hands_{HandPlaces(signer.rig, Side::left), HandPlaces(signer.rig, Side::right)} {
    std::vector<JointIndex> joints = {signer.body->trunk, signer.rig[Part::left_upper_arm].joint,
                                      signer.rig[Part::right_upper_arm].joint};
    for (const HandPlaces& hand : hands_) hand.add_joints(joints);
    std::erase(joints, kNoJoint);
    chains_ = JointChains(*gap.skeleton, joints);
  }
  bool has(std::size_t side) const noexcept { return hands_[side].has_wrist(); }

  std::array<HandThere, 2> at(PoseView pose, PoseView other, Seconds apart) {
    std::array<HandThere, 2> result = places(pose);
    if (apart == Seconds(0)) return result;
    const std::array<HandThere, 2> away = places(other);
    for (std::size_t side = 0; side < 2; ++side) {
      result[side].velocity = (result[side].place - away[side].place) / static_cast<float>(apart.count());
    }
    return result;
  }

 private:
  std::array<HandThere, 2> places(PoseView pose) {
    chains_.to_model_space(pose, pose_);
    const SignerSpace space = signer_space(*signer_.body, signer_.rig, pose_);
    std::array<HandThere, 2> result;
    for (const Side side : kSides) {
      const auto at = static_cast<std::size_t>(side);
      if (!has(at)) continue;
      hands_[at].read(pose_, points_);
      result[at].place = space.unit * space.to_signer(palm_of(points_));
      if (hands_[at].why_no_fingers().empty()) result[at].shape = handshape_of(points_, axes_of(points_, side));
    }
    return result;
  }

  const SignerModel& signer_;
  std::array<HandPlaces, 2> hands_;
  JointChains chains_;
  ModelPose pose_;
  HandPoints points_;
};

}  // namespace

TransitionTask task_of(const Gap& gap, const SignerModel& signer) {
  TransitionTask task;
  if (!signer.body || !why_no_signer_space(signer.rig).empty()) return task;
  task.shoulder_width = signer.body->shoulder_width;
  HandReader reader(gap, signer);
  const std::int64_t context = std::max<std::int64_t>(1, std::llround(kTaskContext.count() * gap.rate.hertz()));
  const std::int64_t before = std::min(context, gap.before.frames - 1);
  const std::int64_t after = std::min(context, gap.after.frames - 1);
  const Seconds frame = gap.rate.frame_time();
  const auto from =
      reader.at(gap.left(), gap.before.pose(gap.before.frames - 1 - before), static_cast<double>(before) * frame);
  const auto to = reader.at(gap.right(), gap.after.pose(after), -static_cast<double>(after) * frame);
  for (std::size_t side = 0; side < 2; ++side) {
    if (reader.has(side)) task.hands[side] = task_from(from[side], to[side]);
  }
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

}  // namespace signweave
