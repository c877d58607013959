#include "signweave/features/two_handed.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

bool all_finite(const TwoHanded& movement) noexcept {
  const auto finite = [](const TwoHanded::OnePalm& palm) {
    return std::isfinite(palm.mean_speed) && std::isfinite(palm.height) && std::isfinite(palm.least_height);
  };
  return std::ranges::all_of(movement.palms, finite) && std::isfinite(movement.mirrored) &&
         std::isfinite(movement.parallel) && std::isfinite(movement.least_distance);
}

bool rests(const TwoHanded::OnePalm& palm, const TwoHanded::OnePalm& other, const SignerBody& body) noexcept {
  const float chest = body.heights[static_cast<std::size_t>(Height::chest)];
  return palm.least_height < chest && palm.height < other.height - kRestsBelow;
}

}  // namespace

std::string_view name_of(Hands hands) noexcept {
  switch (hands) {
    case Hands::one:
      return "one";
    case Hands::symmetric:
      return "symmetric";
    case Hands::alternating:
      return "alternating";
    case Hands::asymmetric:
      break;
  }
  return "asymmetric";
}

void TwoHandedSum::add(std::span<const PointFrame> left, std::span<const PointFrame> right) noexcept {
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
    const std::array<const PointFrame*, 2> points = {&left[i], &right[i]};
    for (std::size_t side = 0; side < 2; ++side) {
      const auto square = static_cast<double>(points[side]->velocity.squaredNorm());
      palms_[side].speed += std::sqrt(square);
      palms_[side].square += square;
      palms_[side].height += static_cast<double>(points[side]->position.y());
      palms_[side].least_height = std::min(palms_[side].least_height, points[side]->position.y());
    }
    const Eigen::Vector3f products = left[i].velocity.cwiseProduct(right[i].velocity);
    const auto along = static_cast<double>(products.y() + products.z());
    mirrored_ += along - static_cast<double>(products.x());
    parallel_ += along + static_cast<double>(products.x());
    const bool fingers = left[i].state.palm != Facing::unknown && right[i].state.palm != Facing::unknown;
    if (fingers) openness_apart_ += std::abs(static_cast<double>(left[i].state.openness - right[i].state.openness));
    least_distance_ = std::min(least_distance_, (left[i].position - right[i].position).norm());
    contact_ = contact_ || has(left[i].state.contact | right[i].state.contact, Contact::hands);
    count_ += 1;
  }
}

TwoHandedSum& TwoHandedSum::operator+=(const TwoHandedSum& other) noexcept {
  for (std::size_t side = 0; side < 2; ++side) {
    palms_[side].speed += other.palms_[side].speed;
    palms_[side].square += other.palms_[side].square;
    palms_[side].height += other.palms_[side].height;
    palms_[side].least_height = std::min(palms_[side].least_height, other.palms_[side].least_height);
  }
  mirrored_ += other.mirrored_;
  parallel_ += other.parallel_;
  openness_apart_ += other.openness_apart_;
  least_distance_ = std::min(least_distance_, other.least_distance_);
  contact_ = contact_ || other.contact_;
  count_ += other.count_;
  return *this;
}

TwoHanded TwoHandedSum::movement() const noexcept {
  TwoHanded result{.openness_apart = static_cast<float>(openness_apart_ / count_),
                   .least_distance = least_distance_,
                   .contact = contact_};
  for (std::size_t side = 0; side < 2; ++side) {
    result.palms[side] = {.mean_speed = static_cast<float>(palms_[side].speed / count_),
                          .height = static_cast<float>(palms_[side].height / count_),
                          .least_height = palms_[side].least_height};
  }
  const auto [slow, fast] = std::minmax(palms_[0].speed, palms_[1].speed);
  result.speed_ratio = fast > 0 ? static_cast<float>(slow / fast) : 1;
  const double norm = std::sqrt(palms_[0].square * palms_[1].square);
  if (norm > 0) {
    result.mirrored = static_cast<float>(mirrored_ / norm);
    result.parallel = static_cast<float>(parallel_ / norm);
  }
  return result;
}

std::optional<Hands> class_of(const TwoHanded& movement, const SignerBody& body) noexcept {
  if (!all_finite(movement)) return std::nullopt;
  const auto& [left, right] = movement.palms;
  if (!movement.contact && (rests(left, right, body) || rests(right, left, body))) return Hands::one;
  if (std::max(left.mean_speed, right.mean_speed) < kStillPalm) return std::nullopt;
  if (movement.speed_ratio < kBaseRatio) {
    return movement.contact || movement.least_distance < kBaseReach ? Hands::asymmetric : Hands::one;
  }
  if (movement.speed_ratio < kBothMoveRatio || movement.openness_apart > kOtherOpenness) return Hands::asymmetric;
  if (std::max(movement.mirrored, movement.parallel) > kAlike) return Hands::symmetric;
  // The sum of both has only the movement up and forward. Hands that move to the same side are opposed if mirrored, but
  // they do not alternate.
  return (movement.mirrored + movement.parallel) / 2 < kOpposed ? Hands::alternating : Hands::asymmetric;
}

bool both_move(const TwoHanded& movement) noexcept {
  return std::ranges::all_of(movement.palms, [](const auto& palm) { return palm.mean_speed > kMovingPalm; });
}

}  // namespace signweave
