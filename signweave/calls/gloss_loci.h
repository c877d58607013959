#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/features/distribution.h"
#include "signweave/rig/part.h"
#include "signweave/rig/signer_space.h"
#include "signweave/space/locus.h"

namespace signweave::calls {

/// One palm over the strokes of a token: from the first frame of the first to the last frame of the last.
struct PalmStroke {
  Eigen::Vector3f begin = Eigen::Vector3f::Zero();  ///< signer-centred, shoulder widths
  Eigen::Vector3f end = Eigen::Vector3f::Zero();
  float path = 0;  ///< metres
};

/// A measured token of a gloss.
struct PlacedToken {
  std::string gloss;
  std::string recording;
  TimeSpan span;                                   ///< of its strokes, annotation time
  Hand hand = Hand::both;                          ///< as annotated
  bool inferred = false;                           ///< it has no annotated phases
  std::array<std::optional<PalmStroke>, 2> palms;  ///< [Side]
  float shoulder_width = 0;                        ///< metres
};

/// Tokens that are farther apart than this are in different places, metres. (ours)
inline constexpr float kOtherPlace = 0.15f;
/// A sign that goes outwards or inwards by more than this goes away from the signer or toward it, metres. (ours)
inline constexpr float kAwayOrToward = 0.08f;

/// Where the palm is at one end of the strokes of several tokens.
struct PlaceStats {
  Distribution azimuth;      ///< degrees; all within 180° of that of the mean place
  Distribution elevation;    ///< degrees
  Distribution distance;     ///< shoulder widths
  SpaceAngles middle;        ///< the medians
  std::string_view nearest;  ///< the built-in locus nearest to the middle
  std::size_t places = 0;    ///< the most that are found more than kOtherPlace apart from each other, one after another
  double spread = 0;         ///< metres: root mean square distance from the mean
};

/// Where signs go, in the median of their tokens.
enum class Heading { neither, away, toward };
std::string_view name_of(Heading heading) noexcept;

/// Where the tokens of one gloss begin and end.
struct GlossLoci {
  struct Token {
    std::string recording;
    TimeSpan span;
    Side hand = Side::right;
    PalmStroke palm;
  };
  std::string gloss;        ///< as first written
  Side hand = Side::right;  ///< that of most tokens
  PlaceStats begin;
  PlaceStats end;
  Heading heading = Heading::neither;
  std::vector<Token> tokens;  ///< in order
  double spread() const noexcept { return std::max(begin.spread, end.spread); }
};

/// The glosses by descending spread, then by name, compared in match form. A token counts with its annotated hand; one
/// of both hands with that of the longer path in most tokens of the gloss. Of a gloss that has tokens with
/// annotated phases only these count. `body` places the built-in loci.
std::vector<GlossLoci> gloss_loci(std::span<const PlacedToken> tokens, const SignerBody& body);

}  // namespace signweave::calls
