#include "signweave/space/change.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"

namespace signweave {
namespace {

void check_range(float value, float least, float most, std::string_view what) {
  if (value >= least && value <= most) return;
  throw Error(ErrorCode::bad_input, fmt::format("{} is {}; give one from {} to {}", what, value, least, most));
}

}  // namespace

bool changes_nothing(const SpaceChange& change) noexcept {
  return change == SpaceChange{.keeps_turn = change.keeps_turn};
}

void check(const SpaceChange& change) {
  const int aims =
      (change.at ? 1 : 0) + (change.along.empty() ? 0 : 1) + (change.from || change.to ? 1 : 0) + (change.past ? 1 : 0);
  if (aims > 1) {
    throw Error(ErrorCode::bad_input, "a sign goes to one target: give from and to, or at, or along, or past");
  }
  if (change.along.size() == 1 || change.along.size() > kMostAlong) {
    throw Error(ErrorCode::bad_input, fmt::format("a path has {} loci; give 2 to {}", change.along.size(), kMostAlong));
  }
  for (const float value : change.move) check_range(value, -kMostMove, kMostMove, "a move in cm");
  for (const float value : change.turn) check_range(value, -360, 360, "a turn in degrees");
  for (const float value : change.scale) check_range(value, kLeastScale, kMostScale, "a scale");
  check_range(change.size, kLeastScale, kMostScale, "a size");
  check_range(change.speed, kSlowestSign, kFastestSign, "a speed");
  if (change.repetitions < 1 || change.repetitions > kMostRepetitions) {
    throw Error(ErrorCode::bad_input,
                fmt::format("a sign is repeated {} times; give 1 to {}", change.repetitions, kMostRepetitions));
  }
}

}  // namespace signweave
