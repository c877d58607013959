#include "signweave/space/role.h"

namespace signweave {
namespace {

constexpr std::array<std::string_view, kSpaceRoles.size()> kNames = {"none", "forward", "backward", "aim", "both"};

}  // namespace

std::string_view name_of(SpaceRole role) noexcept {
  return kNames[static_cast<std::size_t>(role)];
}

std::optional<SpaceRole> role_named(std::string_view name) noexcept {
  for (const SpaceRole role : kSpaceRoles) {
    if (name_of(role) == name) return role;
  }
  return std::nullopt;
}

}  // namespace signweave
