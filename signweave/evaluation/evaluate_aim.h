#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/evaluation/aim_errors.h"
#include "signweave/evaluation/evaluate.h"
#include "signweave/evaluation/evaluation.h"
#include "signweave/space/roles.h"

namespace signweave {

/// What a token is predicted by, or compared with.
enum class AimMethod : std::uint8_t {
  seen,      ///< LearnedStroke, without a tenth of the tokens: usually others at the locus are known
  learned,   ///< LearnedStroke, without the locus
  cubic,     ///< its polynomial alone, without the locus
  nearest,   ///< aim_stroke from the nearest token at another locus
  citation,  ///< aim_stroke from a token that is aimed straight ahead
  ends,      ///< aim_between from a token whose ends are elsewhere: the wanted ends are given
  floor,     ///< no prediction: another token with nearly the same ends
};
inline constexpr std::size_t kAimMethods = 7;
std::string_view name_of(AimMethod method) noexcept;

struct AimToken {
  std::size_t recording = 0;
  std::size_t sign = 0;  ///< of the recording
  std::size_t gloss = 0;
};

/// One prediction of a token.
struct AimScore {
  AimMethod method = AimMethod::floor;
  std::size_t token = 0;   ///< that is predicted
  std::size_t source = 0;  ///< whose movement is changed, or that is compared
  bool near = true;        ///< the learned model vouches for the locus that is left out (Prediction::inside)
  float share = 1;         ///< FittedChange::share
  double expected_mm = 0, expected_degrees = 0;  ///< of a learned one
  AimErrors errors;
};

struct AimEvaluation {
  struct Gloss {
    std::string name;
    SpaceRole role = SpaceRole::none;  ///< as guessed from loci and palms
    std::size_t tokens = 0;
    std::size_t with_loci = 0;
    std::string why_not_learned;  ///< empty if it was
  };
  std::vector<Gloss> glosses;  ///< by name
  std::vector<AimToken> tokens;
  std::vector<AimScore> scores;
  std::size_t left_out = 0;  ///< tokens without stroke, with defects, without arms, or beyond kMostAimTokens
};

/// For each gloss with annotated loci, leaves out one locus after the other and predicts its tokens from the others;
/// for each gloss, predicts tokens from others whose ends are kOtherPlace away, given the ends. Tokens of one gloss are
/// compared if their recordings have the same joints. Deterministic. Throws what `progress` throws.
AimEvaluation evaluate_aim(std::span<const EvaluatedMotion> recordings, const EvaluationProgress& progress = {});
inline constexpr float kOtherPlace = 0.15f;         ///< metres
inline constexpr float kSamePlace = 0.05f;          ///< metres
inline constexpr std::size_t kMostAimTokens = 200;  ///< of a gloss

/// The role that loci and palms of tokens suggest; `none` without loci.
struct PlacedStroke {
  LociOfSign loci;
  Eigen::Vector3f begin, end;  ///< of the palm; shoulder widths
  bool both_hands = false;     ///< both move without touching
};
SpaceRole role_of_strokes(std::span<const PlacedStroke> strokes);

}  // namespace signweave
