// Properties of every method in the table.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <thread>

#include "signweave/transition/test_gap_motion.h"

namespace signweave {

void PrintTo(const GapMethod& method, std::ostream* out) {
  *out << method.name;
}

namespace {

using namespace testing_gap;

const GapMethod& method_of(std::string_view name) {
  const GapMethod* method = find_gap_method(name);
  if (method == nullptr) throw std::runtime_error(std::string(name));
  return *method;
}

class EveryMethod : public testing::TestWithParam<GapMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn(gap_methods().begin(), gap_methods().end()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(EveryMethod, AStillBodyStaysStill) {
  const auto resting = [](std::size_t joint, double) {
    return about(axis_of(joint), 0.3 * static_cast<double>(joint));
  };
  const JointGroups of = groups();
  const Motion still = motion_of({100, 1}, 120, resting);
  for (const std::int64_t count : {1, 20, 60}) {
    const Gap gap = cut(still, of, {40, 40 + count});
    const Filled made = fill(GetParam(), gap, *model_with_spans());
    for (std::int64_t frame = 0; frame < count; ++frame) {
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        EXPECT_LT(angle(made.at(frame, joint), still.pose(0).rotations[joint]), 2e-4) << joint << ' ' << frame;
      }
      EXPECT_LT((made.translations[static_cast<std::size_t>(frame)] - still.pose(0).translations[0]).norm(), 1e-5f);
    }
  }
}

TEST_P(EveryMethod, AStillHandOfAMovingBodyStaysStill) {
  const Motion moving = lively(9.3);
  Motion motion = moving;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (std::size_t joint = kRightUpper; joint <= kRightHand; ++joint) {
      motion.pose(frame).rotations[joint] = moving.pose(0).rotations[joint];
    }
  }
  const JointGroups of = groups();
  const Filled made = fill(GetParam(), cut(motion, of, {100, 140}), *model_with_spans());
  for (std::int64_t frame = 0; frame < 40; ++frame) {
    for (std::size_t joint = kRightUpper; joint <= kRightHand; ++joint) {
      EXPECT_LT(angle(made.at(frame, joint), moving.pose(0).rotations[joint]), 2e-4) << joint << ' ' << frame;
    }
  }
}

TEST_P(EveryMethod, QuaternionsAreUnitAndKeepOneHemisphere) {
  const JointGroups of = groups();
  for (const FrameRate rate : {FrameRate{1, 1}, FrameRate{30, 1}, FrameRate{100, 1}, FrameRate{2000, 1}}) {
    Motion motion = lively(2.1, rate, 200);
    for (std::int64_t frame = 100; frame < 200; ++frame) {  // each side has its own signs
      for (Eigen::Quaternionf& q : motion.pose(frame).rotations) q.coeffs() *= -1.0f;
    }
    for (const std::int64_t count : {1, 2, 19, 60}) {
      for (const std::int64_t context : {1, 2, 3, 1000}) {
        const Gap gap = cut(motion, of, {101 - count, 101}, context);
        const Filled made = fill(GetParam(), gap, *model_with_spans());
        for (std::size_t joint = 0; joint < kJoints; ++joint) {
          Eigen::Quaternionf last = gap.left().rotations[joint];
          for (std::int64_t frame = 0; frame < count; ++frame) {
            const Eigen::Quaternionf& q = made.at(frame, joint);
            ASSERT_NEAR(q.norm(), 1.0f, 2e-6f) << rate.hertz() << " Hz, " << count << " frames, " << context;
            ASSERT_GT(q.dot(last), 0.0f) << rate.hertz() << " Hz, " << count << " frames, " << context;
            last = q;
          }
        }
        for (const Eigen::Vector3f& place : made.translations) ASSERT_TRUE(place.allFinite());
      }
    }
  }
}

TEST_P(EveryMethod, HalfATurnBetweenBordersIsFilledSmoothly) {
  const JointGroups of = groups();
  for (const double off : {-1e-3, -1e-7, 0.0, 1e-7, 1e-3}) {
    const auto turn = [off](std::size_t joint, double t) {
      return about(axis_of(joint), t < 0.55 ? 0.0 : std::numbers::pi + off);
    };
    const Motion motion = motion_of({100, 1}, 150, turn);
    const Filled made = fill(GetParam(), cut(motion, of, {55, 95}), *model_with_spans());
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      double travelled = 0;
      Eigen::Quaternionf last = motion.pose(54).rotations[joint];
      for (std::int64_t frame = 0; frame <= 40; ++frame) {
        const Eigen::Quaternionf q = frame < 40 ? made.at(frame, joint) : motion.pose(95).rotations[joint];
        ASSERT_TRUE(q.coeffs().allFinite());
        travelled += angle(last, q);
        last = q;
      }
      EXPECT_NEAR(travelled, std::numbers::pi, 0.35) << joint << ' ' << off;  // bends are learned, so this is not exact
    }
  }
}

TEST_P(EveryMethod, OtherGroupsKeepTheirBits) {
  const Motion motion = lively(3.3);
  const JointGroups of = groups();
  const Gap gap = cut(motion, of, {100, 130});
  const Filled all = fill(GetParam(), gap, *model_with_spans());
  for (const JointGroup group : {JointGroup::body, JointGroup::left_arm, JointGroup::left_fingers}) {
    const Filled one = fill(GetParam(), gap, *model_with_spans(), {group});
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        const bool untouched = one.at(frame, joint).coeffs() == kUntouched.coeffs();
        EXPECT_EQ(untouched, of.of[joint] != group) << joint;
        // Only the filled group is compared with captured spans; all other methods work joint by joint.
        if (untouched || GetParam().needs == Needs::spans) continue;
        EXPECT_EQ(one.at(frame, joint).coeffs(), all.at(frame, joint).coeffs()) << joint;
      }
    }
    EXPECT_EQ(one.translations[3] == Eigen::Vector3f(7, 7, 7), group != JointGroup::body);
  }
}

TEST_P(EveryMethod, ResultsDoNotDependOnTheScratch) {
  const Motion motion = lively(4.4);
  const JointGroups of = groups();
  const Gap gap = cut(motion, of, {100, 133});
  const Filled first = fill(GetParam(), gap, *model_with_spans());
  GapScratch used;
  fill(GetParam(), cut(motion, of, {60, 190}), *model_with_spans(), used);
  fill(GetParam(), cut(motion, of, {200, 201}, 1), *model_with_spans(), used);
  EXPECT_TRUE(same_bits(fill(GetParam(), gap, *model_with_spans(), used), first));
}

TEST_P(EveryMethod, ThreadsMayShareAModel) {
  const Motion motion = lively(5.5);
  const JointGroups of = groups();
  const Gap gap = cut(motion, of, {100, 133});
  const std::shared_ptr<const TransitionModel> model = model_with_spans();
  const Filled alone = fill(GetParam(), gap, *model);
  std::array<Filled, 3> made;
  {
    std::vector<std::jthread> threads;
    for (Filled& one : made) threads.emplace_back([&, &one = one] { one = fill(GetParam(), gap, *model); });
  }
  for (const Filled& one : made) EXPECT_TRUE(same_bits(one, alone));
}

/// Rotating a joint's rotations from the left rotates the result: no method depends on the direction of up.
TEST_P(EveryMethod, IsRotationInvariant) {
  const GapMethod& method = GetParam();
  EXPECT_TRUE(rc::check([&method] {
    const auto number = [](int from, int to) { return static_cast<float>(*rc::gen::inRange(from, to)) / 100; };
    const Motion motion = lively(static_cast<double>(number(0, 600)));
    const std::int64_t begin = *rc::gen::inRange(40, 160);
    const std::int64_t count = *rc::gen::inRange(1, 90);
    const JointGroups of = groups();
    const Filled made = fill(method, cut(motion, of, {begin, begin + count}), *model_with_spans());
    std::vector<Eigen::Quaternionf> turns;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      const Eigen::Vector3f axis(number(-100, 100), number(-100, 100), number(10, 100));
      turns.push_back(about(axis, static_cast<double>(number(-300, 300))));
    }
    Motion turned = motion;
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        turned.pose(frame).rotations[joint] = turns[joint] * motion.pose(frame).rotations[joint];
      }
    }
    const Filled other = fill(method, cut(turned, of, {begin, begin + count}), *model_with_spans());
    for (std::int64_t frame = 0; frame < count; ++frame) {
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        RC_ASSERT((turns[joint] * made.at(frame, joint)).dot(other.at(frame, joint)) > 0.0f);
        RC_ASSERT(angle(turns[joint] * made.at(frame, joint), other.at(frame, joint)) < 1e-3);
      }
    }
  }));
}

TEST_P(EveryMethod, NonFiniteValuesStayInTheirJoint) {
  const Motion sound = lively(6.6);
  const JointGroups of = groups();
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0.0f}) {
    for (const FrameRange where : {FrameRange{99, 100}, FrameRange{130, 131}, FrameRange{0, 300}, FrameRange{95, 97}}) {
      Motion motion = sound;
      for (std::int64_t frame = where.begin; frame < where.end; ++frame) {
        motion.pose(frame).rotations[kFore].coeffs().setConstant(bad);
        motion.pose(frame).translations[0].setConstant(bad);
      }
      const Filled made = fill(GetParam(), cut(motion, of, {100, 130}), *model_with_spans());
      for (std::int64_t frame = 0; frame < 30; ++frame) {
        for (std::size_t joint = 0; joint < kJoints; ++joint) {
          if (joint == kFore) continue;
          ASSERT_NEAR(made.at(frame, joint).norm(), 1.0f, 2e-6f) << joint << " next to " << bad;
        }
      }
    }
  }
}

TEST_P(EveryMethod, ALongGapSwingsNoFartherThanAShortOne) {
  // Every joint rotates at 3 rad/s at both borders.
  const FrameRate rate{2000, 1};
  constexpr std::int64_t kSide = 700;
  const JointGroups of = groups();
  const auto farthest = [&](std::int64_t count) {
    Motion motion = motion_of(rate, 2 * kSide, [&](std::size_t joint, double t) {
      return about(axis_of(joint), t < kSide / 2000.0 ? 3 * t : 3 * (t - 2 * kSide / 2000.0));
    });
    Gap gap = cut(motion, of, {kSide, kSide});
    gap.count = count;
    const Filled made = fill(GetParam(), gap, *model_with_spans(), {JointGroup::left_arm});
    double most = 0;
    for (std::int64_t frame = 0; frame < count; frame += 7) {
      most = std::max(most, angle(made.at(frame, kUpper), gap.left().rotations[kUpper]));
    }
    return most;
  };
  EXPECT_LT(farthest(120'000), 2.2 + 0.9 * farthest(3'000));
  // Otherwise it would make whole turns. (A reflected side keeps rotating for as long as it did before.)
  if (GetParam().name != "crossfade") {
    EXPECT_LT(farthest(120'000), 3.1);
  }
}

// Additional properties of some methods.

struct Promise {
  std::string_view name;
  double share;  ///< share of a border's speed that may be lost within a frame
};

class EveryPromise : public testing::TestWithParam<Promise> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryPromise,
                         testing::Values(Promise{"kriging", 0.12}, Promise{"recorded", 0.12}, Promise{"quintic", 0.08},
                                         Promise{"hermite", 0.12}, Promise{"inertialize", 0.08}, Promise{"gap", 0.3},
                                         Promise{"learned", 0.25}),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(EveryPromise, VelocityIsContinuousAtBothBorders) {
  // The default model damps and bends on purpose, which is tested elsewhere. Here velocities continue completely.
  TransitionModel model = untaught();
  model.libraries = model_with_spans()->libraries;
  const JointGroups of = groups();
  for (const FrameRate rate : {FrameRate{60, 1}, FrameRate{120, 1}, FrameRate{500, 1}}) {
    const auto hertz = static_cast<std::int64_t>(rate.hertz());
    const Motion motion = lively(7.7, rate, 3 * hertz);
    for (const double seconds : {0.25, 0.6, 1.0}) {
      const std::int64_t begin = hertz;
      const std::int64_t count = std::llround(seconds * rate.hertz());
      const Gap gap = cut(motion, of, {begin, begin + count});
      const Filled made = fill(method_of(GetParam().name), gap, model);
      const double time = rate.frame_time().count();
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        if (joint == kFinger && GetParam().name == "learned") continue;  // only a quarter of it continues, on purpose
        const auto pose = [&](std::int64_t frame) {
          const bool inside = frame >= begin && frame < begin + count;
          return inside ? made.at(frame - begin, joint) : motion.pose(frame).rotations[joint];
        };
        const auto velocity = [&](std::int64_t frame) -> Eigen::Vector3f {  // in the joint's own axes
          Eigen::Quaternionf step = pose(frame).conjugate() * pose(frame + 1);
          if (step.w() < 0) step.coeffs() *= -1.0f;
          return step.vec() * static_cast<float>(2 / time);
        };
        for (const std::int64_t border : {begin - 1, begin + count}) {
          const bool left = border < begin;
          const Eigen::Vector3f outside = velocity(left ? border - 1 : border);
          const Eigen::Vector3f inside = velocity(left ? border : border - 1);
          // A method that continues velocity may change it within a frame by some acceleration.
          const double allowed = GetParam().share * 3.0 + 40 * time;
          EXPECT_LT((inside - outside).norm(), allowed)
              << "joint " << joint << (left ? " left, " : " right, ") << rate.hertz() << " Hz, " << seconds << " s";
        }
      }
    }
  }
}

TEST(Methods, ASteadyRotationContinuesSteadily) {
  const JointGroups of = groups();
  for (const auto& [rate, most] : {std::pair{FrameRate{30, 1}, 0.05}, {FrameRate{120, 1}, 0.05}}) {
    const auto hertz = static_cast<std::int64_t>(rate.hertz());
    const Motion motion = motion_of(
        rate, 3 * hertz, [](std::size_t joint, double t) { return about(axis_of(joint), 1.2 * t - 1.5); },
        [](double t) { return Eigen::Vector3f(static_cast<float>(t), 1, 0); });
    for (const double seconds : {0.17, 0.5, 1.0}) {
      const std::int64_t count = std::llround(seconds * rate.hertz());
      const Gap gap = cut(motion, of, {hertz, hertz + count});
      for (const std::string_view name : {"slerp", "hermite", "quintic", "kriging", "learned"}) {
        const Filled made = fill(method_of(name), gap, untaught());
        const bool exact = name == "slerp" || name == "hermite" || name == "quintic";
        for (std::int64_t frame = 0; frame < count; ++frame) {
          for (std::size_t joint = 0; joint < kJoints; ++joint) {
            if (name == "learned" && joint == kFinger) continue;
            EXPECT_LT(angle(made.at(frame, joint), motion.pose(hertz + frame).rotations[joint]),
                      exact ? 2e-4 : most * 1.2 * seconds + 1e-3)
                << name << ' ' << rate.hertz() << ' ' << seconds << ' ' << frame;
          }
          EXPECT_LT(
              (made.translations[static_cast<std::size_t>(frame)] - motion.pose(hertz + frame).translations[0]).norm(),
              exact ? 2e-4 : most * seconds + 1e-3)
              << name;
        }
      }
    }
  }
}

TEST(Methods, NamesAreUniqueAndTheDefaultIsForSigning) {
  std::vector<std::string_view> names;
  for (const GapMethod& method : gap_methods()) {
    EXPECT_EQ(find_gap_method(method.name), &method) << method.name;
    EXPECT_FALSE(method.description.empty());
    names.push_back(method.name);
  }
  EXPECT_EQ(gap_methods().front().offered, Offered::signing);
  EXPECT_EQ(find_gap_method("nothing"), nullptr);
}

}  // namespace
}  // namespace signweave
