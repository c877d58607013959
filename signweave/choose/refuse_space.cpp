#include "signweave/choose/refuse_space.h"

#include <algorithm>

#include "signweave/core/error.h"

namespace signweave {

void refuse_space(const Utterance& utterance) {
  const bool asks = !utterance.loci.empty() || std::ranges::any_of(utterance.places, [](const Place& place) {
    return !changes_nothing(place.space);
  });
  if (!asks) return;
  throw Error(ErrorCode::unsupported,
              "changes in space are not signed yet; leave out loci and options such as {to @left}, {slow} or {plural}");
}

}  // namespace signweave
