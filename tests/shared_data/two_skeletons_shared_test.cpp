// An utterance across real recordings of two rigs: SignON's and a Korean signer's.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "signweave/annotation/tier_name.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/features/hand_points.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/kv/test_folder.h"
#include "signweave/retarget/body_mapping.h"
#include "tests/retarget_figures.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

void put(Database& writer, const std::string& name) {
  const fs::path path = fs::path(SIGNWEAVE_SHARED_DATA) / "bvh" / name;
  bvh::ReadOptions options;
  // Options according to what `info` reports of these files: the root's columns are permuted, and in metres.
  if (name.starts_with("signon")) options = {.root_unit = 1.0, .root_columns = bvh::RootColumns::rotation_first};
  bvh::File motion = bvh::read(path.string() + ".bvh", options);
  eaf::File document = eaf::read(path.string() + ".eaf");
  Recording recording{.name = path.filename().string()};
  recording.clock = {.frame_time = motion.motion.rate().frame_time()};
  recording.motion = MotionPart{.motion = std::move(motion.motion)};
  TierNames tiers = guess_tier_names(document.document);
  recording.annotation = AnnotationPart{.document = std::move(document.document), .tiers = std::move(tiers)};
  writer.put(recording);
}

const Database& corpus() {
  static const kv::TestFolder folder;
  static const std::unique_ptr<const Database> database = [] {
    Database::create(folder / "db", {});
    {
      Database writer(folder / "db", kv::Access::read_write);
      for (const char* name : {"signon-thanks/ISL Thanks", "signon-thanks/VGT Thanks", "ksl-always/always"}) {
        put(writer, name);
      }
    }
    return std::make_unique<const Database>(folder / "db", kv::Access::read_only);
  }();
  return *database;
}

TEST(RecordingsOfSharedData, TakenApartAndComposedAgainAreTheSame) {
  const Snapshot snapshot = corpus().snapshot();
  for (const RecordingInfo& info : snapshot.contents().recordings) {
    const std::unique_ptr<MotionSource> source = snapshot.motion(info);
    Motion recorded(source->skeleton(), source->rate(), source->frame_count());
    source->read({0, source->frame_count()}, recorded.poses({0, source->frame_count()}));
    EXPECT_TRUE(same_bits(recompose(corpus(), info.name).result.motion, recorded)) << info.name;
  }
}

class AcrossRigs : public testing::TestWithParam<std::pair<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(TwoSkeletonsSharedData, AcrossRigs,
                         testing::Values(std::pair("THANKS#1 ALWAYS ISL-2", "always"),
                                         std::pair("ALWAYS ISL-2 ALWAYS", "ISL Thanks"),
                                         std::pair("ALWAYS VGT-2 ALWAYS", "VGT Thanks")));

TEST_P(AcrossRigs, HandsKeepDirectionBendAndPosition) {
  const auto [text, other] = GetParam();
  const Synthesis made = synthesize(corpus(), parse_utterance(text), {.alignment = Alignment::none}).result;
  ASSERT_EQ(made.notices.size(), 1u);
  EXPECT_EQ(made.notices[0].where, other);
  const Snapshot snapshot = corpus().snapshot();
  const auto body = [&](const std::string& name) {
    return body_of(snapshot.contents(), name, *snapshot.motion(snapshot.contents().at(name)));
  };
  const RecordedBody there = body(other);
  const RecordedBody here = body(made.clips[0].recording);
  const BodyMapping mapping = map_body(there, here);
  const float ratio = BodyMapper(mapping).retargeter().unit_ratio();
  const Motion captured = corpus().read(other);
  std::vector<float> palm, fingers, shape, place;
  for (std::int64_t frame = 0; frame < made.motion.frame_count(); ++frame) {
    const FrameSource& source = made.sources[static_cast<std::size_t>(frame)];
    if (source.clip == FrameSource::kNone || source.frame != std::floor(source.frame)) continue;
    if (made.clips[static_cast<std::size_t>(source.clip)].recording != other) continue;
    const ModelPose a = to_model_space(captured.skeleton(), captured.pose(static_cast<std::int64_t>(source.frame)));
    const ModelPose b = to_model_space(made.motion.skeleton(), made.motion.pose(frame));
    const SignerSpace space_a = signer_space(*there.signer.body, there.signer.rig, a);
    SignerSpace space_b = signer_space(*here.signer.body, here.signer.rig, b);
    space_b.unit = ratio * space_a.unit;
    for (const Side side : kSides) {
      HandPoints hand_a;
      HandPoints hand_b;
      HandPlaces(there.signer.rig, side).read(a, hand_a);
      HandPlaces(here.signer.rig, side).read(b, hand_b);
      palm.push_back(degrees_between(axes_of(hand_a, side).palm, axes_of(hand_b, side).palm));
      fingers.push_back(degrees_between(axes_of(hand_a, side).fingers, axes_of(hand_b, side).fingers));
      shape.push_back(
          distance(handshape_of(hand_a, axes_of(hand_a, side)), handshape_of(hand_b, axes_of(hand_b, side))));
      const Eigen::Vector3f shoulder = position_of(there.signer.rig[of(side, Part::left_upper_arm)], a);
      if ((hand_a.wrist - shoulder).norm() > 0.4f) continue;  // straight arms keep their range
      place.push_back((space_a.to_signer(palm_of(hand_a)) - space_b.to_signer(palm_of(hand_b))).norm());
    }
  }
  ASSERT_GT(place.size(), 10u);
  EXPECT_LT(quantile(palm, 1), 0.1f);
  EXPECT_LT(quantile(fingers, 1), 0.1f);
  EXPECT_LT(quantile(shape, 1), 0.06f);
  EXPECT_LT(quantile(place, 0.95), 0.08f);
}

TEST(TwoSkeletonsSharedData, NothingJumps) {
  const Synthesis made = synthesize(corpus(), parse_utterance("THANKS#1 ALWAYS ISL-2 ALWAYS")).result;
  EXPECT_TRUE(keeps_hemisphere(made.motion));
  for (std::int64_t frame = 1; frame < made.motion.frame_count(); ++frame) {
    const PoseView a = made.motion.pose(frame - 1);
    const PoseView b = made.motion.pose(frame);
    for (std::size_t joint = 0; joint < a.rotations.size(); ++joint) {
      ASSERT_LT(a.rotations[joint].angularDistance(b.rotations[joint]), 0.35f) << frame << ' ' << joint;
    }
    ASSERT_LT((a.translations[0] - b.translations[0]).norm(), 0.02f) << frame;
  }
}

}  // namespace
}  // namespace signweave
