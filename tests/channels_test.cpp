// Recordings taken apart into channels and composed again, edits of single hands, and utterances in channels, on the
// demo corpus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/choose/decompose.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/database/test_recording.h"
#include "signweave/features/hand_motion.h"
#include "signweave/live/player.h"
#include "signweave/live/shared_signing_cache.h"
#include "signweave/notation/score_json.h"
#include "signweave/score/lane_chain.h"
#include "signweave/score/provenance.h"
#include "tests/demo_database.h"

namespace signweave::channels {
namespace {

using testing::HasSubstr;
using testing_database::TestFolder;

/// An annotation in which the left hand has signs of its own, begun and ended at other times than those of the right.
AnnotationDocument of_hands(const AnnotationDocument& document, const TierNames& tiers) {
  AnnotationDocument of_hands;
  of_hands.types = {{"gloss", Stereotype::none, {}}};
  Tier right{.id = "GlossR", .type = "gloss"};
  Tier left{.id = "GlossL", .type = "gloss"};
  int number = 0;
  for (const Sign& sign : signs_in(document, tiers).signs) {
    const std::optional<TimeSpan> stroke = sign.stroke_span();
    if (!stroke) continue;
    const auto add = [&](Tier& tier, TimeSpan span, const std::string& gloss) {
      tier.annotations.push_back({.id = fmt::format("h{}", ++number), .label = gloss, .span = span});
    };
    add(right, *stroke, sign.gloss);
    if (number % 5 == 0) continue;  // the right hand alone
    add(left, {stroke->begin + Milliseconds(37), stroke->end + Milliseconds(number % 3 == 0 ? 90 : -15)},
        "L-" + sign.gloss);
  }
  of_hands.tiers = {std::move(right), std::move(left)};
  return of_hands;
}

/// The demo corpus, and a recording `mains` with tiers of both hands.
const Database& corpus() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = [] {
    copy_demo_database(folder / "db", 2);
    Database writer(folder / "db", kv::Access::read_write);
    demo::SyntheticRecording made = demo::make_recording(demo::corpus_scripts(2).front(), {100, 1}, 1);
    Recording recording{.name = "mains"};
    recording.motion = MotionPart{.motion = std::move(made.motion)};
    AnnotationDocument document = of_hands(made.document, guess_tier_names(made.document));
    TierNames tiers = guess_tier_names(document);
    recording.annotation = AnnotationPart{.document = std::move(document), .tiers = std::move(tiers)};
    recording.clock = {.frame_time = made.timeline.rate.frame_time()};
    writer.put(recording);
    return std::make_unique<const Database>(folder / "db", kv::Access::read_only);
  }();
  return *database;
}

Motion recorded(const std::string& name) {
  const Snapshot snapshot = corpus().snapshot();
  const std::unique_ptr<MotionSource> source = snapshot.motion(snapshot.contents().at(name));
  Motion motion(source->skeleton(), source->rate(), source->frame_count());
  source->read({0, source->frame_count()}, motion.poses({0, source->frame_count()}));
  std::vector<std::vector<float>> values(source->tracks().size(),
                                         std::vector<float>(static_cast<std::size_t>(source->frame_count())));
  source->read_tracks({0, source->frame_count()}, std::vector<std::span<float>>(values.begin(), values.end()));
  for (std::size_t i = 0; i < values.size(); ++i) motion.add_track({source->tracks()[i], values[i]});
  return motion;
}

TEST(ChannelsTest, ARecordingTakenApartAndComposedAgainIsTheRecording) {
  for (const RecordingInfo& info : corpus().snapshot().shared_contents()->recordings) {
    const Synthesized made = recompose(corpus(), info.name);
    EXPECT_TRUE(same_bits(made.result.motion, recorded(info.name))) << info.name;
    EXPECT_GT(made.result.score.clips.size(), 20u) << info.name;
    EXPECT_EQ(lanes_that_differ(made.result.score).size(), info.name == "mains" ? 1u : 0u);
    EXPECT_EQ(score_from_json(json_of(made.result.score), "score.json"), made.result.score);
  }
}

TEST(ChannelsTest, ARecordingTakenApartAtAnyRateIsTheRecording) {
  const TestFolder folder;
  Database::create(folder / "db", {});
  Database database(folder / "db", kv::Access::read_write);
  // A recording of 100 frames a second as if it were of 2,400: ties between the hands are no whole milliseconds.
  const demo::SyntheticRecording made = demo::make_recording(demo::corpus_scripts(2).front(), {100, 1}, 1);
  const std::int64_t frames = made.motion.frame_count();
  Motion motion(made.motion.shared_skeleton(), {2400, 1}, frames);
  BorrowedSource(made.motion).read({0, frames}, motion.poses({0, frames}));
  AnnotationDocument document = of_hands(made.document, guess_tier_names(made.document));
  for (Tier& tier : document.tiers) {
    for (Annotation& one : tier.annotations) one.span = {one.span.begin / 24, one.span.end / 24};
  }
  TierNames tiers = guess_tier_names(document);
  Recording recording{.name = "fast"};
  recording.motion = MotionPart{.motion = motion};
  recording.annotation = AnnotationPart{.document = std::move(document), .tiers = std::move(tiers)};
  recording.clock = {.frame_time = Seconds(1.0 / 2400)};
  database.put(recording);
  const Synthesized again = recompose(database, "fast");
  EXPECT_TRUE(same_bits(again.result.motion, motion));
  EXPECT_EQ(lanes_that_differ(again.result.score).size(), 1u);
}

TEST(ChannelsTest, AHandSaysAnotherSign) {
  const Decomposed before = decompose(*corpus().snapshot().shared_contents(), "mains");
  ASSERT_EQ(before.parts.size(), 1u);
  const std::string gloss = before.parts[0].signs[3].front().gloss();
  Edit edit;
  edit.hands.push_back(parse_hand_replacement("left:" + gloss + "#1=MATIN#1"));
  const Synthesized made = synthesize(corpus(), "mains", edit);
  const Score& score = made.result.score;
  const std::vector<const Lane*> lanes = lanes_that_differ(score);
  ASSERT_EQ(lanes.size(), 1u);
  EXPECT_EQ(lanes[0]->channel, Channel::left);
  const auto is_new = [](const PlacedSign& sign) {
    return sign.channel == Channel::left && sign.sign.gloss == "MATIN";
  };
  EXPECT_EQ(std::ranges::count_if(made.result.signs, is_new), 1);
  const auto is_old = [&](const PlacedSign& sign) { return sign.sign.gloss == gloss; };
  EXPECT_EQ(std::ranges::count_if(made.result.signs, is_old),
            std::ranges::count_if(recompose(corpus(), "mains").result.signs, is_old) - 1);
}

TEST(ChannelsTest, AHandWithoutATierTakesItsShareOfASign) {
  Edit edit;
  edit.hands.push_back(parse_hand_replacement("right:BRETAGNE=VANNES"));
  const Synthesized made = synthesize(corpus(), "meteo", edit);
  const std::vector<const Lane*> lanes = lanes_that_differ(made.result.score);
  ASSERT_EQ(lanes.size(), 1u);
  EXPECT_EQ(lanes[0]->channel, Channel::right);
}

TEST(ChannelsTest, ErrorsOfEditsOfAHandAreOneLine) {
  const auto fault = [](const std::string& text) {
    try {
      Edit edit;
      edit.hands.push_back(parse_hand_replacement(text));
      synthesize(corpus(), "mains", edit);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no fault");
  };
  EXPECT_THAT(fault("A=B"), HasSubstr("expected left:GLOSS=GLOSS or right:GLOSS=GLOSS"));
  EXPECT_THAT(fault("left:NOTHING=MATIN"), HasSubstr("no sign 'NOTHING' of the left hand in recording 'mains'"));
}

PlacePart weak(const std::string& gloss) {
  PartSign sign;
  sign.sign.gloss.gloss = gloss;
  return {.part = BodyPart::weak, .signs = {sign}, .places = 1};
}

TEST(ChannelsTest, APlaceWhoseWeakHandSignsTheSameIsThatPlace) {
  Utterance plain{.places = {place_of({"DEMAIN"}), place_of({"MATIN"}), place_of({"PLUIE"})}};
  Utterance same = plain;
  same.places[1].parts = {weak("MATIN")};
  const Synthesized a = synthesize(corpus(), plain);
  const Synthesized b = synthesize(corpus(), same);
  EXPECT_TRUE(same_bits(a.result.motion, b.result.motion));
}

TEST(ChannelsTest, TheWeakHandSignsAnotherGlossAndHolds) {
  Utterance utterance{
      .places = {place_of({"DEMAIN"}), place_of({"MATIN"}), place_of({"PLUIE"}), place_of({"SOLEIL-BRILLER"})}};
  utterance.places[0].parts = {weak("BROUILLARD")};
  utterance.holds = {{.hand = BodyPart::weak, .from = 0, .until = 2}};
  const Synthesized made = synthesize(corpus(), utterance);
  const Lane& left = *lane_of(made.result.score, Channel::left);
  const LaneChain chain = chain_of(left);
  ASSERT_EQ(chain.size(), 2u);
  EXPECT_EQ(chain[0].clip, 4u);
  EXPECT_GT(chain[0].held, 0);
  EXPECT_EQ(chain[1].clip, 3u);
}

TEST(ChannelsTest, AHandRestsWhileTheOtherSignsAndNothingWaits) {
  const Utterance plain{
      .places = {place_of({"BROUILLARD"}), place_of({"MATIN"}), place_of({"PLUIE"}), place_of({"NUAGES"})}};
  Utterance utterance = plain;
  utterance.places[1].parts = {
      {.part = BodyPart::weak, .signs = {{.sign = {}, .sync = {}, .rest = true}}, .places = 2}};
  const Synthesized made = synthesize(corpus(), utterance);
  const Score& score = made.result.score;
  const LaneChain chain = chain_of(*lane_of(score, Channel::left));
  ASSERT_EQ(chain.size(), 3u);
  const Clip& rest = score.clips[chain[1].clip];
  EXPECT_TRUE(rest.at_rest);
  EXPECT_GE(rest.at.begin, score.clips[0].at.end);
  EXPECT_GT(chain[1].held, 0);
  const Score before = synthesize(corpus(), plain).result.score;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(score.clips[i].at, before.clips[i].at) << i;
  // Low, from when it arrives until it is needed.
  const Snapshot snapshot = corpus().snapshot();
  const SignerModel& signer = *snapshot.signer(snapshot.contents().at("meteo"));
  const float hips = signer.body->heights[static_cast<std::size_t>(Height::waist)];
  const auto low = [&](std::int64_t frame) {
    const HandMotion hands = measure_hands(made.result.motion, signer, {frame, frame + 1});
    return hands.hands[static_cast<std::size_t>(Side::left)].frames[0].position.y() < 0.8f * hips;
  };
  EXPECT_FALSE(low(score.clips[0].at.end - 1));
  EXPECT_TRUE(low(rest.at.begin));
  EXPECT_TRUE(low(rest.at.end + chain[1].held - 1));
  EXPECT_FALSE(low(score.clips[3].at.begin));
  EXPECT_EQ(score_from_json(json_of(score), "score.json"), score);
  EXPECT_TRUE(same_bits(synthesize(corpus(), score).result.motion, made.result.motion));
  const AnnotationDocument document = annotation_of(made.result);
  const auto tier = std::ranges::find(document.tiers, "Rest left", &Tier::id);
  ASSERT_NE(tier, document.tiers.end());
  ASSERT_EQ(tier->annotations.size(), 1u);
  EXPECT_EQ(tier->annotations[0].span.end, Milliseconds(10 * (rest.at.end + chain[1].held)));
  EXPECT_EQ(std::ranges::find(document.tiers, "Hold left", &Tier::id), document.tiers.end());
}

const Motion& motion_of(const Synthesized& made) {
  return made.result.motion;
}

float most(const Motion& motion, std::string_view track, FrameRange frames) {
  const auto at = std::ranges::find(motion.tracks(), track, &ScalarTrack::name);
  if (at == motion.tracks().end()) return -1;
  return *std::max_element(at->values.begin() + frames.begin, at->values.begin() + frames.end);
}

/// An utterance with everything: two hands, a hold, a handshape, an expression, a mouthing and a gaze.
Utterance everything() {
  Utterance utterance{.places = {place_of({"DEMAIN"}), place_of({"MATIN"}), place_of({"PLUIE"}), place_of({"VANNES"})}};
  utterance.places[0].parts = {weak("BROUILLARD")};
  PlacePart fingers = weak("RENNES");
  fingers.part = BodyPart::right_fingers;
  utterance.places[2].parts = {fingers};
  utterance.holds = {{.hand = BodyPart::weak, .from = 0, .until = 1}};
  utterance.non_manuals = {{.kind = NonManual::Kind::expression, .what = "q-polar", .first = 1, .last = 2},
                           {.kind = NonManual::Kind::mouthing, .what = "pluie", .first = 2, .last = 2},
                           {.kind = NonManual::Kind::gaze, .what = "left", .first = 3, .last = 3}};
  return utterance;
}

TEST(ChannelsTest, FaceGazeAndHeadMoveOverTheirPlaces) {
  Utterance plain = everything();
  plain.non_manuals.clear();
  const Synthesized before = synthesize(corpus(), plain);
  const Synthesized made = synthesize(corpus(), everything());
  ASSERT_EQ(made.result.score.curves.size(), 3u);
  const Score& score = made.result.score;
  EXPECT_EQ(score.curves[0].at.begin, score.clips[1].at.begin - 8);  // 80 ms before, 22 ms after
  EXPECT_EQ(score.curves[0].at.end, score.clips[2].at.end + 2);
  EXPECT_GT(most(motion_of(made), "browInnerUp", score.curves[0].at), 0.79f);
  EXPECT_GT(most(motion_of(made), "eyeLookInRight", score.curves[2].at), 0.3f);
  const Snapshot snapshot = corpus().snapshot();
  const auto head = static_cast<std::size_t>(snapshot.signer(snapshot.contents().at("meteo"))->rig[Part::head].joint);
  for (std::int64_t frame = 0; frame < score.frames; ++frame) {
    const bool turned = std::ranges::any_of(
        score.curves, [&](const AuthoredCurve& one) { return one.at.begin <= frame && frame < one.at.end; });
    const float same =
        std::abs(motion_of(before).pose(frame).rotations[head].dot(motion_of(made).pose(frame).rotations[head]));
    if (!turned)
      EXPECT_EQ(motion_of(before).pose(frame).rotations[head].coeffs(),
                motion_of(made).pose(frame).rotations[head].coeffs());
    if (frame == score.clips[1].at.end) EXPECT_LT(same, 0.9999f);
  }
}

TEST(ChannelsTest, AScoreOfEverythingRendersTheSameFramesInAnyRange) {
  const Synthesized made = synthesize(corpus(), everything());
  const Score score = score_from_json(json_of(made.result.score), "score.json");
  EXPECT_EQ(score, made.result.score);
  EXPECT_EQ(version_of(score), 2);
  EXPECT_TRUE(same_bits(motion_of(synthesize(corpus(), score)), motion_of(made)));
  OpenScore open(corpus(), score);
  Motion some;
  for (const FrameRange frames : {FrameRange{0, 1}, FrameRange{score.frames / 3, score.frames / 2},
                                  FrameRange{score.frames - 40, score.frames}}) {
    open.render(frames, some);
    for (std::int64_t frame = frames.begin; frame < frames.end; ++frame) {
      for (std::size_t joint = 0; joint < some.skeleton().joint_count(); ++joint) {
        ASSERT_EQ(some.pose(frame - frames.begin).rotations[joint].coeffs(),
                  motion_of(made).pose(frame).rotations[joint].coeffs());
      }
    }
    for (std::size_t track = 0; track < some.tracks().size(); ++track) {
      ASSERT_EQ(some.tracks()[track].values[0],
                motion_of(made).tracks()[track].values[static_cast<std::size_t>(frames.begin)]);
    }
  }
}

TEST(ChannelsTest, TheAnnotationNamesTheSourcesOfEachChannel) {
  const Synthesized made = synthesize(corpus(), everything());
  const AnnotationDocument document = annotation_of(made.result);
  std::vector<std::string> tiers;
  for (const Tier& tier : document.tiers) tiers.push_back(tier.id);
  EXPECT_THAT(tiers, testing::IsSupersetOf({"Gloss", "Source", "Gloss left", "Phase left", "Source left", "Hold left",
                                            "Junction left", "Gloss right fingers", "Source right fingers",
                                            "Expression", "Mouth", "Gaze"}));
}

/// The mean distance, in shoulder widths, of a hand's palm from its place in the recording, over the core of a clip.
double distance_from_recorded(const Synthesized& made, ClipId id, Side side) {
  const Snapshot snapshot = corpus().snapshot();
  const Clip& clip = made.result.score.clips[id];
  const SignerModel& signer = *snapshot.signer(snapshot.contents().at(clip.source.recording));
  const Motion source = recorded(clip.source.recording);
  const auto slot = static_cast<std::size_t>(side);
  const auto before = measure_hands(source, signer, clip.core).hands[slot].frames;
  const auto after = measure_hands(motion_of(made), signer, clip.at).hands[slot].frames;
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i) sum += (before[i].position - after[i].position).norm();
  return sum / static_cast<double>(before.size());
}

TEST(ChannelsTest, AHandOnAnotherTrunkKeepsItsPlace) {
  Utterance utterance{.places = {place_of({"BONJOUR"}), place_of({"SOLEIL-BRILLER"}), place_of({"PLUIE"})}};
  PlacePart left = weak("BROUILLARD");
  left.part = BodyPart::left;
  utterance.places[1].parts = {left};
  const Synthesized made = synthesize(corpus(), utterance);
  Score score = made.result.score;
  std::size_t placed = 0;
  for (Item& item : score.lanes[static_cast<std::size_t>(Channel::left)].items) {
    auto* const use = std::get_if<ClipUse>(&item.what);
    if (use == nullptr || !use->place) continue;
    EXPECT_EQ(use->clip, 3u);
    EXPECT_GT(use->place->moved_mm, 1);
    use->place.reset();
    ++placed;
  }
  ASSERT_EQ(placed, 1u);
  ASSERT_FALSE(score.clips[3].mirrored);
  const double copied = distance_from_recorded(synthesize(corpus(), score), 3, Side::left);
  const double corrected = distance_from_recorded(made, 3, Side::left);
  EXPECT_LT(corrected, 0.5 * copied);
}

TEST(ChannelsTest, LidsShutAtPausesIfAskedFor) {
  Utterance utterance{.places = {place_of({"DEMAIN"}), place_of({"MATIN"}), place_of({"PLUIE"})}};
  utterance.places[1].pause_before = kFullStop;
  SynthesisOptions options;
  options.non_manuals.blinks = true;
  const Synthesized made = synthesize(corpus(), utterance, options);
  const Score& score = made.result.score;
  ASSERT_FALSE(score.curves.empty());
  const FrameRange pause{score.clips[0].at.end, score.clips[1].at.begin};
  EXPECT_GT(most(motion_of(made), "eyeBlinkLeft", pause), 0.99f);
  EXPECT_TRUE(synthesize(corpus(), utterance).result.score.curves.empty());
}

TEST(ChannelsTest, TheSignerLooksAtTheAddresseeAtBoundariesIfPlanned) {
  Utterance utterance{.places = {place_of({"DEMAIN"}), place_of({"MATIN"}), place_of({"PLUIE"})}};
  utterance.places[2].pause_before = kFullStop;
  utterance.non_manuals = {{.kind = NonManual::Kind::gaze, .what = "left", .first = 1, .last = 1}};
  const Score asked = synthesize(corpus(), utterance).result.score;
  ASSERT_EQ(asked.curves.size(), 1u);
  SynthesisOptions options;
  options.non_manuals.gaze = true;
  const Score score = synthesize(corpus(), utterance, options).result.score;
  EXPECT_EQ(score.curves.back(), asked.curves[0]) << "shown over the plan";
  const auto in_pause = std::ranges::find_if(score.curves, [&](const AuthoredCurve& one) {
    return one.curve.name == "addressee" && one.at.begin == score.clips[1].at.end;
  });
  ASSERT_NE(in_pause, score.curves.end());
  EXPECT_LE(in_pause->at.end, score.clips[2].at.begin);
  EXPECT_EQ(in_pause->first, 2u);
}

std::vector<std::string> codes_of(const Utterance& utterance) {
  std::vector<std::string> codes;
  for (const Notice& notice : synthesize(corpus(), utterance).result.notices) {
    if (!notice.code.empty()) codes.push_back(notice.code);
  }
  return codes;
}

TEST(ChannelsTest, WhatSignersRarelyDoIsReportedOrRefused) {
  Utterance utterance{.places = {place_of({"DEMAIN"}), place_of({"BROUILLARD"}), place_of({"VANNES"})}};
  EXPECT_THAT(codes_of(utterance), testing::IsEmpty());
  // Both hands alternate in BROUILLARD, of which the weak one is held.
  utterance.holds = {{.hand = BodyPart::weak, .from = 0, .until = 1}};
  EXPECT_THAT(codes_of(utterance), testing::ElementsAre("weak_drop"));
  utterance.places[1] = place_of({"MATIN"});
  utterance.places[1].pause_before = kFullStop;
  EXPECT_THAT(codes_of(utterance), testing::Contains("long_hold"));
  utterance.places[1].pause_before = Milliseconds(6000);
  EXPECT_THAT(codes_of(utterance), testing::Contains("long_hold"));
  // The weak hand signs RENNES, mirrored, while the other signs VANNES: two movements with different handshapes.
  utterance = {.places = {place_of({"DEMAIN"}), place_of({"VANNES"})}};
  utterance.places[1].parts = {weak("RENNES")};
  EXPECT_THAT(codes_of(utterance), testing::Contains("symmetry"));
  try {
    synthesize(corpus(), utterance, {.strict = true});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("'RENNES' and 'VANNES' move at the same time with different handshapes"));
  }
}

}  // namespace
}  // namespace signweave::channels
