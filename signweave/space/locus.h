#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/rig/signer_space.h"

/// Places in front of the signer, which signs refer to.
namespace signweave {

/// A direction and a distance from between the shoulders, by the axes of signer-centred space.
struct SpaceAngles {
  float azimuth = 0;    ///< degrees; 0: straight ahead, positive: to the signer's left
  float elevation = 0;  ///< degrees; positive: up
  float distance = 0;   ///< shoulder widths
  friend bool operator==(const SpaceAngles&, const SpaceAngles&) = default;
};
/// In signer-centred space, shoulder widths.
Eigen::Vector3f point_of(const SpaceAngles& angles) noexcept;
/// The azimuth of a point above or below the origin is 0.
SpaceAngles angles_of(const Eigen::Vector3f& point) noexcept;

/// A locus as a text gives it, without its "@": by name, or by numbers.
struct LocusRef {
  enum class Kind : std::uint8_t {
    name,    ///< of a built-in locus, or of one that was set up
    angles,  ///< `numbers`: azimuth and elevation in degrees, distance in shoulder widths
    point,   ///< `numbers`: to the signer's left, up, forward, in shoulder widths
  };
  Kind kind = Kind::name;
  std::string name;
  std::array<float, 3> numbers{};
  friend bool operator==(const LocusRef&, const LocusRef&) = default;
};

/// The distance of a locus that is given by angles alone, shoulder widths.
inline constexpr float kLocusDistance = 1.2f;
/// The surface of the chest is this far in front of the origin, shoulder widths. (ours)
inline constexpr float kChestDepth = 0.35f;
/// A locus is at most this far away, shoulder widths.
inline constexpr float kFarthestLocus = 100;
/// The longest name of a locus, bytes.
inline constexpr std::size_t kLongestLocusName = 100;

/// Reads "left", "a", "30", "-30/10", "30/10/1.5" (angles) or "0.3,0.1,0.8" (a point), without "@". Throws
/// Error{bad_input} with what is expected: for a number out of range (azimuth ±180, elevation ±90, distance above 0 up
/// to kFarthestLocus), and for a name that is empty, too long, or has characters of the notation (blanks, brackets,
/// quotes, `;`, `:`, `=`, `|`, `@`).
LocusRef read_locus(std::string_view text);
/// What read_locus reads as the same.
std::string to_string(const LocusRef& locus);

/// A name for a locus, from a place of an utterance on.
struct LocusSetup {
  std::string name;  ///< not one of built_in_loci()
  LocusRef is;       ///< may be a name that was set up before
  std::size_t from = 0;
  friend bool operator==(const LocusSetup&, const LocusSetup&) = default;
};

/// left, right, front, addressee, self.
std::span<const std::string_view> built_in_loci() noexcept;
bool is_built_in_locus(std::string_view name) noexcept;

/// A locus that is resolved.
struct Locus {
  Eigen::Vector3f at = Eigen::Vector3f::Zero();  ///< signer-centred, shoulder widths
  bool self = false;                             ///< the signer: the middle of the chest
  friend bool operator==(const Locus&, const Locus&) = default;
};

/// The same locus without names that were set up: numbers, or a built-in name. Throws as `resolve`.
LocusRef without_setups(const LocusRef& locus, std::span<const LocusSetup> setups, std::size_t place);

/// The locus of a place of an utterance: what its name was set up as by then. `left` and `right` are 45° aside and
/// `front` is straight ahead, kLocusDistance away at the height of the shoulders; `addressee` is straight ahead, 5°
/// up and 3 shoulder widths away; `self` is on the chest. Throws Error{not_found, "there is no locus 'b'; …"}.
Locus resolve(const LocusRef& locus, std::span<const LocusSetup> setups, std::size_t place, const SignerBody& body);

}  // namespace signweave
