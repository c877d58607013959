// Tests of the scores of joined clips: they round-trip through JSON, give the same frames, and are rejected if they
// cannot be rendered.
#include "signweave/score/score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>

#include "signweave/choose/concatenate.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/error.h"
#include "signweave/notation/score_json.h"
#include "signweave/render/render.h"
#include "signweave/score/test_motion.h"

namespace signweave {
namespace {

using testing::HasSubstr;
using testing_motion::clip;

std::vector<MotionClip> clips_to_join() {
  std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 40), clip("C", 1.7f, 60, 50, 0),
                                   clip("D", 2.9f, 0, 20, 30, {50, 1})};
  clips[1].fingerprint = 0xFEDCBA9876543210;
  clips[2].pause_before = 350ms;
  clips[3].junction = {find_transition_method("overlap"), 300ms, 1.25};
  return clips;
}

/// The clips of a score, with the motions of other clips.
std::vector<MotionClip> clips_from(const Score& score, const std::vector<MotionClip>& from) {
  return clips_of(score, [&](const SourceRef& source) {
    for (const MotionClip& one : from) {
      if (one.recording == source.recording) return ScoreSource{one.source, one.noise};
    }
    throw Error(ErrorCode::not_found, source.recording);
  });
}

/// The result of rendering a score with the motions of some clips.
Synthesis rendered(const Score& score, const std::vector<MotionClip>& from) {
  const std::vector<MotionClip> clips = clips_from(score, from);
  const SignerRig rig = signer_rig_of(from.front());
  Synthesis out;
  render(score, clips,
         {.skeleton = from.front().source->skeleton(),
          .rate = score.rate,
          .method = &transition_methods().front(),
          .rig = &rig},
         out);
  return out;
}

std::vector<MotionClip> drawn_clips() {
  std::vector<MotionClip> clips;
  const int count = *rc::gen::inRange(1, 6);
  for (int i = 0; i < count; ++i) {
    const auto frames = [](int least, int most) { return std::int64_t{*rc::gen::inRange(least, most)}; };
    const FrameRate rate = *rc::gen::element(FrameRate{100, 1}, FrameRate{50, 1}, FrameRate{30'000, 1001});
    clips.push_back(clip(std::string(1, static_cast<char>('A' + i)), 0.37f * static_cast<float>(i), frames(0, 50),
                         frames(1, 60), frames(0, 50), rate));
    clips.back().fingerprint = *rc::gen::arbitrary<std::uint64_t>();
    clips.back().signs.front().gloss = *rc::gen::element<std::string>("A", "\"[1,\n 2]\\", "\\\"[ 3 ]", "手話 [4]");
    clips.back().pause_before = Milliseconds(*rc::gen::element(0, 0, 350));
    if (*rc::gen::inRange(0, 3) == 0) {
      const auto methods = transition_methods();
      clips.back().junction = {&methods[*rc::gen::inRange<std::size_t>(0, methods.size())], 250ms, 1.5};
    }
  }
  return clips;
}

Synthesis joined(const std::vector<MotionClip>& clips) {
  const auto methods = transition_methods();
  return concatenate(clips, {.method = &methods[*rc::gen::inRange<std::size_t>(0, methods.size())],
                             .duration = Milliseconds(*rc::gen::inRange(0, 900)),
                             .tempo = *rc::gen::element(1.0, 1.0, 0.8, 1.7),
                             .alignment = *rc::gen::element(Alignment::automatic, Alignment::ground, Alignment::none)});
}

RC_GTEST_PROP(ScoreOfClips, ReadsBackEqualAndGivesTheSameFrames, ()) {
  const std::vector<MotionClip> clips = drawn_clips();
  const Synthesis made = joined(clips);
  const std::string json = json_of(made.score);
  const Score read = score_from_json(json, "score.json");
  RC_ASSERT(read == made.score);
  RC_ASSERT(json_of(read) == json);
  const Synthesis again = rendered(read, clips);
  RC_ASSERT(same_bits(again.motion, made.motion));
  RC_ASSERT(again.junctions.size() == made.junctions.size());
  for (std::size_t i = 0; i < made.junctions.size(); ++i) {
    RC_ASSERT(again.junctions[i].method == made.junctions[i].method);
    RC_ASSERT(again.junctions[i].chosen == made.junctions[i].chosen);
    RC_ASSERT(again.junctions[i].number == made.junctions[i].number);
  }
  RC_ASSERT(again.signs.size() == made.signs.size());
  for (std::size_t i = 0; i < made.signs.size(); ++i) RC_ASSERT(again.signs[i].sign == made.signs[i].sign);
}

/// Some frames of a motion.
Motion part_of(const Motion& motion, FrameRange frames) {
  const MemorySource source(motion);
  Motion part(motion.shared_skeleton(), motion.rate(), frames.size());
  source.read(frames, part.poses({0, frames.size()}));
  for (const ScalarTrack& track : motion.tracks()) {
    part.add_track({track.name, {track.values.begin() + frames.begin, track.values.begin() + frames.end}});
  }
  return part;
}

RC_GTEST_PROP(ScoreOfClips, AnyFramesInAnyOrderHaveTheBitsOfTheWhole, ()) {
  std::vector<MotionClip> clips = drawn_clips();
  for (std::size_t i = 0; i < clips.size(); i += 2) {  // some have a track that others lack, some are rotated
    Motion motion = testing_motion::motion_of(clips[i]);
    std::vector<float> values;
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      values.push_back(std::sin(0.1f * static_cast<float>(frame)));
    }
    motion.add_track({i % 4 == 0 ? "smile" : "brow", values});
    const auto joint = *rc::gen::inRange<std::size_t>(0, 4);
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      motion.pose(frame).rotations[joint].coeffs() *= -1.0f;
    }
    clips[i].source = std::make_shared<MemorySource>(std::move(motion));
  }
  const Synthesis whole = joined(clips);
  const std::vector<MotionClip> of_score = clips_from(whole.score, clips);
  const SignerRig rig = signer_rig_of(clips.front());
  Renderer renderer(plan_of(whole.score, of_score), {.skeleton = clips.front().source->skeleton(),
                                                     .rate = whole.score.rate,
                                                     .method = &transition_methods().front(),
                                                     .rig = &rig});
  Motion made;
  for (int i = 0; i < 12; ++i) {
    const auto begin = *rc::gen::inRange<std::int64_t>(0, whole.motion.frame_count() + 1);
    const auto most = std::min<std::int64_t>(whole.motion.frame_count() - begin, i % 2 == 0 ? 5 : 400);
    const FrameRange frames{begin, begin + *rc::gen::inRange<std::int64_t>(0, most + 1)};
    renderer.render(frames, made);
    RC_ASSERT(same_bits(made, part_of(whole.motion, frames)));
  }
  RC_ASSERT_THROWS_AS(renderer.render({0, whole.motion.frame_count() + 1}, made), Error);
}

TEST(ScoreOfClips, HasAReadableText) {
  const Synthesis made = concatenate(clips_to_join(), {.duration = 480ms});
  const std::string text = to_string(made.score);
  EXPECT_THAT(text, HasSubstr("frames at 100 frames a second, with the joints of 'A'\n"));
  EXPECT_THAT(text, HasSubstr("clip 1, place 1: B from 'B' "));
  EXPECT_THAT(text, HasSubstr("junction 3 by overlap: body "));
  EXPECT_THAT(text, HasSubstr("clip 3, place 3: D from 'D' 7-27, 0.5 frames a frame\n"));
}

/// The error for a score's JSON with one text replaced by another.
std::string fault_of(const std::string& text, const std::string& instead, bool all = false) {
  std::string json = json_of(concatenate(clips_to_join(), {.duration = 480ms}).score);
  std::size_t at = json.find(text);
  EXPECT_NE(at, std::string::npos) << text;
  for (; at != std::string::npos; at = all ? json.find(text, at + instead.size()) : std::string::npos) {
    json.replace(at, text.size(), instead);
  }
  try {
    score_from_json(json, "my.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

TEST(ScoreOfClips, ErrorsSayWhereAndWhat) {
  EXPECT_EQ(fault_of("\"id\": 1", "\"id\": 1"), "no fault");
  EXPECT_THAT(fault_of("{", "["), HasSubstr("my.json:"));
  EXPECT_THAT(fault_of("\"signweave_score\": 1", "\"signweave_score\": 4"), HasSubstr("a score of version 4"));
  EXPECT_THAT(fault_of("\"signweave_score\"", "\"other\""), HasSubstr("my.json: the whole: it must be a score"));
  EXPECT_THAT(fault_of("\"id\": 1", "\"id\": 2"), HasSubstr("clip 1 has the id 2"));
  EXPECT_THAT(fault_of("\"id\": 1", "\"id\": -1"), HasSubstr("clips[1].id: it must be a whole number of 0 or more"));
  EXPECT_THAT(fault_of("\"step\": 1.0", "\"step\": 1e-300"), HasSubstr("a step is a number from"));
  EXPECT_THAT(fault_of("\"step\": 1.0", "\"step\": 1e999"), HasSubstr("my.json: a number that is too large"));
  EXPECT_THAT(fault_of("\"step\": 1.0", "\"step\": null"), HasSubstr("clips[0].step: it must be a number"));
  EXPECT_THAT(fault_of("\"fingerprint\": \"fedcba9876543210\"", "\"fingerprint\": \"x\""), HasSubstr("hexadecimal"));
  EXPECT_THAT(fault_of("\"hand\": \"both\"", "\"hand\": \"left-ish\""), HasSubstr("one of both, right, left"));
  EXPECT_THAT(fault_of("\"method\": \"overlap\"", "\"method\": \"fade\""), HasSubstr("no transition method 'fade'"));
  EXPECT_THAT(fault_of("\"channel\": \"left\"", "\"channel\": \"body\""),
              HasSubstr("lane 'body' is where 'left' belongs"));
  EXPECT_THAT(fault_of("\"retraction\": ", "\"retraction\": 9"),
              HasSubstr("lane 'body': the transition from clip 0 to 1 keeps more"));
  EXPECT_THAT(fault_of("\"frames\": ", "\"frames\": 1"), HasSubstr("lane 'body' ends at frame"));
  EXPECT_THAT(fault_of("\"frames\": ", "\"frames\": 99999999"), HasSubstr("a score has 1 to 8640000"));
  EXPECT_THAT(fault_of("\"at\": [20, 60]", "\"at\": [20, 9000000000000000000]"),
              HasSubstr("my.json: clip 0 is at frames 20 to 9000000000000000000 of"));
  EXPECT_THAT(fault_of("\"at\": [20, 60]", "\"at\": [20, 50]"), HasSubstr("clip 0 shows 40 frames in 30, 1 a frame"));
  EXPECT_THAT(fault_of("\"at\": [20, 60]", "\"at\": [20, 61]"), HasSubstr("clip 0 shows 40 frames in 41, 1 a frame"));
  EXPECT_THAT(fault_of("\"rate\": [100, 1]", "\"rate\": [1, 9000000000]"), HasSubstr("a score has 0.001 to 1000000"));
  EXPECT_THAT(fault_of("\"frame_time\": 0.01", "\"frame_time\": 0"), HasSubstr("the clock of clip 0 begins at 0 s"));
  EXPECT_THAT(fault_of("\"ms\": [70, 920]", "\"ms\": [-9223372036854775807, 920]"), HasSubstr("has no valid time"));
  EXPECT_THAT(fault_of("\"at\": [20, 60]", "\"at\": 20"), HasSubstr("clips[0].at: it must be a list"));
  EXPECT_THAT(fault_of("\"recording\": \"B\"", "\"kind\": \"shown\", \"recording\": \"B\""),
              HasSubstr("clip 1 names a recording, but is of kind 'shown'"));
  EXPECT_THAT(fault_of("\"recording\": \"B\"", "\"kind\": \"dream\", \"recording\": \"B\""),
              HasSubstr("one of recording, rest, shown"));
}

TEST(ScoreOfClips, TheFuzzCorpusContainsReadableScores) {
  const std::filesystem::path folder = std::filesystem::path(SIGNWEAVE_SOURCE_DIR) / "testdata/score";
  EXPECT_EQ(score_from_json(read_file(folder / "three_signs.json"), "three_signs.json").clips.size(), 3u);
  const Score second = score_from_json(read_file(folder / "two_hands.json"), "two_hands.json");
  EXPECT_EQ(version_of(second), 2);
  EXPECT_EQ(second.curves.size(), 2u);
}

TEST(ScoreOfClips, ACrossFadeOfASingleLaneIsRejected) {
  // The frames compared between both sides would then follow the body's cut and lie outside the other lanes.
  Score score = concatenate(clips_to_join(), {.method = find_transition_method("overlap"), .duration = 200ms}).score;
  ASSERT_GT(std::get<Transition>(score.lanes[0].items[1].what).cut.overlap(), 0);
  EXPECT_NO_THROW(check(score, "score"));
  for (std::size_t lane = 1; lane < score.lanes.size(); ++lane) {
    std::vector<Item>& items = score.lanes[lane].items;
    Transition& made = std::get<Transition>(items[1].what);
    made.cut.retraction_frames = made.cut.preparation_frames = 0;
    items[0].at.end = items[1].at.begin = score.clips[0].at.end;
    items[1].at.end = items[2].at.begin = score.clips[1].at.begin;
  }
  try {
    check(score, "score");
    ADD_FAILURE() << "no fault";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("junction 1 is cross-faded, so its cut must be the same"));
  }
}

TEST(ScoreOfClips, ClipsBeyondTheirMotionAreRejected) {
  const std::vector<MotionClip> clips = clips_to_join();
  Score score = concatenate(clips, {.duration = 480ms}).score;
  score.clips[1].whole.end = 10'000;
  EXPECT_THROW(rendered(score, clips), Error);
  score = concatenate(clips, {.duration = 480ms}).score;
  score.clips[0].whole.begin = score.clips[0].core.begin;  // its preparation is shown but does not exist
  EXPECT_THROW(rendered(score, clips), Error);
  score = concatenate(clips, {.duration = 480ms}).score;
  score.clips[1].step = 2;  // its core ends beyond its frames
  EXPECT_THROW(rendered(score, clips), Error);
  score = concatenate(clips, {.duration = 480ms}).score;
  for (Item& item : score.lanes.back().items) {  // tracks continue longer than captured
    if (Transition* const made = std::get_if<Transition>(&item.what)) made->cut.retraction_frames = 41;
  }
  EXPECT_THROW(rendered(score, clips), Error);
}

TEST(ScoreJson, ChangesWithNumbersThatAreNoneAreRefused) {
  Score score = concatenate(clips_to_join(), {}).score;
  ClipChange change{.asked = "big"};
  change.stroke.arms[1] = ArmChange{.path = {{}, {.shift = {0.1f, 0, 0}, .turn = {0, 0.2f, 0}, .swivel = 0.3f}}};
  score.clips[1].changes = {change};
  EXPECT_EQ(score_from_json(json_of(score), "score.json"), score);
  const auto why = [&](const auto& spoil) -> std::string {
    Score wrong = score;
    spoil(wrong.clips[1].changes[0]);
    try {
      check(wrong, "score.json");
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  const std::string numbers = "a stroke is changed by numbers that are no map, turn or path; sign its utterance again";
  EXPECT_EQ(why([](ClipChange& one) { one.stroke.arms[1]->to.x() = std::numeric_limits<float>::infinity(); }), numbers);
  EXPECT_EQ(why([](ClipChange& one) { one.stroke.arms[1]->turn.coeffs().setZero(); }), numbers);
  EXPECT_EQ(why([](ClipChange& one) { one.stroke.arms[1]->path.resize(65); }), numbers);
  EXPECT_EQ(why([](ClipChange& one) { one.stroke.trunk_yaw = 4; }), numbers);
  EXPECT_EQ(why([](ClipChange& one) { one.stroke.together = true; }), numbers);
  EXPECT_THAT(why([](ClipChange& one) { one.share = 2; }), HasSubstr("a change of clip 1 has no finite sizes"));
}

}  // namespace
}  // namespace signweave
