// Tests of what is learned from captured spans, and which of them are stored.

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "signweave/transition/test_gap_motion.h"

namespace signweave {
namespace {

using namespace testing_gap;

const GapMethod& known_method(std::string_view name) {
  return *find_gap_method(name);
}

void add(TransitionTrainer& trainer, std::size_t recording, const Motion& motion, FrameRange frames) {
  const JointGroups of = groups();
  trainer.add(recording, cut(motion, of, frames), view_of(motion, frames));
}
/// Adds spans of all lengths for which values are learned.
void add_spans(TransitionTrainer& trainer, std::size_t recording, const Motion& motion) {
  for (const std::int64_t count : {17, 28, 52, 73, 106}) {
    for (std::int64_t begin = 40; begin + count + 40 < motion.frame_count(); begin += 50) {
      add(trainer, recording, motion, {begin, begin + count});
    }
  }
}

double error_of(const Filled& made, const Motion& motion, FrameRange frames, std::size_t joint) {
  double error = 0;
  for (std::int64_t frame = 0; frame < frames.size(); ++frame) {
    error += angle(made.at(frame, joint), motion.pose(frames.begin + frame).rotations[joint]);
  }
  return error / static_cast<double>(frames.size());
}

TEST(Trainer, LeftOutRecordingsAreNotUsed) {
  const Motion tested = lively(0.2);
  const Motion other = lively(3.9);  // another movement with the same recording number
  TransitionTrainer a;
  TransitionTrainer b;
  for (TransitionTrainer* trainer : {&a, &b}) {
    add_spans(*trainer, 0, lively(1.1));
    add_spans(*trainer, 1, trainer == &a ? tested : other);
    add_spans(*trainer, 2, lively(2.2));
  }
  const auto without_a = a.model_without(1);
  const auto without_b = b.model_without(1);
  EXPECT_EQ(without_a->bends, without_b->bends);
  EXPECT_EQ(without_a->damping, without_b->damping);
  EXPECT_NE(a.model()->bends, b.model()->bends);
  const JointGroups of = groups();
  for (const GapMethod& method : gap_methods()) {
    const Gap gap = cut(tested, of, {90, 130});
    EXPECT_TRUE(same_bits(fill(method, gap, *without_a), fill(method, gap, *without_b))) << method.name;
    const bool learns = method.name == "taught" || method.name == "learned" || method.name == "recorded" ||
                        method.name == "hermite" || method.name == "quintic";
    EXPECT_EQ(!same_bits(fill(method, gap, *a.model()), fill(method, gap, *b.model())), learns) << method.name;
  }
}

TEST(Trainer, OnCubicsTheWholeVelocityContinues) {
  TransitionTrainer trainer;
  for (int seed = 0; seed < 6; ++seed) {
    const Motion motion = motion_of({100, 1}, 300, [seed](std::size_t joint, double t) {
      const double s = t - 1.5;
      return about(axis_of(joint), 0.4 * s * s * s - 0.5 * s + 0.1 * (seed + 1) * s * s);
    });
    add_spans(trainer, static_cast<std::size_t>(seed), motion);
  }
  const auto model = trainer.model();
  for (const auto& knot : model->damping) {
    for (const JointGroup group : {JointGroup::body, JointGroup::left_arm, JointGroup::right_arm}) {
      const auto& shares = knot[static_cast<std::size_t>(group)];
      EXPECT_NEAR(shares[static_cast<std::size_t>(Damped::velocity)], 1, 0.03);
      EXPECT_NEAR(shares[static_cast<std::size_t>(Damped::quintic_velocity)], 1, 0.05);
    }
    // No data: it is unchanged.
    EXPECT_FLOAT_EQ(knot[static_cast<std::size_t>(JointGroup::right_fingers)][0], 1);
  }
}

TEST(Trainer, BetweenRestsNoVelocityContinues) {
  // Next to the gap all joints tremble at random speeds; inside they follow the cubic from rest to rest.
  TransitionTrainer trainer;
  const FrameRange gap{100, 150};
  for (int seed = 0; seed < 12; ++seed) {
    const auto outside = [seed](std::size_t joint, double t) {
      return 0.2 * std::sin(9 * t + 1.3 * static_cast<double>(joint) + 2.1 * seed);
    };
    const Motion motion = motion_of({100, 1}, 250, [&](std::size_t joint, double t) {
      const double from = outside(joint, 0.99);
      const double to = outside(joint, 1.5);
      const double x = (t - 0.99) / 0.51;
      const bool inside = x > 0 && x < 1;
      return about(axis_of(joint), inside ? from + (3 * x * x - 2 * x * x * x) * (to - from) : outside(joint, t));
    });
    add(trainer, static_cast<std::size_t>(seed), motion, gap);
  }
  const auto model = trainer.model();
  EXPECT_LT(damping_of(*model, Damped::velocity, JointGroup::left_arm, 0.51), 0.1f);
  EXPECT_LT(damping_of(*model, Damped::quintic_velocity, JointGroup::left_arm, 0.51), 0.1f);
}

/// From pose to pose, with every movement bent in the same manner.
Motion bending(double seed, double bend) {
  return motion_of({100, 1}, 620, [seed, bend](std::size_t joint, double t) {
    const auto pose = [&](double i) { return 0.6 * std::sin(2.7 * i + seed + static_cast<double>(joint)); };
    const double i = std::floor(t);
    const double x = std::clamp((t - i - 0.3) / 0.51, 0.0, 1.0);  // rests from 0.81 to 1.3
    const double progress = x * x * (3 - 2 * x) + bend * 16 * x * x * (1 - x) * (1 - x);
    const bool arm = joint == kUpper || joint == kFore || joint == kRightUpper || joint == kRightFore;
    return about(axis_of(joint), arm ? pose(i) + progress * (pose(i + 1) - pose(i)) : 0.0);
  });
}
/// The gap from rest to rest in the i-th second.
FrameRange gap_in(int i) {
  return {100 * i + 31, 100 * i + 81};
}

TEST(Trainer, LearnedBendsApplyToUnseenMotion) {
  TransitionTrainer trainer;
  for (std::size_t recording = 0; recording < 5; ++recording) {
    const Motion motion = bending(0.7 * static_cast<double>(recording), 0.2);
    for (int i = 1; i < 5; ++i) add(trainer, recording, motion, gap_in(i));
  }
  const auto model = trainer.model_without(4);
  const Motion motion = bending(0.7 * 4, 0.2);
  const JointGroups of = groups();
  for (const std::string_view name : {"learned", "recorded"}) {
    double taught = 0;
    double plain = 0;
    for (int i = 1; i < 5; ++i) {
      const Gap gap = cut(motion, of, gap_in(i));
      for (const std::size_t joint : {kUpper, kFore}) {
        taught += error_of(fill(known_method(name), gap, *model), motion, gap_in(i), joint);
        plain += error_of(fill(known_method(name), gap, untaught()), motion, gap_in(i), joint);
      }
    }
    EXPECT_LT(taught, 0.75 * plain) << name;
  }
}

TEST(Trainer, NonFiniteValuesInOneJointAffectNoOther) {
  TransitionTrainer sound;
  TransitionTrainer broken;
  for (std::size_t recording = 0; recording < 3; ++recording) {
    const Motion motion = lively(static_cast<double>(recording));
    add_spans(sound, recording, motion);
    Motion bad = motion;
    for (std::int64_t frame = 0; frame < bad.frame_count(); ++frame) {
      bad.pose(frame).rotations[kHead].coeffs().setConstant(std::numeric_limits<float>::quiet_NaN());
    }
    add_spans(broken, recording, bad);
  }
  const auto model = broken.model();
  for (const Bends& bends : model->bends) {
    for (const float one : bends) ASSERT_TRUE(std::isfinite(one));
  }
  for (std::size_t knot = 0; knot < kKnots.size(); ++knot) {
    const auto arm = static_cast<std::size_t>(JointGroup::left_arm);  // its joints follow the head
    EXPECT_EQ(model->damping[knot][arm], sound.model()->damping[knot][arm]);
    for (const auto& group : model->damping[knot]) {
      for (const float one : group) ASSERT_TRUE(std::isfinite(one));
    }
  }
}

TEST(Trainer, AModelOutlivesItAndIsImmutable) {
  auto trainer = std::make_unique<TransitionTrainer>();
  add(*trainer, 0, lively(0.1), {100, 140});
  const auto model = trainer->model();
  const JointGroups of = groups();
  const Motion motion = lively(0.15);
  const Gap gap = cut(motion, of, {100, 140});
  const Filled made = fill(known_method("recorded"), gap, *model);
  EXPECT_FALSE(same_bits(made, fill(known_method("kriging"), gap, *model)));
  add(*trainer, 1, lively(0.2), {100, 140});
  ASSERT_EQ(model->libraries.size(), 1u);
  EXPECT_EQ(model->libraries[0]->spans.size(), 1u);
  EXPECT_EQ(trainer->model()->libraries[0]->spans.size(), 2u);
  trainer.reset();
  EXPECT_TRUE(same_bits(fill(known_method("recorded"), gap, *model), made));
}

TEST(SpanLibrary, ReproducesASpanOfTheLibrary) {
  const JointGroups of = groups();
  const Motion motion = lively(8.1);
  for (const FrameRange frames : {FrameRange{60, 80}, FrameRange{100, 150}}) {
    const Gap gap = cut(motion, of, frames);
    SpanCollector collector;
    ASSERT_TRUE(collector.add(gap, view_of(motion, frames)));
    const auto model = collector.take_model();
    const Filled made = fill(known_method("recorded"), gap, *model);
    const Filled kriged = fill(known_method("kriging"), gap, *model);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      const double off = error_of(made, motion, frames, joint);
      EXPECT_LT(off, 0.01) << frames.size() << ", joint " << joint;
      EXPECT_LT(off, 0.5 * error_of(kriged, motion, frames, joint) + 1e-3) << frames.size() << ", joint " << joint;
    }
  }
}

TEST(SpanLibrary, IgnoresSpansOfAPurgedRecording) {
  const JointGroups of = groups();
  const Motion motion = lively(8.1);
  TransitionTrainer trainer;
  add(trainer, 5, motion, {100, 150});
  const Gap gap = cut(motion, of, {100, 150});
  EXPECT_TRUE(same_bits(fill(known_method("recorded"), gap, *trainer.model_without(5)),
                        fill(known_method("kriging"), gap, untaught())));
  EXPECT_FALSE(
      same_bits(fill(known_method("recorded"), gap, *trainer.model()), fill(known_method("kriging"), gap, untaught())));
}

TEST(SpanLibrary, MatchesOneSkeletonOnly) {
  // The same number of joints, but different ones, whose axes are not comparable.
  const JointGroups of = groups();
  const Motion motion = lively(8.1);
  const Motion other = lively(8.1, {100, 1}, 300, body("Pelvis"));
  SpanCollector collector;
  EXPECT_TRUE(collector.add(cut(other, of, {100, 150}), view_of(other, {100, 150})));
  const auto model = collector.take_model();
  const Gap gap = cut(motion, of, {100, 150});
  EXPECT_TRUE(same_bits(fill(known_method("recorded"), gap, *model), fill(known_method("kriging"), gap, *model)));
  EXPECT_EQ(collector.take_model()->libraries.size(), 0u);
}

TEST(SpanLibrary, SkipsNonFiniteSpans) {
  const JointGroups of = groups();
  Motion motion = lively(8.1);
  motion.pose(120).rotations[kFinger].coeffs().setConstant(std::numeric_limits<float>::quiet_NaN());
  SpanCollector collector;
  EXPECT_FALSE(collector.add(cut(motion, of, {100, 150}), view_of(motion, {100, 150})));
  EXPECT_TRUE(collector.add(cut(motion, of, {160, 200}), view_of(motion, {160, 200})));
}

TEST(SpanLibrary, DeviationsBeyondHalfATurnAreSmooth) {
  // It rotates by more than half a turn from the middle of its borders, where choosing the sign again would cause a
  // jump.
  const auto turn = [](std::size_t joint, double t) { return about(axis_of(joint), 10.5 * std::sin(3 * (t - 1.25))); };
  const Motion motion = motion_of({100, 1}, 300, turn);
  const JointGroups of = groups();
  const FrameRange frames{150, 205};
  SpanCollector collector;
  ASSERT_TRUE(collector.add(cut(motion, of, frames), view_of(motion, frames)));
  const auto model = collector.take_model();
  const std::vector<Eigen::Vector3f>& strays = model->libraries[0]->spans[0].strays;
  for (std::size_t i = 1; i < strays.size(); ++i) {
    if (i % CapturedSpan::kPoints != 0) {
      EXPECT_LT((strays[i] - strays[i - 1]).norm(), 1.5f) << i;
    }
  }
}

}  // namespace
}  // namespace signweave
