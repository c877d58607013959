#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/inflection/aim.h"
#include "signweave/inflection/phase_points.h"

namespace signweave {

/// A captured stroke of a gloss with the loci between which it goes.
struct StrokeToken {
  PhasePoints points;
  LociOfSign loci;
};

/// A stroke that was never captured.
struct Prediction {
  PhasePoints points;
  /// The error to expect, against a token that would be captured: root mean square over the stroke.
  float error_mm = 0, error_degrees = 0;
  float noise_mm = 0, noise_degrees = 0;  ///< the part of it by which repetitions differ from their mean
  bool inside = true;                     ///< near the loci that it was learned from; see LearnedStroke::predict
  std::string why_outside;                ///< "no token's locus is nearer than 62°"; empty if inside
  std::size_t nearest = 0;                ///< the token whose loci are nearest
};

/// A model of how one gloss' strokes depend on their loci, learned from its tokens: Gaussian process regression whose
/// mean is the third-order polynomial of the arc positions of subject and object of Lu & Huenerfauth (2010, 2011), 10
/// coefficients for two arguments and 4 for one; it is also linear in where the line from the shoulder to a locus
/// leaves the hand's reach, and the signer as a locus has a coefficient. Outputs are palms, rotations from the mean
/// orientation and elbow swivels of the hands that act, at kPhasePoints moments, as at most kMostComponents principal
/// components. Learning takes some ten milliseconds, a prediction some ten microseconds; both allocate. Immutable.
class LearnedStroke {
 public:
  enum class Model {
    process,     ///< as above
    cubic_alone  ///< the polynomial alone, with ridge
  };
  struct Learned;
  /// Needs kLeastTokens with loci at kLeastLoci loci. Tokens without the loci of the role are not used. The same tokens
  /// in the same order give the same model.
  static Learned learn(std::span<const StrokeToken> tokens, SpaceRole role, const SignerBody& body,
                       Model model = Model::process);

  /// Loci are inside within kNearLoci of those seen, and as long as the model's own error is at most twice the noise,
  /// or kLeastNoise and kLeastTurnNoise where that is more. Of loci that are missing, the mean of those seen is taken.
  Prediction predict(const LociOfSign& loci) const;

  std::size_t tokens() const noexcept;
  std::size_t loci() const noexcept;

 private:
  struct Parts;
  explicit LearnedStroke(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_;
};
struct LearnedStroke::Learned {
  std::optional<LearnedStroke> stroke;
  std::string why_not;  ///< "2 tokens with loci are too few"; empty if there is a stroke
};

inline constexpr std::size_t kLeastTokens = 8;
inline constexpr std::size_t kLeastLoci = 3;
inline constexpr std::size_t kMostComponents = 8;
/// Components are added until they hold this share of the variance: what is left of places that differ by decimetres is
/// then below what repetitions differ by. (ours)
inline constexpr double kHeldVariance = 0.9995;
inline constexpr float kNearLoci = 25.5f;    ///< degrees; the design's 25° and the rounding of what is annotated
inline constexpr float kLeastNoise = 5;      ///< millimetres
inline constexpr float kLeastTurnNoise = 3;  ///< degrees

/// Takes a captured stroke to other places, orientations and swivels: the fine movement between the phase points, the
/// fingers and the timing stay as captured. As far as arms can do it (fit_change). `own` are the points of the captured
/// stroke. Hands that touch keep to each other.
FittedChange change_to(StrokeChanger& changer, const CapturedStroke& stroke, const PhasePoints& own,
                       const PhasePoints& wanted);

/// "learned from 23 tokens at 7 loci, expected error 6 mm, 3°".
std::string why_learned(const LearnedStroke& stroke, const Prediction& prediction);
/// "geometric from DONNER#4: 2 tokens with loci are too few"; `reason` is Learned::why_not or Prediction::why_outside.
std::string why_geometric(const std::string& token, const std::string& reason);

}  // namespace signweave
