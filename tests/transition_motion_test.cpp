// The hand motion between the signs of the paper's two scenarios: assembled from the stored features of phases, against
// the captured motion itself.

#include <gtest/gtest.h>

#include "signweave/features/transition_stats.h"
#include "signweave/kv/test_folder.h"
#include "signweave/semantic_db/semantic_db.h"
#include "tests/demo_database.h"

namespace signweave {
namespace {

TEST(TransitionMotion, FromStoredFeaturesEqualsThatOfTheCapturedMotion) {
  kv::TestFolder folder;
  const std::vector<demo::Script> scripts = {demo::meteo(), demo::villes()};
  const std::unique_ptr<const Database> database = demo_database(folder / "db", scripts);
  const std::shared_ptr<const Contents> contents = database->contents();
  std::size_t compared = 0;
  for (std::uint32_t i = 0; i < 2; ++i) {
    const RecordingInfo& info = contents->recordings[i];
    SCOPED_TRACE(info.name);
    const Motion motion = database->read(info.name);
    const SignerModel model = model_of(motion);
    const RecordingFeatures features = database->features(info.name);
    const std::vector<Sign> signs = signs_of(contents->segments, i);
    const std::vector<std::vector<std::size_t>> places = phase_places_of(contents->segments, i);
    ASSERT_EQ(places.size(), signs.size());
    const auto phases_of = [&](std::size_t sign) {
      std::vector<PhaseFeatures> phases;
      for (const std::size_t place : places[sign]) phases.push_back(features.phases.at(place));
      return phases;
    };
    for (const AnnotatedTransition& transition : transitions_in(signs)) {
      const auto found = motion_between(signs[transition.from], phases_of(transition.from), signs[transition.to],
                                        phases_of(transition.to), features.shoulder_width);
      ASSERT_TRUE(found.has_value());
      const FrameRange between = frames_of(transition.span, info.clock);
      const FrameRange frames{between.begin - 1, between.end + 1};  // the last of one stroke, the first of the other
      const HandMotion hands = measure_hands(motion, model, frames);
      for (std::size_t side = 0; side < 2; ++side) {
        const std::vector<HandFrame>& path = hands.hands[side].frames;
        double length = 0;
        for (std::size_t k = 1; k < path.size(); ++k) length += (path[k].position - path[k - 1].position).norm();
        const double width = features.shoulder_width;
        const double straight = (path.back().position - path.front().position).norm();
        EXPECT_NEAR(found->whole[side].displacement, straight * width, 1e-5);
        EXPECT_NEAR(found->whole[side].path, length * width, 0.01 + 0.05 * length * width);
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 2u * (32 + 21));
}

}  // namespace
}  // namespace signweave
