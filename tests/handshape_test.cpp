// The handshape of a sign is reached when its stroke begins: with every transition method, at every tempo, after a
// pause, and when the transition is shortened.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "signweave/choose/synthesizer.h"
#include "signweave/database/test_signing.h"
#include "signweave/features/hand_points.h"
#include "tests/demo_database.h"

namespace signweave {
namespace {

using testing_database::TestFolder;

const Database& corpus_of_handshapes() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = demo_database(folder / "db", 4);
  return *database;
}

Handshape shape_of(const Motion& motion, const RigMap& rig, Side side, PoseView pose) {
  HandPoints points;
  HandPlaces(rig, side).read(to_model_space(motion.skeleton(), pose), points);
  return handshape_of(points, axes_of(points, side));
}

TEST(HandshapeOnTheDemo, IsReachedByTheBeginningOfTheStrokeWithEveryMethod) {
  struct Setting {
    const char* utterance;
    double tempo = 1;
    Milliseconds duration{0};  // 0: as in the corpus
  };
  const Setting settings[] = {{"VANNES MATIN PLUIE NUAGES BRETAGNE VANNES"},
                              {"VANNES , MATIN . PLUIE , NUAGES"},
                              {"VANNES MATIN PLUIE NUAGES BRETAGNE", 2},
                              {"VANNES MATIN PLUIE NUAGES BRETAGNE", 0.5},
                              {"VANNES MATIN PLUIE NUAGES BRETAGNE", 1, Milliseconds(80)}};
  std::map<std::string, Motion> recordings;
  for (const RecordingInfo& info : corpus_of_handshapes().contents()->recordings) {
    recordings.emplace(info.name, corpus_of_handshapes().read(info.name));
  }
  std::size_t changes = 0;
  for (const TransitionMethod& method : transition_methods()) {
    for (const Setting& setting : settings) {
      SynthesisOptions options{.method = &method, .tempo = setting.tempo};
      if (setting.duration > Milliseconds(0)) {
        options.duration = {.fixed = setting.duration};
      }
      const Synthesis made = synthesize(corpus_of_handshapes(), parse_utterance(setting.utterance), options).result;
      const RigMap rig = model_of(made.motion).rig;
      for (std::size_t i = 0; i < made.junctions.size(); ++i) {
        const Junction& junction = made.junctions[i];
        const ShownClip& to = made.clips[i + 1];
        ASSERT_EQ(to.core.begin, junction.frames.end);
        const Motion& recording = recordings.at(to.recording);
        for (const Side side : kSides) {
          const auto shape = [&](std::int64_t frame) {
            return shape_of(made.motion, rig, side, made.motion.pose(frame));
          };
          const std::string where = fmt::format("{} at tempo {}, '{}', junction {}", method.name, setting.tempo,
                                                setting.utterance, junction.number);
          // The stroke's first frame has the captured handshape.
          const Handshape wanted = shape_of(recording, rig, side, recording.pose(std::llround(to.first_frame)));
          EXPECT_LT(distance(shape(junction.frames.end), wanted), 1e-4f) << where;
          // One frame earlier, nineteen twentieths of the change are done, unless there was no time: in a short
          // transition one frame is more than a twentieth.
          const float change = distance(shape(junction.frames.begin - 1), wanted);
          if (change < 0.1f || junction.frames.size() < 20) continue;
          ++changes;
          EXPECT_LT(distance(shape(junction.frames.end - 1), wanted), 0.05f * change + 0.002f) << where;
        }
      }
    }
  }
  EXPECT_GT(changes, 100u);
}

}  // namespace
}  // namespace signweave
