#include "signweave/score/schedule.h"

#include <algorithm>

namespace signweave {

Schedule schedule(std::span<const std::int64_t> earliest, std::span<const TimeConstraint> constraints) {
  constexpr auto kNone = static_cast<std::size_t>(-1);
  Schedule found{.moments = {earliest.begin(), earliest.end()}, .contradiction = {}};
  std::vector<std::size_t> because(earliest.size(), kNone);  // [moment] the constraint that delayed it last
  std::size_t delayed = kNone;
  for (std::size_t round = 0; round <= earliest.size(); ++round) {
    delayed = kNone;
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      const TimeConstraint& one = constraints[i];
      const std::int64_t moment = found.moments[one.from] + one.at_least;
      if (moment <= found.moments[one.to]) continue;
      found.moments[one.to] = moment;
      because[one.to] = i;
      delayed = one.to;
    }
    if (delayed == kNone) return found;
  }
  // Still delayed after as many rounds as there are moments: a cycle. Going back that often certainly enters it.
  for (std::size_t i = 0; i < earliest.size(); ++i) delayed = constraints[because[delayed]].from;
  for (std::size_t at = delayed; found.contradiction.empty() || at != delayed;) {
    found.contradiction.push_back(because[at]);
    at = constraints[because[at]].from;
  }
  std::ranges::reverse(found.contradiction);
  return found;
}

}  // namespace signweave
