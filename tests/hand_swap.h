#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "signweave/features/hand_points.h"
#include "signweave/motion/kinematics.h"

/// How far a hand is from its place when it is that of another token of the same gloss, against how far the tokens are
/// from each other.
namespace signweave::hand_swap {

/// Of a stroke, each token at the same share of its own duration.
inline constexpr std::size_t kMoments = 9;

/// A hand at the moments of a stroke: the palm and the fingertips that the rig has, signer-centred, metres.
struct HandPath {
  std::vector<Eigen::Vector3f> palms;              ///< [moment]
  std::vector<std::vector<Eigen::Vector3f>> tips;  ///< [moment][finger]
};

/// Mean distances of two paths, millimetres.
struct Distance {
  float palm = 0;
  float tips = 0;
};

/// Distances of the right hand, one for each pair of tokens of a gloss.
struct Figures {
  std::vector<Distance> repetitions;  ///< of two tokens as captured
  std::vector<Distance> swapped;      ///< of a token and itself with the hand of another
  std::vector<Distance> kept;         ///< of that hand and the same as captured
  std::size_t refused = 0;            ///< places that cannot be kept, such as of hands that touch
};

inline HandPath path_of(const Motion& motion, const SignerModel& signer, FrameRange stroke) {
  const HandPlaces places(signer.rig, Side::right);
  HandPath path;
  HandPoints points;
  for (std::size_t i = 0; i < kMoments; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kMoments - 1);
    const auto frame = stroke.begin + std::llround(share * static_cast<double>(stroke.size() - 1));
    const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
    const SignerSpace space = signer_space(*signer.body, signer.rig, pose);
    places.read(pose, points);
    const auto place_of = [&](const Eigen::Vector3f& point) -> Eigen::Vector3f {
      return signer.body->shoulder_width * space.to_signer(point);
    };
    path.palms.push_back(place_of(palm_of(points)));
    std::vector<Eigen::Vector3f>& tips = path.tips.emplace_back();
    for (const HandPoints::OneFinger& finger : points.fingers) {
      if (finger.count > 0) tips.push_back(place_of(finger.points[finger.count - 1]));
    }
  }
  return path;
}

inline Distance distance(const HandPath& a, const HandPath& b) {
  Distance sum;
  for (std::size_t i = 0; i < kMoments; ++i) {
    sum.palm += 1000 * (a.palms[i] - b.palms[i]).norm() / kMoments;
    const std::size_t tips = std::min(a.tips[i].size(), b.tips[i].size());
    for (std::size_t k = 0; k < tips; ++k) {
      sum.tips += 1000 * (a.tips[i][k] - b.tips[i][k]).norm() / static_cast<float>(kMoments * tips);
    }
  }
  return sum;
}

/// Measures the first tokens of each gloss, at most `most` of each.
inline Figures measure(const Database& database, const std::vector<std::string>& glosses, std::size_t most) {
  const Snapshot snapshot = database.snapshot();
  Figures figures;
  for (const std::string& gloss : glosses) {
    std::vector<Candidate> tokens = candidates_for(snapshot.contents(), SignRef{.gloss = {gloss, 0}});
    if (tokens.size() > most) tokens.resize(most);
    std::vector<HandPath> captured;
    for (const Candidate& token : tokens) {
      const RecordingInfo& info = snapshot.contents().recordings[token.recording];
      const std::unique_ptr<MotionSource> source = snapshot.motion(info);
      Motion motion(source->skeleton(), source->rate(), token.core.size());
      source->read(token.core, motion.poses({0, token.core.size()}));
      captured.push_back(path_of(motion, *snapshot.signer(info), {0, token.core.size()}));
    }
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      for (std::size_t j = 0; j < tokens.size(); ++j) {
        if (i == j) continue;
        if (i < j) figures.repetitions.push_back(distance(captured[i], captured[j]));
        Place place = place_of({gloss, tokens[i].token});
        PartSign hand;
        hand.sign.gloss = {gloss, tokens[j].token};
        place.parts = {{.part = BodyPart::right, .signs = {hand}, .places = 1}};
        try {
          const Synthesis made =
              synthesize(database, Utterance{.places = {place}, .holds = {}, .non_manuals = {}}).result;
          const std::string& reference = made.score.skeleton.recording;
          const HandPath swapped =
              path_of(made.motion, *snapshot.signer(snapshot.contents().at(reference)), made.score.clips.back().at);
          figures.swapped.push_back(distance(swapped, captured[i]));
          figures.kept.push_back(distance(swapped, captured[j]));
        } catch (const Error&) {
          ++figures.refused;
        }
      }
    }
  }
  return figures;
}

/// The value below which a share of the distances lie, for palms and tips on their own.
inline Distance quantile(const std::vector<Distance>& all, double share) {
  const auto of = [&](float Distance::*member) {
    std::vector<float> values;
    for (const Distance& one : all) values.push_back(one.*member);
    std::ranges::sort(values);
    return values.empty() ? 0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {of(&Distance::palm), of(&Distance::tips)};
}

/// "palm 12.3 mm (at most 40), fingertips …": medians and maxima.
inline std::string text_of(const std::vector<Distance>& all) {
  const Distance median = quantile(all, 0.5);
  const Distance most = quantile(all, 1);
  return fmt::format("palm {:.1f} mm (at most {:.1f}), fingertips {:.1f} mm (at most {:.1f}), {} pairs", median.palm,
                     most.palm, median.tips, most.tips, all.size());
}

}  // namespace signweave::hand_swap
