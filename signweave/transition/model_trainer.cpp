#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>

#include "signweave/motion/kinematics.h"
#include "signweave/transition/fill.h"
#include "signweave/transition/learned.h"
#include "signweave/transition/model.h"

namespace signweave {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr auto kSize = static_cast<Eigen::Index>(kBendsOfKnot);
/// Added to a span's error before dividing its weight by it. The sum of squares then approximates the sum of errors, so
/// that the few fastest spans do not dominate. Metres. (ours)
constexpr double kErrorFloor = 0.01;
/// The same for rotations, radians.
constexpr double kAngleFloor = 0.02;
/// Strength of the ridge penalty, relative to the explained variance.
constexpr double kBendRidge = 0.3;

/// Least-squares sums for the share that continues, of one or two quantities.
struct Share {
  Eigen::Matrix2d power = Eigen::Matrix2d::Zero();
  Eigen::Vector2d explained = Eigen::Vector2d::Zero();
  void add(const Share& other, double weight = 1) {
    power += weight * other.power;
    explained += weight * other.explained;
  }
  /// The shares, in [0, 1.2]; 1 without data.
  Eigen::Vector2d solve() const {
    constexpr double kPrior = 1e-3;  // a weak prior for 1, so that a group without data is unchanged
    const Eigen::Matrix2d all = power + kPrior * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d share = all.ldlt().solve(Eigen::Vector2d(explained + Eigen::Vector2d::Constant(kPrior)));
    return share.cwiseMax(0.0).cwiseMin(1.2);
  }
};
/// Shares for the cubic's velocity, and for the quintic's velocity and acceleration.
struct Shares {
  Share cubic;
  Share quintic;
};

/// The sums over the spans of one recording; sums of several recordings can be added.
struct Sums {
  std::size_t spans = 0;
  std::array<Matrix, kKnots.size()> normal;     ///< [knot]
  std::array<Matrix, kKnots.size() - 1> cross;  ///< between a knot and the next
  std::array<Vector, kKnots.size()> right;
  std::array<std::array<Shares, kJointGroups>, kKnots.size()> damping;

  Sums() {
    for (Matrix& one : normal) one = Matrix::Zero(kSize, kSize);
    for (Matrix& one : cross) one = Matrix::Zero(kSize, kSize);
    for (Vector& one : right) one = Vector::Zero(kSize);
  }
  void add(const Sums& other) {
    spans += other.spans;
    for (std::size_t i = 0; i < normal.size(); ++i) {
      normal[i] += other.normal[i];
      right[i] += other.right[i];
      if (i < cross.size()) cross[i] += other.cross[i];
      for (std::size_t group = 0; group < kJointGroups; ++group) {
        damping[i][group].cubic.add(other.damping[i][group].cubic);
        damping[i][group].quintic.add(other.damping[i][group].quintic);
      }
    }
  }
};

/// Finds the coefficients that best reproduce the captured wrist trajectories.
void solve(const Sums& sums, TransitionModel& model) {
  const auto knots = static_cast<Eigen::Index>(kKnots.size());
  Matrix normal = Matrix::Zero(knots * kSize, knots * kSize);
  Vector right(knots * kSize);
  for (Eigen::Index knot = 0; knot < knots; ++knot) {
    const auto at = static_cast<std::size_t>(knot);
    normal.block(knot * kSize, knot * kSize, kSize, kSize) = sums.normal[at];
    right.segment(knot * kSize, kSize) = sums.right[at];
    if (knot + 1 == knots) continue;
    normal.block(knot * kSize, (knot + 1) * kSize, kSize, kSize) = sums.cross[at];
    normal.block((knot + 1) * kSize, knot * kSize, kSize, kSize) = sums.cross[at].transpose();
  }
  const double least = 1e-9 * normal.diagonal().mean() + 1e-12;
  normal.diagonal() += kBendRidge * normal.diagonal() + Vector::Constant(normal.rows(), least);
  const Vector bends = normal.ldlt().solve(right);
  for (Eigen::Index knot = 0; knot < knots; ++knot) {
    for (Eigen::Index i = 0; i < kSize; ++i) {
      model.bends[static_cast<std::size_t>(knot)][static_cast<std::size_t>(i)] =
          static_cast<float>(bends(knot * kSize + i));
    }
    for (std::size_t group = 0; group < kJointGroups; ++group) {
      const Shares& shares = sums.damping[static_cast<std::size_t>(knot)][group];
      const Eigen::Vector2f quintic = shares.quintic.solve().cast<float>();
      model.damping[static_cast<std::size_t>(knot)][group] = {static_cast<float>(shares.cubic.solve()[0]), quintic[0],
                                                              quintic[1]};
    }
  }
  model.spans = sums.spans;
}

float path_length(const std::vector<Eigen::Vector3f>& path) {
  float length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace

struct TransitionTrainer::State {
  std::map<std::size_t, Sums> sums;  ///< [recording]
  std::vector<std::shared_ptr<SpanLibrary>> libraries;
  std::vector<ResidualSpan> residuals;
  mutable bool given_out = false;  ///< a model uses these libraries, so they must not change
  GapScratch scratch;
  Motion made;
  ModelPose pose;

  void learn_bends(Sums& into, const Gap& gap, PosesView captured);
  void learn_damping(Sums& into, const Gap& gap, PosesView captured);
  std::shared_ptr<const TransitionModel> model(std::optional<std::size_t> left_out) const;
};

/// Minimizes the wrist's error, to first order in the bends of all joints above it, because errors of single joints can
/// compensate each other. (ours)
void TransitionTrainer::State::learn_bends(Sums& into, const Gap& gap, PosesView captured) {
  const GapTime time(gap);
  const BetweenKnots knots = between_knots(time.seconds());
  std::array<std::vector<Eigen::Vector3f>, 2> paths;  // of the wrists, as captured
  for (const Side side : kSides) {
    const JointIndex wrist = gap.groups->wrists[static_cast<std::size_t>(side)];
    if (wrist == kNoJoint) continue;
    for (std::int64_t frame = 0; frame < captured.frames; ++frame) {
      to_model_space(*gap.skeleton, captured.pose(frame), pose);
      paths[static_cast<std::size_t>(side)].push_back(pose.positions[static_cast<std::size_t>(wrist)]);
    }
  }
  const float longest = std::max(path_length(paths[0]), path_length(paths[1]));
  Sides sides;
  sides.hertz = gap.rate.hertz();
  sides.seconds = time.seconds();
  const std::int64_t step = std::max<std::int64_t>(1, gap.count / 10);
  for (const Side side : kSides) {
    const std::vector<Eigen::Vector3f>& path = paths[static_cast<std::size_t>(side)];
    if (path.empty() || path_length(path) < 0.5f * longest) continue;
    const JointIndex wrist = gap.groups->wrists[static_cast<std::size_t>(side)];
    std::vector<JointIndex> chain;
    std::vector<std::array<Eigen::Vector3f, kTraits>> traits;
    for (JointIndex joint = gap.skeleton->joint(wrist).parent; joint != kNoJoint;
         joint = gap.skeleton->joint(joint).parent) {
      see_joint(gap, static_cast<std::size_t>(joint), scratch);
      sides.before = scratch.before;
      sides.after = scratch.after;
      chain.push_back(joint);
      traits.push_back(traits_of(sides));
    }
    Matrix normal = Matrix::Zero(kSize, kSize);
    Vector right = Vector::Zero(kSize);
    Matrix row(3, kSize);
    double error = 0;
    double frames = 0;
    for (std::int64_t frame = 0; frame < gap.count; frame += step) {
      to_model_space(*gap.skeleton, made.pose(frame), pose);
      const Eigen::Vector3f place = pose.positions[static_cast<std::size_t>(wrist)];
      const auto bends = bends_at(time.at(frame));
      row.setZero();
      for (std::size_t i = 0; i < chain.size(); ++i) {
        const auto joint = static_cast<std::size_t>(chain[i]);
        const JointRole role = gap.groups->roles[joint];
        if (role == JointRole::other || role == JointRole::finger) continue;
        const Eigen::Vector3f lever = place - pose.positions[joint];
        for (std::size_t trait = 0; trait < kTraits; ++trait) {
          const Eigen::Vector3d displacement =
              (pose.rotations[joint] * traits[i][trait]).cross(lever).template cast<double>();
          for (std::size_t bend = 0; bend < kBends; ++bend) {
            const std::size_t at = ((static_cast<std::size_t>(role) - 1) * kBends + bend) * kTraits + trait;
            row.col(static_cast<Eigen::Index>(at)) += bends[bend] * displacement;
          }
        }
      }
      const Eigen::Vector3d off = (path[static_cast<std::size_t>(frame)] - place).cast<double>();
      if (!off.allFinite() || !row.allFinite()) {
        frames = 0;
        break;
      }
      error += off.norm();
      frames += 1;
      normal.noalias() += row.transpose() * row;
      right.noalias() += row.transpose() * off;
    }
    if (frames == 0) continue;  // the other hand may be valid
    const double weight = 1.0 / (error / frames + kErrorFloor) / frames;
    const double upper = knots.part;
    const double lower = 1 - upper;
    into.normal[knots.lower] += weight * lower * lower * normal;
    into.normal[knots.lower + 1] += weight * upper * upper * normal;
    into.cross[knots.lower] += weight * lower * upper * normal;
    into.right[knots.lower] += weight * lower * right;
    into.right[knots.lower + 1] += weight * upper * right;
  }
}

/// Learns the share of the borders' velocities that continues in a cubic, and of their accelerations in a quintic.
void TransitionTrainer::State::learn_damping(Sums& into, const Gap& gap, PosesView captured) {
  const GapTime time(gap);
  const BetweenKnots knots = between_knots(time.seconds());
  const auto seconds = static_cast<float>(time.seconds());
  const std::size_t joints = captured.joints();
  for (std::size_t joint = 0; joint < joints; ++joint) {
    const Eigen::Quaternionf back = see_joint(gap, joint, scratch).conjugate();
    const Eigen::Vector3f left = scratch.before[0];
    const Eigen::Vector3f right = scratch.after[0];
    const BorderMotion before = motion_before(scratch.before, gap.rate.hertz());
    const BorderMotion after = motion_after(scratch.after, gap.rate.hertz());
    Shares shares;
    double error = 0;
    Eigen::Quaternionf last = gap.left().rotations[joint];
    if (last.dot(back.conjugate()) < 0) last.coeffs() *= -1.0f;
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      Eigen::Quaternionf q = captured.pose(frame).rotations[joint];
      if (last.dot(q) < 0) q.coeffs() *= -1.0f;
      last = q;
      const Eigen::Vector3f rotation = rotation_vector(back * q);
      const auto t = static_cast<float>(time.at(frame));
      const float t2 = t * t;
      const float t3 = t2 * t;
      const float t4 = t3 * t;
      const float t5 = t4 * t;
      const Eigen::Vector3f cubic = left + (3 * t2 - 2 * t3) * (right - left);
      const Eigen::Vector3f speed = seconds * ((t3 - 2 * t2 + t) * before.velocity + (t3 - t2) * after.velocity);
      const Eigen::Vector3f straight = left + (10 * t3 - 15 * t4 + 6 * t5) * (right - left);
      const Eigen::Vector3f fast =
          seconds * ((t - 6 * t3 + 8 * t4 - 3 * t5) * before.velocity + (-4 * t3 + 7 * t4 - 3 * t5) * after.velocity);
      const Eigen::Vector3f force = seconds * seconds *
                                    ((0.5f * t2 - 1.5f * t3 + 1.5f * t4 - 0.5f * t5) * before.acceleration +
                                     (0.5f * t3 - t4 + 0.5f * t5) * after.acceleration);
      shares.cubic.power(0, 0) += speed.squaredNorm();
      shares.cubic.explained[0] += speed.dot(rotation - cubic);
      shares.quintic.power(0, 0) += fast.squaredNorm();
      shares.quintic.power(0, 1) += fast.dot(force);
      shares.quintic.power(1, 0) += fast.dot(force);
      shares.quintic.power(1, 1) += force.squaredNorm();
      shares.quintic.explained += Eigen::Vector2d(fast.dot(rotation - straight), force.dot(rotation - straight));
      error += (rotation - cubic - speed).norm();
    }
    if (!std::isfinite(error)) continue;  // the other joints may be valid
    const auto frames = static_cast<double>(gap.count);
    const double weight = 1.0 / (error / frames + kAngleFloor) / frames;
    const auto group = static_cast<std::size_t>(gap.groups->of[joint]);
    for (const bool upper : {false, true}) {
      const double share = weight * (upper ? knots.part : 1 - knots.part);
      Shares& all = into.damping[knots.lower + (upper ? 1 : 0)][group];
      all.cubic.add(shares.cubic, share);
      all.quintic.add(shares.quintic, share);
    }
  }
}

std::shared_ptr<const TransitionModel> TransitionTrainer::State::model(std::optional<std::size_t> left_out) const {
  Sums all;
  for (const auto& [recording, one] : sums) {
    if (recording != left_out) all.add(one);
  }
  auto model = std::make_shared<TransitionModel>();
  solve(all, *model);
  model->libraries.assign(libraries.begin(), libraries.end());
  given_out = true;
  if (left_out) model->purged = *left_out;
  std::vector<const ResidualSpan*> taught;
  for (const ResidualSpan& span : residuals) {
    if (span.fold != left_out) taught.push_back(&span);
  }
  model->residuals = std::make_shared<const ResidualModel>(fit_residuals(taught, kMostCentres));
  return model;
}

TransitionTrainer::TransitionTrainer() : state_(std::make_unique<State>()) {}
TransitionTrainer::~TransitionTrainer() = default;
TransitionTrainer::TransitionTrainer(TransitionTrainer&&) noexcept = default;
TransitionTrainer& TransitionTrainer::operator=(TransitionTrainer&&) noexcept = default;

void TransitionTrainer::add(std::size_t recording, const Gap& gap, PosesView captured) {
  assert(captured.frames == gap.count);
  State& state = *state_;
  // Only the skeleton's counts are used here, and no reference to it is stored.
  state.made.reset(std::shared_ptr<const Skeleton>(std::shared_ptr<const Skeleton>(), gap.skeleton), gap.rate,
                   gap.count);
  static const TransitionModel kUntaught;
  fill_learned({.gap = gap, .model = kUntaught, .scratch = state.scratch}, state.made.poses({0, gap.count}));
  Sums& sums = state.sums[recording];
  ++sums.spans;
  state.learn_bends(sums, gap, captured);
  state.learn_damping(sums, gap, captured);
  if (state.given_out) {
    for (auto& library : state.libraries) library = std::make_shared<SpanLibrary>(*library);
    state.given_out = false;
  }
  keep_span(recording, gap, captured, state.scratch, state.libraries);
  fill_kriging({.gap = gap, .model = kUntaught, .scratch = state.scratch}, state.made.poses({0, gap.count}));
  const PosesView kriged = view_of(state.made, {0, gap.count});
  if (auto span = residual_span(recording, gap, captured, kriged, state.scratch.arms)) {
    state.residuals.push_back(*std::move(span));
  }
}

std::shared_ptr<const TransitionModel> TransitionTrainer::model() const {
  return state_->model(std::nullopt);
}

std::shared_ptr<const TransitionModel> TransitionTrainer::model_without(std::size_t recording) const {
  return state_->model(recording);
}

}  // namespace signweave
