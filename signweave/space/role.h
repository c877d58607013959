#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace signweave {

/// How a sign refers to loci.
enum class SpaceRole : std::uint8_t {
  none = 0,      ///< not at all, or not known
  forward = 1,   ///< its stroke goes from the subject to the object: DONNER
  backward = 2,  ///< its stroke goes from the object to the subject: INVITER, PRENDRE
  aim = 3,       ///< its hand points at the object: INDEX, GRONDER
  both = 4,      ///< each hand belongs to one of them: RENCONTRER
};
inline constexpr std::array kSpaceRoles = {SpaceRole::none, SpaceRole::forward, SpaceRole::backward, SpaceRole::aim,
                                           SpaceRole::both};
std::string_view name_of(SpaceRole role) noexcept;
std::optional<SpaceRole> role_named(std::string_view name) noexcept;

}  // namespace signweave
