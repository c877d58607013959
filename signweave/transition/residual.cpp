#include "signweave/transition/residual.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "signweave/transition/curves.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

// Tuned by leaving out collections (docs/evaluation.md).
constexpr float kGateLength = 2;         ///< of the kernel, standard deviations of the gates
constexpr float kUngated = 0.3f;         ///< share of the kernel that does not depend on the gates
constexpr double kResidualNoise = 6;     ///< variance of the training data, in the kernel's unit
constexpr float kResidualFloor = 0.02f;  ///< arm lengths; larger errors have less weight, with this added to both
/// Maximum length of a residual. Arm lengths.
constexpr float kFarthest = 1.0f;
/// Wrists that move less than this are not learned from. Arm lengths.
constexpr float kLeastPath = 0.1f;

std::size_t slot_of(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

/// Weight of a centre, by its distance from a gap.
float gate_of(const ResidualModel::Gates& a, const ResidualModel::Gates& b) noexcept {
  float square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::exp(-square / (2 * kGateLength * kGateLength)) + kUngated;
}

ResidualModel::Gates standardised(const ResidualModel& model, const ResidualModel::Gates& gates) noexcept {
  ResidualModel::Gates out;
  for (std::size_t i = 0; i < gates.size(); ++i) out[i] = (gates[i] - model.gate_mean[i]) / model.gate_scale[i];
  return out;
}

float logarithm(const Vector3f& vector) noexcept {
  return std::log(vector.norm() + 0.05f);
}

float cosine(const Vector3f& a, const Vector3f& b) noexcept {
  return a.dot(b) / (a.norm() * b.norm() + 1e-6f);
}

float median_of(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Equally many of each fold as far as possible, evenly spread.
std::vector<const ResidualSpan*> chosen(std::span<const ResidualSpan* const> spans, std::size_t most) {
  if (spans.size() <= most) return {spans.begin(), spans.end()};
  std::map<std::size_t, std::vector<const ResidualSpan*>> by_fold;
  for (const ResidualSpan* span : spans) by_fold[span->fold].push_back(span);
  std::vector<const std::vector<const ResidualSpan*>*> folds;
  for (const auto& [fold, of_fold] : by_fold) folds.push_back(&of_fold);
  std::ranges::stable_sort(folds, [](const auto* a, const auto* b) { return a->size() < b->size(); });
  std::vector<const ResidualSpan*> some;
  for (std::size_t i = 0; i < folds.size(); ++i) {  // small ones first, so that the others get their unused share
    const std::vector<const ResidualSpan*>& all = *folds[i];
    const std::size_t wanted = std::min(all.size(), (most - some.size()) / (folds.size() - i));
    for (std::size_t k = 0; k < wanted; ++k) some.push_back(all[k * all.size() / wanted]);
  }
  return some;
}

}  // namespace

void find_arm(const Skeleton& skeleton, const JointGroups& groups, Side side, ArmChain& out) {
  out.trunk = kNoJoint;
  out.joints = {};
  out.links.clear();
  const JointIndex wrist = groups.wrists[static_cast<std::size_t>(side)];
  if (wrist == kNoJoint) return;
  out.joints.wrist = wrist;
  JointIndex trunk = kNoJoint;
  for (JointIndex joint = wrist; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
    const JointRole role = groups.roles[slot_of(joint)];
    if (role == JointRole::elbow && out.joints.elbow == kNoJoint) out.joints.elbow = joint;
    if (role == JointRole::shoulder) out.joints.shoulder = joint;
    if (role == JointRole::trunk && out.joints.shoulder != kNoJoint) {
      trunk = joint;
      break;
    }
    const auto moved = std::ranges::find(skeleton.translated_joints(), joint);
    const bool translated = moved != skeleton.translated_joints().end();
    out.links.push_back(
        {joint, translated ? moved - skeleton.translated_joints().begin() : -1, skeleton.joint(joint).offset});
  }
  std::ranges::reverse(out.links);
  if (out.joints.elbow != kNoJoint && out.joints.shoulder != kNoJoint) out.trunk = trunk;
}

Vector3f place_arm(const ArmChain& chain, PoseView pose, ModelPose& out) {
  out.rotations.resize(pose.rotations.size());
  out.positions.resize(pose.rotations.size());
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  Vector3f position = Vector3f::Zero();
  out.rotations[slot_of(chain.trunk)] = rotation;
  out.positions[slot_of(chain.trunk)] = position;
  for (const ArmChain::Link& link : chain.links) {
    position +=
        rotation * (link.translation < 0 ? link.offset : pose.translations[static_cast<std::size_t>(link.translation)]);
    rotation = rotation * pose.rotations[slot_of(link.joint)];
    out.rotations[slot_of(link.joint)] = rotation;
    out.positions[slot_of(link.joint)] = position;
  }
  return position;
}

std::optional<ArmSight> see_arm(const Gap& gap, Side side, ArmScratch& scratch) {
  ArmChain& chain = scratch.chains[static_cast<std::size_t>(side)];
  find_arm(*gap.skeleton, *gap.groups, side, chain);
  if (!chain.known()) return std::nullopt;
  ArmSight sight;
  const auto see = [&](const PosesView& poses, std::int64_t border, std::int64_t step, std::vector<Vector3f>& path) {
    path.resize(static_cast<std::size_t>(context_frames(poses, gap.rate)));
    for (std::size_t k = 0; k < path.size(); ++k) {
      path[k] = place_arm(chain, poses.pose(border + static_cast<std::int64_t>(k) * step), scratch.pose);
    }
  };
  see(gap.before, gap.before.frames - 1, -1, scratch.before);
  see(gap.after, 0, 1, scratch.after);
  const auto& at = scratch.pose.positions;
  sight.length = (at[slot_of(chain.joints.elbow)] - at[slot_of(chain.joints.shoulder)]).norm() +
                 (at[slot_of(chain.joints.wrist)] - at[slot_of(chain.joints.elbow)]).norm();
  if (!(sight.length > 0.01f)) return std::nullopt;
  const double hertz = gap.rate.hertz();
  const BorderMotion before = motion_before(scratch.before, hertz);
  const BorderMotion after = motion_after(scratch.after, hertz);
  const auto seconds = static_cast<float>(GapTime(gap).seconds());
  const float unit = 1 / sight.length;
  sight.traits = {unit * (scratch.after[0] - scratch.before[0]), unit * seconds * before.velocity,
                  unit * seconds * after.velocity, unit * seconds * seconds * before.acceleration,
                  unit * seconds * seconds * after.acceleration};
  const auto& [chord, from, to, bent_from, bent_to] = sight.traits;
  sight.gates = {logarithm(chord),  logarithm(from),  logarithm(to),    cosine(chord, from),
                 cosine(chord, to), cosine(from, to), std::log(seconds)};
  const bool finite = std::ranges::all_of(sight.traits, [](const Vector3f& one) { return one.allFinite(); });
  return finite ? std::optional(sight) : std::nullopt;
}

std::array<float, ResidualModel::kBends> residual_bends(double t) noexcept {
  const double x = 2 * t - 1;
  const double bump = 16 * t * t * (1 - t) * (1 - t);
  std::array<float, ResidualModel::kBends> bends;
  double last = 0;
  double polynomial = 1;
  for (std::size_t k = 0; k < bends.size(); ++k) {
    bends[k] = static_cast<float>(bump * polynomial);
    const auto n = static_cast<double>(k + 1);
    const double next = ((2 * n - 1) * x * polynomial - (n - 1) * last) / n;
    last = polynomial;
    polynomial = next;
  }
  return bends;
}

ResidualModel::Bends residual_of(const ResidualModel& model, const ArmSight& sight) noexcept {
  ResidualModel::Bends bends;
  bends.fill(Vector3f::Zero());
  if (model.centres.empty()) return bends;
  const ResidualModel::Gates gates = standardised(model, sight.gates);
  std::array<float, ResidualModel::kTraits * ResidualModel::kBends> sum{};
  for (const ResidualModel::Centre& centre : model.centres) {
    const float gate = gate_of(gates, centre.gates);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += gate * centre.weights[i];
  }
  for (std::size_t trait = 0; trait < ResidualModel::kTraits; ++trait) {
    for (std::size_t bend = 0; bend < ResidualModel::kBends; ++bend) {
      bends[bend] += sum[trait * ResidualModel::kBends + bend] / model.trait_scale[trait] * sight.traits[trait];
    }
  }
  // Inputs far outside the training data must not displace the hand.
  float square = 0;
  for (const Vector3f& bend : bends) square += bend.squaredNorm();
  const float scale = 1 / std::sqrt(1 + square / (kFarthest * kFarthest));
  for (Vector3f& bend : bends) bend *= std::isfinite(scale) ? scale : 0.0f;
  return bends;
}

float residual_share(double seconds) noexcept {
  const auto x = static_cast<float>(std::clamp((seconds - 0.3) / 0.2, 0.0, 1.0));
  return x * x * (3 - 2 * x);
}

std::optional<ResidualSpan> residual_span(std::size_t fold, const Gap& gap, PosesView captured, PosesView kriged,
                                          ArmScratch& scratch) {
  std::optional<ResidualSpan> farthest;
  float longest = 0;
  for (const Side side : kSides) {
    const std::optional<ArmSight> sight = see_arm(gap, side, scratch);
    if (!sight) continue;
    const ArmChain& chain = scratch.chains[static_cast<std::size_t>(side)];
    float path = 0;
    Vector3f last = scratch.before[0];
    std::vector<Vector3f> off;  // arm lengths
    for (std::int64_t frame = 0; frame < captured.frames; ++frame) {
      const Vector3f place = place_arm(chain, captured.pose(frame), scratch.pose);
      path += (place - last).norm();
      last = place;
      off.push_back((place - place_arm(chain, kriged.pose(frame), scratch.pose)) / sight->length);
      if (!off.back().allFinite()) break;
    }
    if (off.empty() || !off.back().allFinite() || !(path > std::max(longest, kLeastPath * sight->length))) continue;
    longest = path;
    ResidualSpan span{.fold = fold, .sight = *sight, .seconds = GapTime(gap).seconds()};
    const GapTime time(gap);
    Eigen::Matrix<float, ResidualModel::kBends, ResidualModel::kBends> normal =
        Eigen::Matrix<float, ResidualModel::kBends, ResidualModel::kBends>::Identity() * 1e-4f *
        static_cast<float>(off.size());
    Eigen::Matrix<float, ResidualModel::kBends, 3> right = Eigen::Matrix<float, ResidualModel::kBends, 3>::Zero();
    for (std::size_t i = 0; i < off.size(); ++i) {
      const auto bends = residual_bends(time.at(static_cast<std::int64_t>(i)));
      const Eigen::Map<const Eigen::Matrix<float, ResidualModel::kBends, 1>> row(bends.data());
      normal += row * row.transpose();
      right += row * off[i].transpose();
    }
    const Eigen::Matrix<float, ResidualModel::kBends, 3> solved = normal.ldlt().solve(right);
    for (std::size_t bend = 0; bend < ResidualModel::kBends; ++bend) {
      span.bends[bend] = solved.row(static_cast<Eigen::Index>(bend)).transpose();
    }
    for (std::size_t i = 0; i < ResidualSpan::kSamples; ++i) {
      const std::size_t frame = (2 * i + 1) * off.size() / (2 * ResidualSpan::kSamples);
      span.residual[i] = off[frame];
    }
    farthest = span;
  }
  return farthest;
}

ResidualModel fit_residuals(std::span<const ResidualSpan* const> all, std::size_t most) {
  ResidualModel model;
  const std::vector<const ResidualSpan*> spans = chosen(all, most);
  if (spans.size() < kLeastSpans) return model;
  const auto count = static_cast<Eigen::Index>(spans.size());
  const auto each = static_cast<float>(spans.size());
  for (std::size_t i = 0; i < ResidualModel::kGates; ++i) {
    float sum = 0;
    float squares = 0;
    for (const ResidualSpan* span : spans) sum += span->sight.gates[i];
    model.gate_mean[i] = sum / each;
    for (const ResidualSpan* span : spans) {
      squares += (span->sight.gates[i] - model.gate_mean[i]) * (span->sight.gates[i] - model.gate_mean[i]);
    }
    model.gate_scale[i] = std::sqrt(squares / each) + 1e-3f;
  }
  for (std::size_t trait = 0; trait < ResidualModel::kTraits; ++trait) {
    float squares = 0;
    for (const ResidualSpan* span : spans) squares += span->sight.traits[trait].squaredNorm();
    model.trait_scale[trait] = std::sqrt(squares / each) + 1e-3f;
  }
  std::map<std::size_t, float> of_fold;
  std::vector<float> errors;
  for (const ResidualSpan* span : spans) {
    of_fold[span->fold] += 1;
    errors.push_back(error_of(*span, nullptr) + kResidualFloor);
  }
  const float usual = median_of(errors);

  std::vector<Eigen::Matrix<float, 3, ResidualModel::kTraits>> traits(spans.size());  // scaled
  model.centres.resize(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    for (std::size_t trait = 0; trait < ResidualModel::kTraits; ++trait) {
      traits[i].col(static_cast<Eigen::Index>(trait)) = spans[i]->sight.traits[trait] / model.trait_scale[trait];
    }
    model.centres[i].gates = standardised(model, spans[i]->sight.gates);
  }
  Eigen::MatrixXf kernel(3 * count, 3 * count);
  Eigen::MatrixXf wanted(3 * count, static_cast<Eigen::Index>(ResidualModel::kBends));
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto a = static_cast<std::size_t>(i);
    for (Eigen::Index k = 0; k <= i; ++k) {
      const auto b = static_cast<std::size_t>(k);
      kernel.block<3, 3>(3 * i, 3 * k) =
          gate_of(model.centres[a].gates, model.centres[b].gates) * traits[a] * traits[b].transpose();
    }
    const float share = of_fold[spans[a]->fold] * static_cast<float>(of_fold.size()) / each;
    const float weight = std::sqrt(share) * errors[a] / usual;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      kernel(3 * i + axis, 3 * i + axis) += static_cast<float>(kResidualNoise) * weight;
    }
    for (std::size_t bend = 0; bend < ResidualModel::kBends; ++bend) {
      wanted.block<3, 1>(3 * i, static_cast<Eigen::Index>(bend)) = spans[a]->bends[bend];
    }
  }
  const Eigen::MatrixXf solved = kernel.selfadjointView<Eigen::Lower>().llt().solve(wanted);
  if (!solved.allFinite()) return {};
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Eigen::Matrix<float, ResidualModel::kTraits, ResidualModel::kBends> weights =
        traits[i].transpose() * solved.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    for (std::size_t trait = 0; trait < ResidualModel::kTraits; ++trait) {
      for (std::size_t bend = 0; bend < ResidualModel::kBends; ++bend) {
        model.centres[i].weights[trait * ResidualModel::kBends + bend] =
            weights(static_cast<Eigen::Index>(trait), static_cast<Eigen::Index>(bend));
      }
    }
  }
  return model;
}

float error_of(const ResidualSpan& span, const ResidualModel* model) noexcept {
  ResidualModel::Bends bends;
  bends.fill(Vector3f::Zero());
  if (model != nullptr) bends = residual_of(*model, span.sight);
  const float share = residual_share(span.seconds);
  float sum = 0;
  for (std::size_t i = 0; i < ResidualSpan::kSamples; ++i) {
    const auto at = residual_bends((static_cast<double>(i) + 0.5) / ResidualSpan::kSamples);
    Vector3f made = Vector3f::Zero();
    for (std::size_t bend = 0; bend < at.size(); ++bend) made += share * at[bend] * bends[bend];
    sum += (span.residual[i] - made).norm();
  }
  return sum / ResidualSpan::kSamples;
}

ResidualModel learn_residuals(std::span<const ResidualSpan> spans) {
  std::vector<std::size_t> folds;
  for (const ResidualSpan& span : spans) folds.push_back(span.fold);
  std::ranges::sort(folds);
  folds.erase(std::unique(folds.begin(), folds.end()), folds.end());
  const std::size_t groups = std::min(folds.size(), kMostFolds);
  const auto group_of = [&](const ResidualSpan& span) {
    const auto at = static_cast<std::size_t>(std::ranges::lower_bound(folds, span.fold) - folds.begin());
    return at * groups / folds.size();
  };
  ResidualModel model;
  if (spans.size() >= kLeastSpans && groups >= 2) {
    double kriged = 0;
    double taught = 0;
    std::vector<float> ratios;
    std::size_t compared = 0;
    for (std::size_t group = 0; group < groups; ++group) {
      std::vector<const ResidualSpan*> others;
      for (const ResidualSpan& span : spans) {
        if (group_of(span) != group) others.push_back(&span);
      }
      const ResidualModel without = fit_residuals(others, kMostCentres / 2);
      if (without.centres.empty()) continue;
      double sum_kriged = 0;
      double sum_taught = 0;
      double count = 0;
      for (const ResidualSpan& span : spans) {
        if (group_of(span) != group || !(residual_share(span.seconds) > 0)) continue;
        const float before = error_of(span, nullptr);
        const float after = error_of(span, &without);
        sum_kriged += static_cast<double>(before);
        sum_taught += static_cast<double>(after);
        ratios.push_back(before > 0 ? after / before : 1.0f);
        count += 1;
      }
      if (count == 0) continue;
      ++compared;
      kriged += sum_kriged / count;
      taught += sum_taught / count;
    }
    if (compared >= 2 && kriged > 0) {
      std::vector<const ResidualSpan*> all;
      for (const ResidualSpan& span : spans) all.push_back(&span);
      model = fit_residuals(all, kMostCentres);
      model.folds = compared;
      model.mean_ratio = static_cast<float>(taught / kriged);
      model.median_ratio = median_of(ratios);
      if (!wins(model)) model.centres.clear();
    }
  }
  model.movements = spans.size();
  return model;
}

}  // namespace signweave
