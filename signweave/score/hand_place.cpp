#include "signweave/score/hand_place.h"

namespace signweave {
namespace {

constexpr std::array<std::string_view, kAnchors.size()> kAnchorNames = {"signer space", "trunk", "head", "other hand"};

}  // namespace

std::string_view name_of(Anchor anchor) noexcept {
  return kAnchorNames[static_cast<std::size_t>(anchor)];
}

}  // namespace signweave
