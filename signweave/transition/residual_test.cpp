#include "signweave/transition/residual.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "signweave/core/error.h"
#include "signweave/transition/fade.h"
#include "signweave/transition/fill.h"
#include "signweave/transition/learned.h"
#include "signweave/transition/movements.h"
#include "signweave/transition/test_gap_motion.h"

namespace signweave {
namespace {

using namespace testing_gap;
using Eigen::Quaternionf;
using Eigen::Vector3f;

/// A gap in a lively motion, with wrists that deviate from the most likely trajectory: by `bow` times the distance
/// between the borders, in its middle.
struct Bowed {
  Motion motion;
  JointGroups of = groups();
  Gap gap;
  Motion kriged, captured;

  Bowed(double seed, std::int64_t count, float bow) : motion(lively(seed)) {
    gap = cut(motion, of, {100, 100 + count});
    kriged.reset(motion.shared_skeleton(), motion.rate(), count);
    GapScratch scratch;
    static const TransitionModel kUntaught;
    fill_kriging({.gap = gap, .model = kUntaught, .scratch = scratch}, kriged.poses({0, count}));
    captured = kriged;
    for (const Side side : kSides) {
      ArmScratch arms;
      const std::optional<ArmSight> sight = see_arm(gap, side, arms);
      const ArmChain& chain = arms.chains[static_cast<std::size_t>(side)];
      for (std::int64_t frame = 0; frame < count; ++frame) {
        const MutablePoseView pose = captured.pose(frame);
        place_arm(chain, pose, arms.pose);
        const float share = bow * residual_bends(moment_of(gap, frame))[0] * sight->length;
        shift_wrist(motion.skeleton(), chain.joints, arms.pose, share * sight->traits[0], pose);
      }
    }
  }
  std::optional<ResidualSpan> span(std::size_t fold) const {
    ArmScratch arms;
    return residual_span(fold, gap, view_of(captured, {0, gap.count}), view_of(kriged, {0, gap.count}), arms);
  }
  Motion made(std::shared_ptr<const ResidualModel> residuals) const {
    TransitionModel model;
    model.residuals = std::move(residuals);
    Motion out(motion.shared_skeleton(), motion.rate(), gap.count);
    GapScratch scratch;
    fill_taught({.gap = gap, .model = model, .scratch = scratch}, out.poses({0, gap.count}));
    return out;
  }
  /// Mean distance of the wrists from their captured positions.
  float error(const Motion& out) const {
    float sum = 0;
    for (const Side side : kSides) {
      ArmChain chain;
      find_arm(motion.skeleton(), of, side, chain);
      ModelPose pose;
      for (std::int64_t frame = 0; frame < gap.count; ++frame) {
        const Vector3f place = place_arm(chain, captured.pose(frame), pose);
        sum += (place_arm(chain, out.pose(frame), pose) - place).norm();
      }
    }
    return sum / static_cast<float>(2 * gap.count);
  }
};

std::vector<ResidualSpan> spans_of(float bow, int count) {
  std::vector<ResidualSpan> spans;
  for (int i = 0; i < count; ++i) {
    const Bowed bowed(0.37 * i, 50 + i % 7 * 6, bow);
    if (auto span = bowed.span(static_cast<std::size_t>(i % 4))) spans.push_back(*std::move(span));
  }
  return spans;
}

bool same(const Motion& a, const Motion& b) {
  return std::ranges::equal(a.rotations(), b.rotations(),
                            [](const Quaternionf& x, const Quaternionf& y) { return x.coeffs() == y.coeffs(); });
}

TEST(Residuals, LearnsDeviationsOfWristsFromTheMostLikelyTrajectory) {
  const std::vector<ResidualSpan> spans = spans_of(0.4f, 60);
  ASSERT_GT(spans.size(), 50u);
  const auto model = std::make_shared<const ResidualModel>(learn_residuals(spans));
  EXPECT_TRUE(wins(*model));
  EXPECT_EQ(model->folds, 4u);
  EXPECT_EQ(model->movements, spans.size());
  EXPECT_LT(model->mean_ratio, 0.5f);
  EXPECT_LT(model->median_ratio, 0.5f);
  const Bowed other(77.7, 60, 0.4f);
  EXPECT_LT(other.error(other.made(model)), 0.5f * other.error(other.kriged));
}

TEST(Residuals, WithoutDeviationsNothingIsStored) {
  const std::vector<ResidualSpan> spans = spans_of(0, 40);
  const ResidualModel model = learn_residuals(spans);
  EXPECT_FALSE(wins(model));
  EXPECT_TRUE(model.centres.empty());
  const ResidualModel few = learn_residuals(std::span(spans).first(kLeastSpans - 1));
  EXPECT_EQ(few.folds, 0u);
  EXPECT_TRUE(few.centres.empty());
}

TEST(Residuals, ShortGapsAndEmptyModelsGiveExactlyTheKrigedTrajectory) {
  const auto model = std::make_shared<const ResidualModel>(learn_residuals(spans_of(0.4f, 40)));
  const Bowed longer(5.5, 60, 0);
  EXPECT_TRUE(same(longer.made(nullptr), longer.kriged));
  EXPECT_TRUE(same(longer.made(std::make_shared<const ResidualModel>()), longer.kriged));
  EXPECT_FALSE(same(longer.made(model), longer.kriged));
  const Bowed shorter(5.5, 28, 0);
  EXPECT_TRUE(same(shorter.made(model), shorter.kriged));
}

TEST(Residuals, RotateWithTheBorders) {
  const ResidualModel model = learn_residuals(spans_of(0.4f, 40));
  const Bowed bowed(3.1, 70, 0);
  ArmScratch arms;
  ArmSight sight = *see_arm(bowed.gap, Side::left, arms);
  const ResidualModel::Bends before = residual_of(model, sight);
  EXPECT_GT(before[0].norm(), 0.01f);
  const Quaternionf turn = Quaternionf(0.3f, -0.5f, 0.7f, 0.2f).normalized();
  for (Vector3f& trait : sight.traits) trait = turn * trait;
  const ResidualModel::Bends after = residual_of(model, sight);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT((after[i] - turn * before[i]).norm(), 1e-5f);
}

TEST(Residuals, StayWithinReachFarOutsideTheTrainingData) {
  const ResidualModel model = learn_residuals(spans_of(0.4f, 40));
  const Bowed bowed(3.1, 70, 0);
  ArmScratch arms;
  ArmSight sight = *see_arm(bowed.gap, Side::left, arms);
  for (Vector3f& trait : sight.traits) trait *= 1e6f;
  for (const Vector3f& bend : residual_of(model, sight)) EXPECT_LE(bend.norm(), 1.001f);
}

TEST(Residuals, RoundTripThroughStorage) {
  const ResidualModel model = learn_residuals(spans_of(0.4f, 40));
  ByteWriter out;
  encode(model, out);
  ByteReader in(out.bytes(), "a record");
  const ResidualModel read = decode_residual_model(in);
  in.finish();
  EXPECT_TRUE(nearly_same(read, model));
  ASSERT_EQ(read.centres.size(), model.centres.size());
  EXPECT_EQ(read.centres.back().weights, model.centres.back().weights);
  EXPECT_EQ(read.trait_scale, model.trait_scale);
  for (std::size_t size = 0; size < out.size(); ++size) {
    ByteReader cut_off(ByteSpan(out.bytes()).first(size), "a record");
    EXPECT_THROW(decode_residual_model(cut_off), Error) << size;
  }
}

TEST(Residuals, MovementsAreInsideTheMotionAndDoNotOverlap) {
  const Motion motion = lively(1.3, {100, 1}, 1500);
  const JointGroups of = groups();
  ArmScratch scratch;
  const std::vector<FrameRange> all = captured_movements(motion, of, 1000, scratch);
  EXPECT_GT(all.size(), 20u);
  for (const FrameRange& frames : all) {
    EXPECT_GE(frames.begin, 1);
    EXPECT_LT(frames.end, motion.frame_count());
    EXPECT_GE(frames.size(), 10);
  }
  EXPECT_EQ(captured_movements(motion, of, 7, scratch).size(), 7u);
  EXPECT_EQ(residual_spans(motion, of, all, 3).size(), all.size());
  EXPECT_TRUE(captured_movements(lively(1, {100, 1}, 10), of, 10, scratch).empty());
}

}  // namespace
}  // namespace signweave
