#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "demo/arm.h"
#include "demo/corpus.h"
#include "demo/handshapes.h"

namespace signweave::demo {

// Recordings of signs that are aimed at places: twelve directional verbs and INDEX, beside the 44 minutes. They follow
// a law that is known (docs/demo.md), with noise that is drawn for every token, so that what is learned from them can
// be compared with the truth. PLACEHOLDERS like every sign of the demo: not LSF.
//
// All positions are metres in the signer's axes from the point between the shoulders: x to the signer's left, y up,
// z forward (signweave/rig/signer_space.h). Angles are radians unless a name says degrees.

/// Distance between the shoulders, metres: the unit of the distances of loci.
inline constexpr float kShoulderWidth = 0.35f;

/// A place that a sign is aimed at.
struct Locus {
  std::string text;     ///< as annotated: `left`, `25/0/1.2`
  bool self = false;    ///< the signer's own chest
  float azimuth = 0;    ///< degrees; 0 forward, positive to the signer's left
  float elevation = 0;  ///< degrees
  float distance = 0;   ///< shoulder widths
};
/// Reads `left`, `right`, `front`, `self`, `addressee`, or AZIMUTH/ELEVATION/DISTANCE. Throws Error{bad_input}.
Locus locus_of(std::string_view text);
Eigen::Vector3f point_of(const Locus& locus);
/// AZIMUTH/ELEVATION/DISTANCE, whatever the locus is called.
std::string angles_text(const Locus& locus);

/// How the loci of a sign give the places of its hands.
enum class Aiming {
  pointing,  ///< the index finger points at the locus `at`
  forward,   ///< from the subject's locus to the object's
  backward,  ///< from the object's locus to the subject's
  mouth,     ///< from the mouth to the object's locus
  facing,    ///< in front of the object's locus, not along a path
  together,  ///< both hands, rigid to each other, from the subject's locus to the object's
  meeting,   ///< both hands, each from one locus until they meet
  crossing,  ///< both hands, each from one locus to the other one
};

/// A sign of these recordings. Directions are those of the right hand aimed straight ahead.
struct AimedSign {
  std::string_view gloss;
  Aiming aiming = Aiming::forward;
  Handshape shape = Handshape::flat;
  std::optional<Handshape> shape_end = {};
  std::optional<Handshape> other_shape = {};  ///< of the left hand, if it has another one
  Eigen::Vector3f palm, fingers;              ///< the palm faces, the fingers point
  float height = 0;                           ///< of the arc of a long path above its chord, metres
};
std::span<const AimedSign> aimed_signs();
/// Throws Error{not_found}.
const AimedSign& aimed_sign(std::string_view gloss);
bool acts(const AimedSign& sign, Side side) noexcept;
/// At the begin (0) or end (1) of the stroke, of a side that acts.
Handshape handshape_of(const AimedSign& sign, Side side, int end) noexcept;
/// The same as a row for body and face; the reference stays valid.
const SignShape& shape_of(const AimedSign& sign);

/// A token: a sign with its loci; a sign that does not use one has none.
struct Aimed {
  std::string_view gloss;
  std::optional<Locus> from, to, at;
};
struct SpaceScript {
  std::string name;
  std::vector<std::vector<Aimed>> units;
};
/// INDEX at seven azimuths and three elevations, and at named loci, repeatedly.
SpaceScript espace_index();
/// Each verb of aimed_signs() with loci at seven azimuths and the signer; part 1 or 2.
SpaceScript espace_verbes(int part);

/// What the law gives for one hand.
struct AimedHand {
  Eigen::Vector3f palm;     ///< its centre: the middle between wrist and middle knuckle
  Eigen::Quaternionf hand;  ///< turns a hand with fingers forward and palm down; signer's axes
  float swivel = 0;         ///< of the elbow, as WristAngles::swivel
};
/// The law: where a hand is when a fraction of the stroke is done, without noise. For a side that acts.
AimedHand aimed_hand(const Aimed& aimed, Side side, float done);
/// The wrist of a hand in an arm whose shoulder is half a shoulder width from the middle; not limited.
WristAngles wrist_of(const AimedHand& hand, Side side);
/// A hand with the same palm whose wrist has those angles; its own orientation is the first guess.
AimedHand with_wrist(const AimedHand& hand, const WristAngles& angles, Side side);
/// Yaw of the chest in the same moment; positive to the signer's left.
float aimed_yaw(const Aimed& aimed, float done);

/// What a token differs by from the law: a shift of the palm and a turn (rotation vector), constant over the token,
/// signer's axes. Hands that are rigid to each other share it, and turn about the right palm.
struct AimedNoise {
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();
  Eigen::Vector3f turn = Eigen::Vector3f::Zero();
};
inline constexpr float kShiftNoise = 0.005f;   ///< root mean square length of a shift, metres
inline constexpr float kTurnNoise = 0.05236f;  ///< root mean square angle of a turn: 3 degrees

/// A token at its time with its noise, [side].
struct PlacedAimed {
  const Aimed* aimed = nullptr;
  PlacedSign placed;
  std::array<AimedNoise, 2> noise;
};
/// The hand of a token, noise included.
AimedHand noisy_hand(const PlacedAimed& sign, Side side, float done);

/// Everything at its time; borrows the script.
struct SpaceTimeline {
  FrameRate rate;
  std::vector<PlacedAimed> signs;
  std::int64_t frames = 0;
};
/// Throws as `schedule` does. `noise` scales the noise.
SpaceTimeline schedule_space(const SpaceScript& script, FrameRate rate, Random& random, float noise = 1);

/// A recording of that script; the same arguments give the same recording. Tiers `Gloss` and `Phase` as elsewhere, and
/// `From`, `To`, `At` with the loci over the signs. `noise` scales everything in the hands that is random, as well as
/// the noise of the tokens.
SyntheticRecording make_space(const SpaceScript& script, FrameRate rate, std::uint64_t seed, float noise = 1);

}  // namespace signweave::demo
