// Recordings of two rigs in one database and one utterance: those of the other rig are retargeted to the first one's
// skeleton.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/choose/on_skeleton.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "signweave/features/hand_points.h"
#include "signweave/notation/score_json.h"
#include "signweave/retarget/retargeted_source.h"
#include "signweave/retarget/test_other_rig.h"
#include "tests/player_showing.h"
#include "tests/retarget_figures.h"

namespace signweave {
namespace {

using testing::HasSubstr;

void put(Database& writer, demo::SyntheticRecording made, const RigNames& rig = {}) {
  Recording recording{.name = made.name};
  recording.motion = MotionPart{.motion = std::move(made.motion)};
  TierNames tiers = guess_tier_names(made.document);
  recording.annotation = AnnotationPart{.document = std::move(made.document), .tiers = std::move(tiers)};
  recording.clock = {.frame_time = made.timeline.rate.frame_time()};
  if (!rig.empty()) recording.rig = rig;
  writer.put(recording);
}

demo::SyntheticRecording made_villes() {
  return demo::make_recording(demo::villes(), {100, 1}, 1);
}

/// The paper's two recordings, the cities captured as for `villes`: in a database, new in a folder.
std::unique_ptr<const Database> database_with(const std::filesystem::path& folder, Motion villes,
                                              const RigNames& rig = {}) {
  Database::create(folder, {});
  {
    Database writer(folder, kv::Access::read_write);
    put(writer, demo::make_recording(demo::meteo(), {100, 1}, 1));
    demo::SyntheticRecording other = made_villes();
    other.motion = std::move(villes);
    put(writer, std::move(other), rig);
  }
  return std::make_unique<const Database>(folder, kv::Access::read_only);
}

/// A different signer with a different rig, standing two metres to the side.
Motion other_villes() {
  return placed(on_other_rig(made_villes().motion), 0.8f, {2, 0, -1});
}

const Database& two_rigs() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = database_with(folder / "db", other_villes());
  return *database;
}

/// VANNES, RENNES and MARSEILLE are signed only in villes, the others in meteo.
const std::string kUtterance = "BONJOUR VANNES PLUIE RENNES MARSEILLE DEMAIN";

BodyMapping mapping_between(const Database& database, const std::string& from, const std::string& to) {
  const Snapshot snapshot = database.snapshot();
  const auto body = [&](const std::string& name) {
    return body_of(snapshot.contents(), name, *snapshot.motion(snapshot.contents().at(name)));
  };
  return map_body(body(from), body(to));
}

SignerModel model_of_recording(const Database& database, const std::string& recording) {
  const Snapshot snapshot = database.snapshot();
  return body_of(snapshot.contents(), recording, *snapshot.motion(snapshot.contents().at(recording))).signer;
}

std::string refusal(const Database& database, const std::string& utterance) {
  try {
    synthesize(database, parse_utterance(utterance));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "none";
}

/// Calls `see(frame, recording's frame)` for the frames taken from one recording.
template <typename See>
std::size_t for_frames_of(const Synthesis& made, const std::string& recording, See&& see) {
  std::size_t count = 0;
  for (std::int64_t frame = 0; frame < made.motion.frame_count(); ++frame) {
    const FrameSource& source = made.sources[static_cast<std::size_t>(frame)];
    if (source.clip == FrameSource::kNone) continue;
    if (made.clips[static_cast<std::size_t>(source.clip)].recording != recording) continue;
    see(frame, static_cast<std::int64_t>(source.frame));
    ++count;
  }
  return count;
}

TEST(TwoSkeletons, FramesOfTheReferenceSkeletonAreKeptBitForBit) {
  for (const char* first : {"meteo", "villes"}) {
    const std::string text = first == std::string("meteo") ? kUtterance : "VANNES BONJOUR RENNES PLUIE";
    const Synthesized made = synthesize(two_rigs(), parse_utterance(text));
    ASSERT_EQ(made.layout_from, first);
    const Motion captured = two_rigs().read(first);
    EXPECT_EQ(made.result.motion.skeleton(), captured.skeleton());
    const std::size_t kept = for_frames_of(made.result, first, [&](std::int64_t frame, std::int64_t there) {
      for (std::size_t joint = 1; joint < captured.skeleton().joint_count(); ++joint) {
        const Eigen::Vector4f a = made.result.motion.pose(frame).rotations[joint].coeffs();
        const Eigen::Vector4f b = captured.pose(there).rotations[joint].coeffs();
        ASSERT_TRUE(a == b || a == -b) << frame << ' ' << joint;
      }
    });
    EXPECT_GT(kept, 100u);
  }
}

TEST(TwoSkeletons, HandsOfTheOtherPointAsTheyDid) {
  for (const char* first : {"meteo", "villes"}) {
    const bool forth = first == std::string("meteo");
    const std::string other = forth ? "villes" : "meteo";
    const Synthesized made = synthesize(two_rigs(), parse_utterance(forth ? kUtterance : "VANNES BONJOUR RENNES PLUIE"),
                                        {.alignment = Alignment::none});
    ASSERT_EQ(made.layout_from, first);
    const Motion captured = two_rigs().read(other);
    const SignerModel there = model_of_recording(two_rigs(), other);
    const SignerModel here = model_of_recording(two_rigs(), first);
    const BodyMapping mapping = mapping_between(two_rigs(), other, first);
    const float ratio = BodyMapper(mapping).retargeter().unit_ratio();
    struct {
      std::vector<float> palm, fingers, shape, place;
    } figures;
    const std::size_t seen = for_frames_of(made.result, other, [&](std::int64_t frame, std::int64_t from) {
      const ModelPose a = to_model_space(captured.skeleton(), captured.pose(from));
      const ModelPose b = to_model_space(made.result.motion.skeleton(), made.result.motion.pose(frame));
      const SignerSpace space_a = signer_space(*there.body, there.rig, a);
      SignerSpace space_b = signer_space(*here.body, here.rig, b);
      space_b.unit = ratio * space_a.unit;
      for (const Side side : kSides) {
        HandPoints hand_a, hand_b;
        HandPlaces(there.rig, side).read(a, hand_a);
        HandPlaces(here.rig, side).read(b, hand_b);
        const HandAxes axes_a = axes_of(hand_a, side);
        const HandAxes axes_b = axes_of(hand_b, side);
        figures.palm.push_back(degrees_between(axes_a.palm, axes_b.palm));
        figures.fingers.push_back(degrees_between(axes_a.fingers, axes_b.fingers));
        const Handshape shape_a = handshape_of(hand_a, axes_a);
        const Handshape shape_b = handshape_of(hand_b, axes_b);
        figures.shape.push_back(distance(shape_a, shape_b));
        const float off = (space_a.to_signer(palm_of(hand_a)) - space_b.to_signer(palm_of(hand_b))).norm();
        const auto at = [&](Part part) { return position_of(there.rig[part], a); };
        const Part shoulder = of(side, Part::left_upper_arm);
        const Part elbow = of(side, Part::left_forearm);
        const float arm = (at(elbow) - at(shoulder)).norm() + (hand_a.wrist - at(elbow)).norm();
        if ((hand_a.wrist - at(shoulder)).norm() < kBent * arm) figures.place.push_back(off);
      }
    });
    EXPECT_GT(seen, 100u);
    EXPECT_LT(quantile(figures.palm, 1), 0.1f);
    EXPECT_LT(quantile(figures.fingers, 1), 0.1f);
    // The retargeting positions the centre of the hand; in a hand of another size the palm's centre is elsewhere.
    EXPECT_LT(quantile(figures.place, 0.5), 0.035f);
    EXPECT_LT(quantile(figures.place, 0.95), 0.07f);
    EXPECT_LT(quantile(figures.shape, 0.95), 0.01f);
  }
}

TEST(TwoSkeletons, TheSignerStaysInPlace) {
  const Synthesized made = synthesize(two_rigs(), parse_utterance(kUtterance));
  const SignerModel signer = model_of_recording(two_rigs(), "meteo");
  const Motion& motion = made.result.motion;
  float lowest = 1e9f;
  float highest = -1e9f;
  const SignerSpace first = signer_space(*signer.body, signer.rig, to_model_space(motion.skeleton(), motion.pose(0)));
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
    const SignerSpace space = signer_space(*signer.body, signer.rig, pose);
    ASSERT_LT((space.origin - first.origin).norm(), 0.08f) << frame;
    ASSERT_LT(degrees_between(space.model_from_signer * Eigen::Vector3f::UnitZ(),
                              first.model_from_signer * Eigen::Vector3f::UnitZ()),
              20)
        << frame;
    const float ankle = std::min(position_of(signer.rig[Part::left_foot], pose).y(),
                                 position_of(signer.rig[Part::right_foot], pose).y());
    lowest = std::min(lowest, ankle);
    highest = std::max(highest, ankle);
  }
  EXPECT_LT(highest - lowest, 0.015f);  // both stand on the same floor
}

TEST(TwoSkeletons, NothingJumpsBetweenThem) {
  const Synthesized made = synthesize(two_rigs(), parse_utterance(kUtterance));
  const Motion& motion = made.result.motion;
  // The fastest joint of generated frames against that of captured ones, and rotations from frame to frame.
  double captured = 0;
  double between = 0;
  for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
    const ModelPose a = to_model_space(motion.skeleton(), motion.pose(frame - 1));
    const ModelPose b = to_model_space(motion.skeleton(), motion.pose(frame));
    const auto is_made = [&](std::int64_t f) {
      return made.result.sources[static_cast<std::size_t>(f)].junction != FrameSource::kNone;
    };
    double& fastest = is_made(frame) || is_made(frame - 1) ? between : captured;
    for (std::size_t joint = 0; joint < a.positions.size(); ++joint) {
      fastest = std::max(fastest, static_cast<double>((b.positions[joint] - a.positions[joint]).norm()) * 100);
    }
  }
  EXPECT_GT(between, 0);
  EXPECT_LT(between, captured);
  const auto [turn, displacement] = greatest_step(motion);
  EXPECT_LT(turn, 0.25f);
  EXPECT_LT(displacement, 0.01f);
}

TEST(TwoSkeletons, ANoticeDescribesHowTheOtherIsShown) {
  const Synthesized made = synthesize(two_rigs(), parse_utterance(kUtterance));
  ASSERT_EQ(made.result.notices.size(), 1u);
  EXPECT_EQ(made.result.notices[0].where, "villes");
  EXPECT_THAT(
      made.result.notices[0].text,
      HasSubstr("retargeted to the skeleton of 'meteo', which has other joints: 56 of 56 driven; hands within 0.0"));
  EXPECT_TRUE(synthesize(two_rigs(), parse_utterance("BONJOUR PLUIE DEMAIN")).result.notices.empty());
}

TEST(TwoSkeletons, EditsTakeSignsOfTheOther) {
  Edit edit;
  edit.replacements = {parse_replacement("BRETAGNE=VANNES"), parse_replacement("DEMAIN=RENNES")};
  const Synthesized made = synthesize(two_rigs(), "meteo", edit);
  EXPECT_EQ(made.layout_from, "meteo");
  EXPECT_EQ(made.result.notices.size(), 1u);
  std::size_t others = 0;
  for (const ShownClip& placed : made.result.clips) others += placed.recording == "villes" ? 1 : 0;
  EXPECT_EQ(others, 2u);
  const auto [turn, displacement] = greatest_step(made.result.motion);
  EXPECT_LT(turn, 0.25f);
  EXPECT_LT(displacement, 0.01f);
}

TEST(TwoSkeletons, AScoreOfBothIsRenderedCompletelyAndInParts) {
  const Synthesized made = synthesize(two_rigs(), parse_utterance(kUtterance));
  const Score score = score_from_json(json_of(made.result.score), "score");
  const Synthesized again = synthesize(two_rigs(), score);
  EXPECT_TRUE(same_bits(again.result.motion, made.result.motion));
  EXPECT_EQ(again.result.notices.size(), 1u);
  OpenScore open(two_rigs(), score);
  Motion part;
  for (const std::int64_t begin : {std::int64_t{150}, std::int64_t{0}, score.frames - 60}) {
    open.render({begin, begin + 60}, part);
    for (std::int64_t frame = 0; frame < 60; ++frame) {
      const PoseView is = std::as_const(part).pose(frame);
      const PoseView whole = std::as_const(made.result.motion).pose(begin + frame);
      for (std::size_t joint = 0; joint < is.rotations.size(); ++joint) {
        EXPECT_EQ(is.rotations[joint].coeffs(), whole.rotations[joint].coeffs()) << begin + frame;
      }
    }
  }
}

/// What a player shows from a database.
Shown shown_of(const Database& database, const std::string& utterance, SynthesisOptions synthesis = {}) {
  SharedSigningCache shared(database);
  Player player(shared, {.synthesis = std::move(synthesis), .idle = Idle::end});
  player.sign(parse_utterance(utterance));
  Shown shown;
  show(player, shown);
  return shown;
}

TEST(TwoSkeletons, APlayerShowsWhatIsSynthesized) {
  for (const FrameRate rate : {FrameRate{100, 1}, FrameRate{30, 1}}) {
    for (const std::string& text : {kUtterance, std::string("VANNES PLUIE . RENNES MATIN MARSEILLE")}) {
      const SynthesisOptions options{.rate = rate};
      const Shown shown = shown_of(two_rigs(), text, options);
      std::vector<std::string> pauses(6);
      if (text != kUtterance) pauses[2] = ". ";
      expect_same(shown, synthesize(two_rigs(), parse_utterance(shown.tokens(pauses)), options), text);
      ASSERT_EQ(shown.count(Kind::notice), 1u);
      const auto notice = std::ranges::find(shown.events, Kind::notice, &PlayerEvent::kind);
      EXPECT_THAT(notice->text, HasSubstr("retargeted to the skeleton of"));
    }
  }
}

TEST(TwoSkeletons, APlayerRestsAndContinuesAcrossThem) {
  SharedSigningCache shared(two_rigs());
  Player player(shared, {.recording = "meteo"});
  Shown shown;
  show(player, shown, 100);
  for (const char* text : {"VANNES", "PLUIE", "RENNES MARSEILLE", "DEMAIN"}) {
    player.sign(parse_utterance(text));
    show(player, shown, 250, 7);
  }
  show(player, shown, 1500);
  EXPECT_EQ(player.header()->layout_from, "meteo");
  EXPECT_GE(shown.count(Kind::place), 4u);
  EXPECT_TRUE(player.idle());
  const auto [turn, displacement] = greatest_step(shown.motion);
  EXPECT_LT(turn, 0.25f);
  EXPECT_LT(displacement, 0.01f);
}

TEST(TwoSkeletons, AMotionBelowAStillRootIsWrittenInThatSignersLayout) {
  const TestFolder folder;
  const auto database = database_with(folder / "db", below_a_still_root(other_villes()));
  const Synthesized made = synthesize(*database, parse_utterance("VANNES BONJOUR RENNES PLUIE"));
  ASSERT_EQ(made.layout_from, "villes");
  const Motion& motion = made.result.motion;
  const SignerModel signer = model_of_recording(*database, "villes");
  const SignerSpace first = signer_space(*signer.body, signer.rig, to_model_space(motion.skeleton(), motion.pose(0)));
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    ASSERT_LT(motion.pose(frame).rotations[0].angularDistance(Eigen::Quaternionf::Identity()), 1e-3f);
    ASSERT_LT(motion.pose(frame).translations[0].norm(), 1e-3f);
    const SignerSpace space =
        signer_space(*signer.body, signer.rig, to_model_space(motion.skeleton(), motion.pose(frame)));
    ASSERT_LT((space.origin - first.origin).norm(), 0.08f) << frame;
  }
  const auto [turn, displacement] = greatest_step(motion);
  EXPECT_LT(turn, 0.25f);
}

TEST(TwoSkeletons, AMissingHandIsRefusedByName) {
  const TestFolder folder;
  const auto database =
      database_with(folder / "db", without_joints(on_other_rig(made_villes().motion), {"mixamorig:RightHand"}));
  const std::string text = refusal(*database, kUtterance);
  EXPECT_THAT(text, HasSubstr("recording 'villes' cannot be retargeted to the skeleton of 'meteo': 'villes' has no "));
  EXPECT_THAT(text, HasSubstr("right_hand; import them with a mapping file that names such joints"));
  EXPECT_THAT(refusal(*database, "VANNES PLUIE"),
              HasSubstr("recording 'meteo' cannot be retargeted to the skeleton of 'villes'"));
  // A player skips the places.
  SharedSigningCache shared(*database);
  Player player(shared, {.idle = Idle::end});
  player.sign(parse_utterance("BONJOUR VANNES PLUIE"));
  Shown shown;
  std::size_t refused = 0;
  for (int i = 0; i < 3; ++i) {
    try {
      show(player, shown);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("right_hand"));
      ++refused;
    }
  }
  EXPECT_EQ(refused, 1u);
  EXPECT_EQ(shown.tokens(), "BONJOUR#1 PLUIE#1 ");
}

}  // namespace
}  // namespace signweave
