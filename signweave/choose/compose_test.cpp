// Tests of channels that show other clips than the whole body.
#include "signweave/choose/compose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "signweave/core/error.h"
#include "signweave/notation/score_json.h"
#include "signweave/render/render.h"
#include "signweave/rig/test_rig.h"
#include "signweave/score/test_motion.h"

namespace signweave::composing {
namespace {

using testing::HasSubstr;
using testing_motion::motion_of;

const std::shared_ptr<const Skeleton>& person() {
  static const std::shared_ptr<const Skeleton> skeleton = whole_person();
  return skeleton;
}

const SignerRig& rig() {
  static const SignerRig rig = [] {
    SignerRig made;
    made.signer.rig = rig_of_signer(*person());
    // Without a body, hands are not corrected: the random poses of these motions are no signing.
    made.groups = joint_groups(*person(), made.signer.rig);
    return made;
  }();
  return rig;
}

MotionClip sign(const std::string& name, float seed, std::int64_t preparation = 20, std::int64_t stroke = 40,
                std::int64_t retraction = 25) {
  return testing_motion::clip(name, seed, preparation, stroke, retraction, {100, 1}, person());
}

std::vector<MotionClip> three_signs() {
  return {sign("A", 0.1f), sign("B", 0.8f, 30, 33, 40), sign("C", 1.7f, 25, 50, 10)};
}

ChannelClip part(Channel channel, MotionClip clip, std::size_t first, std::size_t last) {
  return {.channel = channel, .clip = std::move(clip), .first = first, .last = last, .sync = {{.with = first}}};
}

ConcatenateOptions options() {
  return {.duration = 300ms, .rig = &rig(), .alignment = Alignment::none};
}

std::string fault(const std::vector<MotionClip>& clips, const ChannelParts& parts) {
  try {
    compose(clips, parts, options());
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

FrameRange item_at(const Score& score, Channel channel, std::size_t item) {
  return lane_of(score, channel)->items.at(item).at;
}

TEST(ComposeTest, APartBeginsWithItsPlaceAndTheNextPlaceWaitsForIt) {
  const Synthesis made =
      compose(three_signs(), {{part(Channel::left, sign("X", 2.5f, 20, 120, 20), 1, 1)}, {}}, options());
  const Score& score = made.score;
  ASSERT_EQ(score.clips.size(), 4u);
  EXPECT_EQ(body_clips(score), 3u);
  EXPECT_EQ(score.clips[3].at.begin, score.clips[1].at.begin);
  EXPECT_EQ(score.clips[3].at.size(), 120);
  EXPECT_EQ(score.clips[2].at.begin, score.clips[3].at.end + 30);
  EXPECT_EQ(made.clips[3].channel, Channel::left);
  ASSERT_EQ(made.signs.size(), 4u);
  EXPECT_EQ(made.signs[3].sign.gloss, "X");
  EXPECT_EQ(made.signs[3].channel, Channel::left);
}

TEST(ComposeTest, AShorterPartIsHeldUntilItsTransition) {
  const Synthesis made = compose({sign("A", 0.1f), sign("B", 0.8f, 30, 200, 40), sign("C", 1.7f)},
                                 {{part(Channel::left, sign("X", 2.5f, 20, 20, 20), 1, 1)}, {}}, options());
  const Lane& left = *lane_of(made.score, Channel::left);
  ASSERT_EQ(left.items.size(), 6u);
  ASSERT_TRUE(std::holds_alternative<Hold>(left.items[3].what));
  const FrameRange held = left.items[3].at;
  EXPECT_EQ(held.begin, made.score.clips[3].at.end);
  EXPECT_EQ(held.end, made.score.clips[2].at.begin - 30);
  const auto arm = static_cast<std::size_t>(*person()->find("LeftArm"));
  for (std::int64_t frame = held.begin; frame < held.end; ++frame) {
    EXPECT_EQ(made.motion.pose(frame).rotations[arm].coeffs(),
              made.motion.pose(held.begin - 1).rotations[arm].coeffs());
  }
}

TEST(ComposeTest, StrokesCanBeginApartAndEndTogether) {
  ChannelParts parts{{part(Channel::left, sign("X", 2.5f), 1, 1)}, {}};
  parts.clips[0].sync = {{.with = 1, .offset = 120ms}};
  const Synthesis later = compose(three_signs(), parts, options());
  EXPECT_EQ(later.score.clips[3].at.begin, later.score.clips[1].at.begin + 12);
  parts.clips[0].sync = {{.anchor = ClipSync::Anchor::end, .with = 1}};
  const Synthesis together = compose(three_signs(), parts, options());
  EXPECT_EQ(together.score.clips[3].at.end, together.score.clips[1].at.end);
}

TEST(ComposeTest, AContradictionNamesWhatCannotBeTrueTogether) {
  ChannelParts parts{{part(Channel::left, sign("X", 2.5f), 1, 1)}, {}};
  parts.clips[0].sync.push_back({.anchor = ClipSync::Anchor::end, .with = 1});
  EXPECT_THAT(
      fault(three_signs(), parts),
      HasSubstr(
          "these cannot all be true: 'X' (left) begins with 'B'; 'X' (left) ends with 'B'; strokes keep their length"));
  parts = {{part(Channel::left, sign("X", 2.5f), 1, 1)}, {{.channel = Channel::left, .from = 0, .until = 2}}};
  EXPECT_THAT(fault(three_signs(), parts),
              HasSubstr("the lane 'left' cannot show the held 'A' and 'X' at the same time"));
  parts = {{part(Channel::left, sign("X", 2.5f), 0, 1), part(Channel::left, sign("Y", 2.5f), 1, 1)}, {}};
  EXPECT_THAT(fault(three_signs(), parts), HasSubstr("the lane 'left' cannot show 'Y' and 'X' at the same time"));
}

TEST(ComposeTest, AHandHoldsItsPoseOverPlaces) {
  const Synthesis made = compose(three_signs(), {{}, {{.channel = Channel::left, .from = 0, .until = 1}}}, options());
  const Lane& left = *lane_of(made.score, Channel::left);
  ASSERT_EQ(left.items.size(), 4u);  // A, held, transition, C
  EXPECT_TRUE(std::holds_alternative<Hold>(left.items[1].what));
  EXPECT_GE(left.items[1].at.end, made.score.clips[1].at.end);
}

TEST(ComposeTest, AHandHeldUntilTheEndFallsWithTheBody) {
  const ChannelParts held{{}, {{.channel = Channel::left, .from = 0, .until = 2}}};
  std::vector<MotionClip> clips = three_signs();
  clips[2] = sign("C", 1.7f, 25, 50, 70);
  const Synthesis plain = compose(clips, {}, options());
  const Synthesis made = compose(clips, held, options());
  ASSERT_EQ(lane_of(made.score, Channel::left)->items.size(), 4u);  // A, held, transition, the body's retraction
  EXPECT_EQ(item_at(made.score, Channel::left, 1),
            (FrameRange{made.score.clips[0].at.end, made.score.clips[2].at.end}));
  EXPECT_EQ(item_at(made.score, Channel::left, 2).end, made.score.frames - 5);
  EXPECT_EQ(made.score.frames, plain.score.frames);
  const auto arm = static_cast<std::size_t>(*person()->find("LeftArm"));
  const auto at_end = [&](const Synthesis& one) { return one.motion.pose(one.score.frames - 1).rotations[arm]; };
  EXPECT_LT(testing_motion::angle(at_end(made), at_end(plain)), 1e-3);
  // Without enough of a retraction the body waits for it.
  const Synthesis later = compose(three_signs(), held, options());
  EXPECT_EQ(item_at(later.score, Channel::left, 2).size(), 30);
  EXPECT_EQ(later.score.frames, later.score.clips[2].at.end + 35);
  EXPECT_EQ(item_at(later.score, Channel::body, 5).size(), 25);
  // Without one it stays up.
  clips[2] = sign("C", 1.7f, 25, 50, 0);
  const Synthesis up = compose(clips, held, options());
  EXPECT_EQ(item_at(up.score, Channel::left, 1), (FrameRange{up.score.clips[0].at.end, up.score.frames}));
}

TEST(ComposeTest, FingersFillTheStrokeOfAnotherSign) {
  ChannelParts parts{{part(Channel::right_fingers, sign("X", 2.5f, 20, 90, 20), 1, 1)}, {}};
  parts.clips[0].fill = true;
  const Synthesis made = compose(three_signs(), parts, options());
  EXPECT_EQ(made.score.clips[3].at, made.score.clips[1].at);
  EXPECT_EQ(made.score.lanes.size(), kChannels.size() + 1);
  const auto finger = static_cast<std::size_t>(*person()->find("RightHandIndex1"));
  const auto arm = static_cast<std::size_t>(*person()->find("RightArm"));
  const std::int64_t at = made.score.clips[1].at.begin;
  EXPECT_LT(
      testing_motion::angle(made.motion.pose(at).rotations[finger],
                            motion_of(parts.clips[0].clip).pose(parts.clips[0].clip.core.begin).rotations[finger]),
      1e-3);
  EXPECT_LT(testing_motion::angle(made.motion.pose(at).rotations[arm],
                                  motion_of(three_signs()[1]).pose(three_signs()[1].core.begin).rotations[arm]),
            1e-3);
}

/// Two clips of one recording whose transition is captured.
std::vector<MotionClip> neighbours() {
  MotionClip first = sign("A", 0.1f, 20, 40, 90);
  MotionClip second = first;
  second.core = {first.core.end + 50, first.core.end + 80};
  second.whole = {first.core.end + 10, first.whole.end};
  second.continues = true;
  first.whole.end = second.core.begin;
  return {first, second};
}

TEST(ComposeTest, NeighboursKeepTheirRecordedTransitionWhileAPartSignsSomethingElse) {
  const std::vector<MotionClip> clips = neighbours();
  const Synthesis made = compose(clips, {{part(Channel::left, sign("X", 2.5f, 20, 20, 20), 0, 0)}, {}}, options());
  EXPECT_EQ(made.score.clips[1].at.begin, made.score.clips[0].at.end + 50);
  const Motion& source = motion_of(clips[0]);
  const auto left = static_cast<std::size_t>(*person()->find("LeftArm"));
  bool left_differs = false;
  for (std::int64_t frame = 0; frame < made.score.clips[1].at.end; ++frame) {
    const PoseView recorded = source.pose(clips[0].whole.begin + frame);
    for (std::size_t joint = 0; joint < person()->joint_count(); ++joint) {
      const bool same = made.motion.pose(frame).rotations[joint].coeffs() == recorded.rotations[joint].coeffs();
      if (joint == left) left_differs = left_differs || !same;
      const JointGroup group = rig().groups.of[joint];
      if (group != JointGroup::left_arm && group != JointGroup::left_fingers)
        ASSERT_TRUE(same) << frame << ' ' << joint;
    }
  }
  EXPECT_TRUE(left_differs);
}

/// A random utterance of a few signs, of which parts of the body sign something else.
struct Drawn {
  std::vector<MotionClip> clips;
  ChannelParts parts;
};
Drawn drawn() {
  const auto frames = [](int least, int most) { return std::int64_t{*rc::gen::inRange(least, most)}; };
  int number = 0;
  const auto draw_sign = [&] {
    MotionClip made = sign(std::string(1, static_cast<char>('A' + number)), 0.37f * static_cast<float>(number),
                           frames(0, 40), frames(1, 60), frames(0, 40));
    ++number;
    Motion motion = motion_of(made);  // some joints have the other sign
    const auto joint = *rc::gen::inRange<std::size_t>(0, person()->joint_count());
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      motion.pose(frame).rotations[joint].coeffs() *= -1.0f;
    }
    made.source = std::make_shared<MemorySource>(std::move(motion));
    return made;
  };
  Drawn made;
  const auto count = *rc::gen::inRange<std::size_t>(1, 6);
  for (std::size_t i = 0; i < count; ++i) made.clips.push_back(draw_sign());
  const auto parts = *rc::gen::inRange(0, 4);
  for (int i = 0; i < parts; ++i) {
    const auto first = *rc::gen::inRange<std::size_t>(0, count);
    const auto last = *rc::gen::inRange<std::size_t>(first, count);
    const Channel channel =
        *rc::gen::element(Channel::left, Channel::right, Channel::left_fingers, Channel::right_fingers, Channel::head);
    if (*rc::gen::inRange(0, 3) == 0 && last > first) {
      made.parts.holds.push_back({channel, first, last});
      continue;
    }
    made.parts.clips.push_back(part(channel, draw_sign(), first, last));
    ChannelClip& drawn = made.parts.clips.back();
    if (*rc::gen::inRange(0, 3) == 0) drawn.sync[0].offset = Milliseconds(*rc::gen::inRange(-400, 400));
    if (*rc::gen::inRange(0, 4) == 0) drawn.fill = true;
    if (*rc::gen::inRange(0, 4) == 0) {
      made.parts.clips.push_back(part(channel, draw_sign(), first, last));
      made.parts.clips.back().sync.clear();
    }
  }
  return made;
}

std::optional<Synthesis> composed(const Drawn& from) {
  const auto methods = transition_methods();
  try {
    ConcatenateOptions some = options();
    some.method = &methods[*rc::gen::inRange<std::size_t>(0, methods.size())];
    some.duration = Milliseconds(*rc::gen::inRange(0, 700));
    some.tempo = *rc::gen::element(1.0, 1.0, 0.8, 1.7);
    return compose(from.clips, from.parts, some);
  } catch (const Error& error) {
    RC_TAG("contradiction");
    RC_ASSERT(error.code() == ErrorCode::bad_input);
    return std::nullopt;
  }
}

std::vector<MotionClip> all_clips(const Drawn& from) {
  std::vector<MotionClip> clips = from.clips;
  for (const ChannelClip& one : from.parts.clips) clips.push_back(one.clip);
  return clips;
}

/// The score's clips as a reader of the score gets them.
std::vector<MotionClip> read_clips(const Score& score, const Drawn& from) {
  const std::vector<MotionClip> all = all_clips(from);
  return clips_of(score, [&](const SourceRef& source) {
    const auto at = std::ranges::find(all, source.recording, &MotionClip::recording);
    return ScoreSource{at->source, at->noise};
  });
}

Motion frames_of(const Motion& motion, FrameRange frames) {
  Motion some(motion.shared_skeleton(), motion.rate(), frames.size());
  BorrowedSource(motion).read(frames, some.poses({0, frames.size()}));
  return some;
}

RC_GTEST_PROP(ComposeTest, AScoreWithPartsReadsBackAndAnyFramesHaveTheBitsOfTheWhole, ()) {
  const Drawn from = drawn();
  const std::optional<Synthesis> made = composed(from);
  if (!made) return;
  const Score read = score_from_json(json_of(made->score), "score.json");
  RC_ASSERT(read == made->score);
  const std::vector<MotionClip> clips = read_clips(read, from);
  Renderer renderer(plan_of(read, clips),
                    {.skeleton = person(), .rate = read.rate, .method = &transition_methods().front(), .rig = &rig()});
  Motion some;
  for (int i = 0; i < 8; ++i) {
    const auto begin = *rc::gen::inRange<std::int64_t>(0, read.frames + 1);
    const auto most = std::min<std::int64_t>(read.frames - begin, i % 2 == 0 ? 5 : 400);
    const FrameRange frames{begin, begin + *rc::gen::inRange<std::int64_t>(0, most + 1)};
    renderer.render(frames, some);
    RC_ASSERT(same_bits(some, frames_of(made->motion, frames)));
  }
}

/// The joints that a lane alone decides on.
std::vector<std::size_t> joints_of(Channel channel, const Score& score) {
  const auto has = [&](Channel part) { return lane_of(score, part) != nullptr; };
  std::vector<std::size_t> joints;
  for (std::size_t joint = 0; joint < person()->joint_count(); ++joint) {
    const JointGroup group = rig().groups.of[joint];
    const bool of_left_fingers = group == JointGroup::left_fingers;
    const bool of_right_fingers = group == JointGroup::right_fingers;
    switch (channel) {
      case Channel::left:
        if (group == JointGroup::left_arm || (of_left_fingers && !has(Channel::left_fingers))) joints.push_back(joint);
        break;
      case Channel::right:
        if (group == JointGroup::right_arm || (of_right_fingers && !has(Channel::right_fingers))) {
          joints.push_back(joint);
        }
        break;
      case Channel::left_fingers:
        if (of_left_fingers) joints.push_back(joint);
        break;
      case Channel::right_fingers:
        if (of_right_fingers) joints.push_back(joint);
        break;
      case Channel::body:
        if (joint == 0) joints.push_back(joint);
        break;
      default:
        break;
    }
  }
  return joints;
}

RC_GTEST_PROP(ComposeTest, EveryLaneShowsItsStrokesAsCapturedAndMovesWithoutJumps, ()) {
  const Drawn from = drawn();
  std::optional<Synthesis> made;
  try {
    made = compose(from.clips, from.parts, options());
  } catch (const Error&) {
    return;
  }
  const std::vector<MotionClip> clips = read_clips(made->score, from);
  for (const Lane& lane : made->score.lanes) {
    const std::vector<std::size_t> joints = joints_of(lane.channel, made->score);
    for (const Item& item : lane.items) {
      const auto* const use = std::get_if<ClipUse>(&item.what);
      if (use == nullptr) continue;
      const Clip& clip = made->score.clips[use->clip];
      if (clip.step != 1) continue;
      for (std::int64_t frame = clip.at.begin; frame < clip.at.end; ++frame) {
        const PoseView source = motion_of(clips[use->clip]).pose(clip.core.begin + frame - clip.at.begin);
        for (const std::size_t joint : joints) {
          const Eigen::Quaternionf& shown = made->motion.pose(frame).rotations[joint];
          RC_ASSERT(shown.coeffs() == source.rotations[joint].coeffs() ||
                    shown.coeffs() == Eigen::Vector4f(-source.rotations[joint].coeffs()));
        }
      }
    }
  }
  for (std::int64_t frame = 1; frame < made->score.frames; ++frame) {
    for (std::size_t joint = 0; joint < person()->joint_count(); ++joint) {
      RC_ASSERT(made->motion.pose(frame - 1).rotations[joint].dot(made->motion.pose(frame).rotations[joint]) > 0);
    }
  }
}

}  // namespace
}  // namespace signweave::composing
