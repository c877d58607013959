#include "signweave/space/stroke_change.h"

#include <cmath>
#include <span>

#include "signweave/core/bytes.h"
#include "signweave/core/error.h"

namespace signweave {
namespace {

constexpr std::array<std::string_view, kChangeBases.size()> kBasisNames = {"asked", "captured", "learned", "geometric"};
constexpr float kFarthest = 1e3f;  // metres

bool is_rotation(const Eigen::Quaternionf& turn) {
  return std::abs(turn.norm() - 1) < 1e-3f;
}

bool is_valid(const ArmChange& arm) {
  const auto near = [](const auto& numbers) {
    return numbers.allFinite() && numbers.cwiseAbs().maxCoeff() <= kFarthest;
  };
  bool valid = near(arm.linear) && near(arm.from) && near(arm.to) && is_rotation(arm.turn) && is_rotation(arm.carry) &&
               std::abs(arm.swivel) <= kFarthest && arm.path.size() <= kMostPathPoints;
  for (const PathPoint& point : arm.path) {
    valid = valid && near(point.shift) && near(point.turn) && std::abs(point.swivel) <= kFarthest;
  }
  return valid;
}

}  // namespace

std::uint64_t checksum_of(const StrokeChange& change) {
  std::vector<float> numbers = {change.together ? 1.0f : 0.0f, change.trunk_yaw, static_cast<float>(change.before),
                                static_cast<float>(change.after)};
  const auto add = [&](const auto& coefficients) {
    numbers.insert(numbers.end(), coefficients.data(), coefficients.data() + coefficients.size());
  };
  for (const std::optional<ArmChange>& arm : change.arms) {
    numbers.push_back(arm ? static_cast<float>(arm->path.size()) : -1.0f);
    if (!arm) continue;
    add(arm->linear);
    add(arm->from);
    add(arm->to);
    add(arm->turn.coeffs());
    add(arm->carry.coeffs());
    numbers.push_back(arm->swivel);
    for (const PathPoint& point : arm->path) {
      add(point.shift);
      add(point.turn);
      numbers.push_back(point.swivel);
    }
  }
  return checksum(std::as_bytes(std::span<const float>(numbers)));
}

std::string_view name_of(ChangeBasis basis) noexcept {
  return kBasisNames[static_cast<std::size_t>(basis)];
}

void check(const StrokeChange& change) {
  bool valid = std::abs(change.trunk_yaw) <= 1 && change.before >= 0 && change.after >= 0;
  for (const std::optional<ArmChange>& arm : change.arms) valid = valid && (!arm || is_valid(*arm));
  valid = valid && (!change.together || (change.arms[0] && change.arms[1]));
  if (!valid) {
    throw Error(ErrorCode::bad_input,
                "a stroke is changed by numbers that are no map, turn or path; sign its utterance again");
  }
}

bool operator==(const ArmChange& a, const ArmChange& b) noexcept {
  return a.linear == b.linear && a.from == b.from && a.to == b.to && a.turn.coeffs() == b.turn.coeffs() &&
         a.swivel == b.swivel && a.carry.coeffs() == b.carry.coeffs() && a.path == b.path;
}

}  // namespace signweave
