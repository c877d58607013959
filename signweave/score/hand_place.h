#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>

namespace signweave {

/// What a hand keeps its place to if its arm is put on another trunk.
enum class Anchor : std::uint8_t {
  signer_space = 0,  ///< it touches nothing: its place in front of the signer
  trunk = 1,
  head = 2,
  other_hand = 3,
};
inline constexpr std::array kAnchors = {Anchor::signer_space, Anchor::trunk, Anchor::head, Anchor::other_hand};
/// "signer space", "trunk", "head", "other hand".
std::string_view name_of(Anchor anchor) noexcept;

/// The place of a hand whose arm comes from a clip with another trunk: as in the clip, in the space of what it touched
/// there. The hand moves in that space as captured.
struct HandPlace {
  Anchor anchor = Anchor::signer_space;           ///< what the clip's stroke touched
  Anchor kept_in = Anchor::signer_space;          ///< the space in which it keeps its place; never other_hand
  Eigen::Vector3f out = Eigen::Vector3f::Zero();  ///< moved out of the body by this; metres, axes of `kept_in`
  float moved_mm = 0;                             ///< how far the palm is from where the copied arm would have it
  float turned_degrees = 0;                       ///< the same for its orientation
  friend bool operator==(const HandPlace&, const HandPlace&) = default;
};

}  // namespace signweave
