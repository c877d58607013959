#include "signweave/inflection/learned_stroke.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "signweave/inflection/gaussian_process.h"
#include "signweave/inflection/slots.h"
#include "signweave/inflection/stroke_arguments.h"
#include "signweave/inflection/turns.h"

namespace signweave {
namespace {

using inflection::Arguments;
using inflection::degrees_between;
using inflection::kDegree;
using inflection::kSameLocus;
using inflection::of_vector;
using inflection::same_loci;
using inflection::slot;
using inflection::vector_of;
using inflection::wrapped;

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Quaternionf;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::VectorXd;

/// One radian of turn or swivel counts as this many shoulder widths: about the palm's distance from the wrist. (ours)
constexpr double kTurnWeight = 0.3;
constexpr std::size_t kPointSize = 7;  ///< palm, turn, swivel
/// Orientations farther from their mean have no continuous rotation vector. Degrees. (ours)
constexpr float kMostTurn = 150;

/// The mean of rotations, whatever their signs: the eigenvector of the sum of their products (Markley et al. 2007).
Quaternionf mean_of(const std::vector<Quaternionf>& turns) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Quaternionf& turn : turns) {
    const Eigen::Vector4d q = turn.coeffs().cast<double>();
    sum += q * q.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
  return Quaternionf(Eigen::Vector4f(solver.eigenvectors().col(3).cast<float>())).normalized();
}
/// What a vector of outputs is relative to.
struct Frame {
  std::array<bool, 2> used{};
  std::array<std::array<Quaternionf, kPhasePoints>, 2> turn;
  std::array<std::array<float, kPhasePoints>, 2> swivel{};

  Index size() const noexcept {
    return static_cast<Index>((static_cast<std::size_t>(used[0]) + static_cast<std::size_t>(used[1])) * kPhasePoints *
                              kPointSize);
  }
  VectorXd vector(const PhasePoints& points) const {
    VectorXd out(size());
    Index i = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      if (!used[side]) continue;
      for (std::size_t k = 0; k < kPhasePoints; ++k, i += kPointSize) {
        const PhasePoint& point = points.hands[side][k];
        out.segment<3>(i) = point.palm.cast<double>();
        out.segment<3>(i + 3) = kTurnWeight * vector_of(turn[side][k].conjugate() * point.turn).cast<double>();
        out[i + 6] = kTurnWeight * static_cast<double>(wrapped(point.swivel - swivel[side][k]));
      }
    }
    return out;
  }
  PhasePoints points(const VectorXd& vector) const {
    PhasePoints points{.hands = {}, .used = used};
    Index i = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      if (!used[side]) continue;
      for (std::size_t k = 0; k < kPhasePoints; ++k, i += kPointSize) {
        PhasePoint& point = points.hands[side][k];
        point.palm = vector.segment<3>(i).cast<float>();
        const Vector3f turned = (vector.segment<3>(i + 3) / kTurnWeight).cast<float>();
        point.turn = (turn[side][k] * of_vector(turned)).normalized();
        point.swivel = wrapped(swivel[side][k] + static_cast<float>(vector[i + 6] / kTurnWeight));
      }
    }
    return points;
  }
};

Frame frame_of(std::span<const StrokeToken* const> tokens) {
  Frame frame;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto users = std::ranges::count_if(tokens, [&](const StrokeToken* one) { return one->points.used[side]; });
    frame.used[side] = 2 * static_cast<std::size_t>(users) > tokens.size();
    for (std::size_t k = 0; k < kPhasePoints; ++k) {
      std::vector<Quaternionf> turns;
      Eigen::Vector2f swivel = Eigen::Vector2f::Zero();
      for (const StrokeToken* token : tokens) {
        const PhasePoint& point = token->points.hands[side][k];
        turns.push_back(point.turn);
        swivel += Eigen::Vector2f(std::cos(point.swivel), std::sin(point.swivel));
      }
      frame.turn[side][k] = mean_of(turns);
      frame.swivel[side][k] = std::atan2(swivel.y(), swivel.x());
    }
  }
  return frame;
}

/// Principal components of rows.
struct Components {
  VectorXd middle;
  MatrixXd axes;         ///< [value][component]
  VectorXd left_over;    ///< [value] variance that they do not hold
  MatrixXd coordinates;  ///< [row][component]
};
Components components_of(const MatrixXd& rows) {
  Components found{.middle = rows.colwise().mean(), .axes = {}, .left_over = {}, .coordinates = {}};
  const MatrixXd centred = rows.rowwise() - found.middle.transpose();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(centred * centred.transpose());  // ascending
  const double whole = std::max(centred.squaredNorm(), 1e-12);
  const Index most = std::min(static_cast<Index>(kMostComponents), rows.rows() - 1);
  Index count = 0;
  double held = 0;
  while (count < most && (count == 0 || held < kHeldVariance * whole)) {
    held += std::max(solver.eigenvalues()[rows.rows() - 1 - count], 0.0);
    ++count;
  }
  found.axes.resize(rows.cols(), count);
  for (Index k = 0; k < count; ++k) {
    const double size = std::sqrt(std::max(solver.eigenvalues()[rows.rows() - 1 - k], 1e-18));
    found.axes.col(k) = centred.transpose() * solver.eigenvectors().col(rows.rows() - 1 - k) / size;
  }
  found.coordinates = centred * found.axes;
  found.left_over = (centred - found.coordinates * found.axes.transpose()).array().square().colwise().mean();
  return found;
}

/// Root mean square of the deviations of palms and turns, from the variances of outputs.
struct Spread {
  float mm = 0, degrees = 0;
};
Spread spread_of(const VectorXd& variance, float unit) {
  double palms = 0;
  double turns = 0;
  const auto count = static_cast<Index>(kPointSize);
  for (Index i = 0; i < variance.size(); i += count) {
    palms += variance.segment<3>(i).sum();
    turns += variance.segment<3>(i + 3).sum();
  }
  const double points = static_cast<double>(variance.size()) / kPointSize;
  return {.mm = 1000 * unit * static_cast<float>(std::sqrt(palms / points)),
          .degrees = static_cast<float>(std::sqrt(turns / points) / kTurnWeight) / kDegree};
}

Arguments arguments_of(std::span<const StrokeToken> tokens, SpaceRole role, const SignerBody& body) {
  Arguments arguments{.reach = std::max(body.arm_length, 0.5f)};
  const auto varies = [&](std::optional<Locus> LociOfSign::*which) {
    std::optional<Locus> first;
    for (const StrokeToken& token : tokens) {
      const std::optional<Locus>& one = token.loci.*which;
      if (!one) continue;
      if (!first) first = one;
      if (degrees_between(*first, *one) > kSameLocus) return true;
    }
    return false;
  };
  if (role == SpaceRole::aim) {
    arguments.at = true;
  } else {
    arguments.from = varies(&LociOfSign::from);
    arguments.to = varies(&LociOfSign::to);
    // A sign that is made at a place.
    arguments.at = arguments.count() == 0;
  }
  if (arguments.count() == 1) {
    float least = 90;
    float most = -90;
    for (const StrokeToken& token : tokens) {
      for (const Locus& locus : arguments.of(token.loci)) {
        if (locus.self) continue;
        least = std::min(least, angles_of(locus.at).elevation);
        most = std::max(most, angles_of(locus.at).elevation);
      }
    }
    arguments.elevation = most - least > kSameLocus;
  }
  return arguments;
}

}  // namespace

struct LearnedStroke::Parts {
  Arguments arguments;
  Frame frame;
  Components components;
  GaussianProcess process;
  std::vector<std::vector<Locus>> seen;  ///< [token used]
  std::vector<std::size_t> token;        ///< [token used] its index among those given
  std::size_t loci = 0;
  float unit = 1;
};

std::size_t LearnedStroke::tokens() const noexcept {
  return parts_->seen.size();
}
std::size_t LearnedStroke::loci() const noexcept {
  return parts_->loci;
}

LearnedStroke::Learned LearnedStroke::learn(std::span<const StrokeToken> tokens, SpaceRole role, const SignerBody& body,
                                            Model model) {
  Arguments arguments = arguments_of(tokens, role, body);
  arguments.places = model == Model::process;
  std::vector<const StrokeToken*> used;
  std::vector<std::size_t> indices;
  std::vector<std::vector<Locus>> seen;
  std::vector<std::vector<Locus>> different;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    std::vector<Locus> loci = arguments.of(tokens[i].loci);
    if (loci.empty()) continue;
    if (std::ranges::none_of(different, [&](const auto& one) { return same_loci(one, loci); })) {
      different.push_back(loci);
    }
    used.push_back(&tokens[i]);
    indices.push_back(i);
    seen.push_back(std::move(loci));
  }
  if (used.size() < kLeastTokens) {
    return {{},
            fmt::format("{} token{} with loci {} too few", used.size(), used.size() == 1 ? "" : "s",
                        used.size() == 1 ? "is" : "are")};
  }
  if (different.size() < kLeastLoci) {
    return {{}, fmt::format("tokens at {} {} are too few", different.size(), different.size() == 1 ? "locus" : "loci")};
  }
  const Frame frame = frame_of(used);
  if (!frame.used[0] && !frame.used[1]) return {{}, "the tokens do not use the same hands"};
  if (frame.used[0] != frame.used[1]) arguments.shoulder.x() = frame.used[slot(Side::left)] ? 0.5f : -0.5f;
  MatrixXd rows(static_cast<Index>(used.size()), frame.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (!frame.used[side]) continue;
      for (std::size_t k = 0; k < kPhasePoints; ++k) {
        const Quaternionf turn = frame.turn[side][k].conjugate() * used[i]->points.hands[side][k].turn;
        if (vector_of(turn).norm() <= kMostTurn * kDegree) continue;
        return {{}, fmt::format("the hand's orientations differ by more than {:.0f}° from their mean", kMostTurn)};
      }
    }
    rows.row(static_cast<Index>(i)) = frame.vector(used[i]->points);
  }
  Components components = components_of(rows);
  const auto process_by = [&](const Arguments& by) {
    std::vector<ProcessInput> inputs;
    for (const StrokeToken* token : used) inputs.push_back(by.input(by.of(token->loci)));
    return GaussianProcess(
        std::move(inputs), components.coordinates, by.arc(),
        model == Model::process ? GaussianProcess::Uses::mean_and_kernel : GaussianProcess::Uses::mean_alone);
  };
  GaussianProcess process = process_by(arguments);
  if (role == SpaceRole::both && arguments.count() == 2) {
    // The hands may belong to the sides instead of subject and object.
    Arguments sides = arguments;
    sides.by_side = true;
    GaussianProcess other = process_by(sides);
    if (other.log_likelihood() > process.log_likelihood()) {
      process = std::move(other);
      arguments = sides;
      for (std::size_t i = 0; i < used.size(); ++i) seen[i] = arguments.of(used[i]->loci);
    }
  }
  std::vector<std::vector<Locus>> places;
  for (const std::vector<Locus>& loci : seen) {
    for (const Locus& locus : loci) {
      const std::vector<Locus> one{locus};
      if (!locus.self && std::ranges::none_of(places, [&](const auto& other) { return same_loci(other, one); })) {
        places.push_back(one);
      }
    }
  }
  return {LearnedStroke(std::make_shared<const Parts>(Parts{.arguments = arguments,
                                                            .frame = frame,
                                                            .components = std::move(components),
                                                            .process = std::move(process),
                                                            .seen = std::move(seen),
                                                            .token = std::move(indices),
                                                            .loci = places.size(),
                                                            .unit = body.shoulder_width})),
          {}};
}

Prediction LearnedStroke::predict(const LociOfSign& loci) const {
  const Parts& parts = *parts_;
  Prediction prediction;
  const std::vector<Locus> wanted = parts.arguments.of(loci);
  if (wanted.empty()) {
    prediction.inside = false;
    prediction.why_outside = "a locus that the tokens have is not given";
    return prediction;
  }
  const ProcessInput input = parts.arguments.input(wanted);
  const GaussianProcess::Value value = parts.process.at(input);
  const Components& components = parts.components;
  prediction.points = parts.frame.points(components.middle + components.axes * value.mean);
  const auto squares = components.axes.array().square().matrix();
  const Spread own = spread_of(squares * value.variance, parts.unit);
  const Spread noise = spread_of(squares * value.noise + components.left_over, parts.unit);
  prediction.noise_mm = noise.mm;
  prediction.noise_degrees = noise.degrees;
  prediction.error_mm = std::hypot(own.mm, noise.mm);
  prediction.error_degrees = std::hypot(own.degrees, noise.degrees);

  double nearest = std::numeric_limits<double>::infinity();
  float away = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    float least = 180;
    for (const std::vector<Locus>& seen : parts.seen) least = std::min(least, parts.arguments.away(seen[i], wanted[i]));
    away = std::max(away, least);
  }
  for (std::size_t t = 0; t < parts.seen.size(); ++t) {
    const ProcessInput other = parts.arguments.input(parts.seen[t]);
    double distance = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) distance += (other.places[i] - input.places[i]).squaredNorm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    prediction.nearest = parts.token[t];
  }
  if (away > kNearLoci) {
    prediction.why_outside = fmt::format("no token's locus is nearer than {:.0f}°", away);
  } else if (own.mm > 2 * std::max(noise.mm, kLeastNoise) ||
             own.degrees > 2 * std::max(noise.degrees, kLeastTurnNoise)) {
    prediction.why_outside = fmt::format(
        "its error would be {:.0f} mm, {:.0f}° where repetitions differ by {:.0f} mm, "
        "{:.0f}°",
        prediction.error_mm, prediction.error_degrees, noise.mm, noise.degrees);
  }
  prediction.inside = prediction.why_outside.empty();
  return prediction;
}

std::string why_learned(const LearnedStroke& stroke, const Prediction& prediction) {
  return fmt::format("learned from {} tokens at {} loci, expected error {:.0f} mm, {:.0f}°", stroke.tokens(),
                     stroke.loci(), prediction.error_mm, prediction.error_degrees);
}

std::string why_geometric(const std::string& token, const std::string& reason) {
  return fmt::format("geometric from {}: {}", token, reason);
}

}  // namespace signweave
