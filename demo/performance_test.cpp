// How the synthetic signer moves: the hands' plan, face, gaze, breath.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "demo/body.h"
#include "demo/corpus.h"
#include "demo/face.h"
#include "demo/plan.h"
#include "demo/test_rate.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

Script short_script(std::vector<std::vector<std::string_view>> units) {
  return {.name = "short",
          .units = std::move(units),
          .transition_mean = 735ms,
          .transition_deviation = 224ms,
          .sink = 0.1f};
}

struct Planned {
  explicit Planned(Script what, std::uint64_t seed = 1)
      : script(std::move(what)),
        timeline(timeline_of(script, kRate, seed)),
        random(seed),
        plan(script, timeline, random) {}
  Script script;
  Timeline timeline;
  Random random;
  HandPlan plan;
};

TEST(HandPlan, NeverJumps) {
  const Planned made(meteo());
  for (const Side side : kSides) {
    Vector3f before = made.plan.at(side, 0);
    for (std::int64_t frame = 1; frame < made.timeline.frames; ++frame) {
      const Vector3f now = made.plan.at(side, static_cast<double>(frame));
      ASSERT_LT((now - before).norm(), 0.03f) << frame;
      before = now;
    }
    const Vector3f first = made.plan.at(side, 0);
    EXPECT_EQ(first, to_model(rest_place(Rest::hips), side));
    EXPECT_LT((made.plan.at(side, static_cast<double>(made.timeline.frames)) - first).norm(), 1e-4f);
  }
}

TEST(HandPlan, RestsBetweenSentences) {
  const Planned made(villes());
  for (std::size_t i = 0; i + 1 < made.timeline.signs.size(); ++i) {
    if (!ends_unit(made.timeline, i)) continue;
    const auto middle = 0.5 * static_cast<double>(made.timeline.signs[i].end + made.timeline.signs[i + 1].begin);
    for (const Side side : kSides) {
      EXPECT_LT((made.plan.at(side, middle) - to_model(rest_place(), side)).norm(), 0.03f) << i;
    }
  }
}

TEST(HandPlan, TheOtherHandHoldsThroughAOneHandedSignAndDropsBeforeMany) {
  const Planned held(short_script({{"METEO", "NORD", "METEO", "FORT"}}));
  const PlacedSign& nord = held.timeline.signs[1];
  const Vector3f left =
      to_model(stroke_place(sign_for("METEO"), Side::left, 1, held.timeline.signs[0].token), Side::left);
  for (std::int64_t frame = nord.stroke_begin; frame < nord.stroke_end; frame += 5) {
    EXPECT_LT((held.plan.at(Side::left, static_cast<double>(frame)) - left).norm(), 0.06f) << frame;
  }
  EXPECT_EQ(held.plan.shape_at(Side::left, static_cast<double>(nord.stroke_end)), Handshape::spread);

  const Planned one_handed(short_script({{"METEO", "NORD", "SUD", "LYON", "BREST", "QUIMPER", "VANNES", "METEO"}}));
  const auto late = static_cast<double>(one_handed.timeline.signs[4].stroke_begin);
  EXPECT_LT((one_handed.plan.at(Side::left, late) - to_model(rest_place(), Side::left)).norm(), 0.03f);
  // It drops slowly.
  float fastest = 0;
  for (auto frame = one_handed.timeline.signs[0].stroke_end; frame < one_handed.timeline.signs[4].stroke_begin;
       ++frame) {
    const auto at = static_cast<double>(frame);
    fastest =
        std::max(fastest, 100 * (one_handed.plan.at(Side::left, at + 1) - one_handed.plan.at(Side::left, at)).norm());
  }
  EXPECT_LT(fastest, 1.2f);
}

TEST(HandPlan, TheRightHandLeadsByTenToFortyMilliseconds) {
  const Planned made(short_script({{"LE-TEMPS-PREVU", "PARIS", "MONTAGNE", "NUIT", "FORT", "SAINT-MALO"}}));
  int looked_at = 0;
  for (const PlacedSign& sign : made.timeline.signs) {
    const double middle = 0.5 * static_cast<double>(sign.stroke_begin + sign.stroke_end);
    const double left = HandPlan::done_in(made.plan.piece_at(Side::left, middle), middle);
    // When was the right hand equally far?
    double earlier = middle;
    while (HandPlan::done_in(made.plan.piece_at(Side::right, earlier), earlier) > left) earlier -= 0.1;
    const double lead = (middle - earlier) * 0.01;
    EXPECT_GE(lead, 0.005) << sign.shape->gloss;
    EXPECT_LE(lead, 0.045) << sign.shape->gloss;
    ++looked_at;
  }
  EXPECT_EQ(looked_at, 6);
}

TEST(HandPlan, MovementsAreCurvedAndFastestBeforeTheirMiddle) {
  const Planned made(meteo());
  double bent = 0, peak = 0, count = 0;
  for (std::size_t i = 0; i + 1 < made.timeline.signs.size(); ++i) {
    if (ends_unit(made.timeline, i)) continue;
    const auto begin = static_cast<double>(made.timeline.signs[i].stroke_end);
    const auto end = static_cast<double>(made.timeline.signs[i + 1].stroke_begin);
    const Vector3f from = made.plan.at(Side::right, begin);
    const Vector3f line = made.plan.at(Side::right, end) - from;
    if (line.norm() < 0.12f) continue;
    float aside = 0, fastest = 0;
    double fastest_at = 0;
    for (int k = 0; begin + k < end; ++k) {
      const double at = begin + k;
      const Vector3f offset = made.plan.at(Side::right, at) - from;
      aside = std::max(aside, (offset - offset.dot(line) / line.squaredNorm() * line).norm());
      const float speed = (made.plan.at(Side::right, at + 1) - made.plan.at(Side::right, at)).norm();
      if (speed > fastest) {
        fastest = speed;
        fastest_at = (at - begin) / (end - begin);
      }
    }
    bent += static_cast<double>(aside / line.norm());
    peak += fastest_at;
    EXPECT_GT(fastest_at, 0.15) << i;
    EXPECT_LT(fastest_at, 0.85) << i;
    ++count;
  }
  ASSERT_GE(count, 10);
  EXPECT_GT(bent / count, 0.08);
  EXPECT_LT(peak / count, 0.49);
  EXPECT_GT(peak / count, 0.30);
}

TEST(HandPlan, TheHandshapeFormsDuringThePreparation) {
  const Planned made(short_script({{"NORD", "FORT", "VENDREDI", "LYON", "BORDEAUX"}}));
  for (std::size_t i = 1; i < made.timeline.signs.size(); ++i) {
    const PlacedSign& before = made.timeline.signs[i - 1];
    const PlacedSign& sign = made.timeline.signs[i];
    const auto at = [&](std::int64_t frame) { return static_cast<double>(frame); };
    const auto formed = [&](double frame) {
      return HandPlan::shape_done(made.plan.piece_at(Side::right, frame), frame);
    };
    EXPECT_EQ(made.plan.shape_at(Side::right, at(before.stroke_end)),
              before.shape->shape_end.value_or(before.shape->shape));
    EXPECT_LT(formed(at(before.stroke_end)), 0.05);
    EXPECT_LT(formed(at(sign.begin)), 0.4);
    EXPECT_GT(formed(at(sign.begin)), 0.0);  // it has begun to release
    EXPECT_EQ(formed(at(sign.stroke_begin) - 1), 1);
  }
}

class Performance : public testing::Test {
 protected:
  static const SyntheticRecording& made() {
    static const SyntheticRecording recording = make_recording(meteo(), kRate, 1);
    return recording;
  }
  static const std::vector<float>& track(std::string_view name) {
    for (const ScalarTrack& track : made().motion.tracks()) {
      if (track.name == name) return track.values;
    }
    throw std::runtime_error("no such track");
  }
  static float mean(const std::vector<float>& values, std::int64_t begin, std::int64_t end) {
    double sum = 0;
    for (std::int64_t i = begin; i < end; ++i) sum += static_cast<double>(values[static_cast<std::size_t>(i)]);
    return static_cast<float>(sum / static_cast<double>(end - begin));
  }
};

TEST_F(Performance, HasTracksOfEveryFrameFromZeroToOneThatNeverJump) {
  EXPECT_GE(made().motion.tracks().size(), 18U);
  for (const char* name : {"browInnerUp", "browOuterUpLeft", "browDownRight", "eyeBlinkLeft", "eyeWideRight", "jawOpen",
                           "mouthPucker", "mouthFunnel", "mouthSmileLeft", "mouthPressLeft", "cheekPuff"}) {
    float most = 0;
    for (const float value : track(name)) most = std::max(most, value);
    EXPECT_GT(most, 0.25f) << name << " does something";
  }
  for (const ScalarTrack& track : made().motion.tracks()) {
    ASSERT_EQ(track.values.size(), static_cast<std::size_t>(made().motion.frame_count())) << track.name;
    const float most = track.name.starts_with("eye") ? 0.26f : 0.12f;  // a blink takes a fifth of a second
    for (std::size_t i = 0; i < track.values.size(); ++i) {
      ASSERT_GE(track.values[i], 0) << track.name << ' ' << i;
      ASSERT_LE(track.values[i], 1) << track.name << ' ' << i;
      if (i > 0) {
        ASSERT_LT(std::abs(track.values[i] - track.values[i - 1]), most) << track.name << ' ' << i;
      }
    }
  }
}

TEST_F(Performance, ShowsEverySignsBrowsAndMouth) {
  for (const PlacedSign& sign : made().timeline.signs) {
    const auto over = [&](const char* name) { return mean(track(name), sign.stroke_begin, sign.stroke_end); };
    if (sign.shape->face.brows == Brows::raised) {
      EXPECT_GT(over("browOuterUpLeft"), 0.3f) << sign.shape->gloss;
    }
    if (sign.shape->face.brows == Brows::lowered) {
      EXPECT_GT(over("browDownLeft"), 0.3f) << sign.shape->gloss;
    }
    if (sign.shape->face.mouth == Mouth::puff) {
      EXPECT_GT(over("cheekPuff"), 0.4f) << sign.shape->gloss;
    }
    if (sign.shape->face.mouth == Mouth::oo) {
      EXPECT_GT(over("mouthPucker"), 0.4f) << sign.shape->gloss;
    }
    if (sign.shape->face.mouth == Mouth::mm) {
      EXPECT_GT(over("mouthPressLeft"), 0.3f) << sign.shape->gloss;
    }
    if (sign.shape->face.mouth == Mouth::ah) {
      EXPECT_GT(over("jawOpen"), 0.2f) << sign.shape->gloss;
    }
  }
}

TEST_F(Performance, BeginsBeforeTheStrokeAndOutlastsIt) {
  int looked_at = 0;
  const Timeline& timeline = made().timeline;
  for (std::size_t i = 1; i + 1 < timeline.signs.size(); ++i) {
    const PlacedSign& sign = timeline.signs[i];
    if (sign.shape->face.brows != Brows::raised || timeline.signs[i - 1].shape->face.brows == Brows::raised ||
        timeline.signs[i + 1].shape->face.brows == Brows::raised) {
      continue;
    }
    const std::vector<float>& brow = track("browOuterUpLeft");
    EXPECT_GT(brow[static_cast<std::size_t>(sign.stroke_begin - 8)], 0.1f) << sign.shape->gloss;
    EXPECT_GT(brow[static_cast<std::size_t>(sign.stroke_end + 8)], 0.1f) << sign.shape->gloss;
    ++looked_at;
  }
  EXPECT_GE(looked_at, 3);
}

TEST_F(Performance, BlinksOccasionallyMostlyBetweenStrokes) {
  const std::vector<float>& lid = track("eyeBlinkLeft");
  EXPECT_EQ(lid, track("eyeBlinkRight"));
  int blinks = 0, within = 0;
  std::int64_t last = 0;
  for (std::size_t i = 1; i + 1 < lid.size(); ++i) {
    if (lid[i] < 0.9f || lid[i] < lid[i - 1] || lid[i] <= lid[i + 1]) continue;
    const auto frame = static_cast<std::int64_t>(i);
    ++blinks;
    EXPECT_LT(frame - last, 1000) << "eyes open for ten seconds";
    last = frame;
    for (const PlacedSign& sign : made().timeline.signs) {
      if (frame >= sign.stroke_begin && frame < sign.stroke_end) ++within;
    }
  }
  const double minutes = made().motion.duration().count() / 60;
  EXPECT_GE(blinks, 8 * minutes);
  EXPECT_LE(blinks, 30 * minutes);
  EXPECT_LE(within * 4, blinks);
}

TEST_F(Performance, TheJawFollowsItsTrack) {
  const Signer signer = make_signer();
  const std::vector<float>& open = track("jawOpen");
  for (std::size_t i = 0; i < open.size(); i += 5) {
    const Eigen::Quaternionf jaw =
        made().motion.pose(static_cast<std::int64_t>(i)).rotations[static_cast<std::size_t>(signer.jaw)];
    ASSERT_NEAR(jaw.angularDistance(Eigen::Quaternionf::Identity()), 0.02f + 0.24f * open[i], 0.002f) << i;
  }
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

TEST_F(Performance, LooksAtTheHandIfTheSignSaysSoAndOtherwiseAtTheViewer) {
  const Motion& motion = made().motion;
  const Signer signer = make_signer();
  double worst = 0;
  int at_hand = 0, at_viewer = 0;
  for (const PlacedSign& sign : made().timeline.signs) {
    const std::int64_t frame = (sign.stroke_begin + sign.stroke_end) / 2;
    const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
    const auto index = static_cast<std::size_t>(signer.left.eye);
    const Vector3f look = pose.rotations[index] * Vector3f::UnitZ();
    const auto to = [&](const Vector3f& target) {
      return degrees(std::acos(
          std::clamp(static_cast<double>(look.dot((target - pose.positions[index]).normalized())), -1.0, 1.0)));
    };
    const Vector3f right = pose.positions[static_cast<std::size_t>(signer.right.hand)];
    const Vector3f left = pose.positions[static_cast<std::size_t>(signer.left.hand)];
    const Vector3f hands = acts(*sign.shape, Side::left) ? Vector3f(0.5f * (right + left)) : right;
    if (sign.shape->face.gaze == Gaze::hand) {
      EXPECT_LT(to(hands), 28) << sign.shape->gloss;  // the eyes have limits, and look slightly above the wrist
      EXPECT_GT(to({0, 1.6f, 2.5f}), 12) << sign.shape->gloss;
      ++at_hand;
    } else {
      EXPECT_LT(to({0, 1.6f, 2.5f}), 6) << sign.shape->gloss;
      ++at_viewer;
    }
  }
  EXPECT_GE(at_hand, 6);
  EXPECT_GE(at_viewer, 15);
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (const Side side : kSides) {
      const Vector3f look =
          motion.pose(frame).rotations[static_cast<std::size_t>(signer.side(side).eye)] * Vector3f::UnitZ();
      worst =
          std::max({worst, degrees(std::abs(std::atan2(look.x(), look.z()))), degrees(std::abs(std::asin(look.y())))});
    }
  }
  EXPECT_LE(worst, 25.0);
  EXPECT_GT(worst, 10.0);
}

TEST_F(Performance, TheHeadFollowsTheEyesAndNodsAtTheEndOfASentence) {
  const Planned plan(meteo());
  Random random(5);
  const std::vector<BodyFrame> body = move_body(plan.timeline, plan.plan, random);
  const auto down = [&](std::int64_t frame) { return std::asin(-body[static_cast<std::size_t>(frame)].look.y()); };
  int leaps = 0;
  for (std::size_t i = 30; i + 60 < body.size(); ++i) {
    const auto frame = static_cast<std::int64_t>(i);
    // An eye movement of more than 15° ends within 80 ms; the head has hardly started by then.
    if (down(frame + 8) - down(frame) < 0.26f || down(frame) > 0.15f) continue;
    ++leaps;
    const double before = body[i].head_pitch;
    EXPECT_LT(body[i + 8].head_pitch - before, 0.12) << i;
    i += 60;
  }
  EXPECT_GE(leaps, 3);
  // Eyes jump rather than glide: most of the movement takes under three hundredths of a second.
  float quickest = 0;
  for (std::size_t i = 0; i + 3 < body.size(); ++i) {
    quickest = std::max(quickest, std::acos(std::min(1.0f, body[i].look.dot(body[i + 3].look))));
  }
  EXPECT_GT(degrees(static_cast<double>(quickest)), 15);
  for (std::size_t i = 0; i < plan.timeline.signs.size(); ++i) {
    if (!ends_unit(plan.timeline, i)) continue;
    const auto end = static_cast<std::size_t>(plan.timeline.signs[i].stroke_end);
    double lowest = 0;
    for (std::size_t k = end; k < end + 50; ++k) lowest = std::max(lowest, body[k].head_pitch);
    EXPECT_GT(lowest, body[end + 65].head_pitch + 0.04) << i;
  }
}

TEST_F(Performance, TheChestBreathesTwelveToEighteenTimesPerMinute) {
  const Motion& motion = made().motion;
  const Signer signer = make_signer();
  std::vector<double> pitch;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const Vector3f up = motion.pose(frame).rotations[static_cast<std::size_t>(signer.spine2)] * Vector3f::UnitY();
    pitch.push_back(std::asin(static_cast<double>(up.z())));
  }
  const auto strength = [&](double hertz) {
    double c = 0, s = 0;
    for (std::size_t i = 0; i < pitch.size(); ++i) {
      const double angle = 2 * std::numbers::pi * hertz * 0.01 * static_cast<double>(i);
      c += pitch[i] * std::cos(angle);
      s += pitch[i] * std::sin(angle);
    }
    return 2 * std::hypot(c, s) / static_cast<double>(pitch.size());
  };
  double best = 0, at = 0;
  for (int hundredths = 12; hundredths < 60; ++hundredths) {
    const double hertz = 0.01 * hundredths;
    if (strength(hertz) > best) {
      best = strength(hertz);
      at = hertz;
    }
  }
  EXPECT_GE(at, 0.2);
  EXPECT_LE(at, 0.3);
  EXPECT_GT(best, 0.008);  // radians: about 3 mm at the breastbone
}

TEST_F(Performance, NothingIsEverCompletelyStill) {
  const Motion& motion = made().motion;
  const Signer signer = make_signer();
  const Timeline& timeline = made().timeline;
  // Hands at rest between two sentences drift by one or two millimetres, smoothly.
  double squares = 0;
  double count = 0;
  float quickest = 0;
  for (std::size_t i = 0; i + 1 < timeline.signs.size(); ++i) {
    if (!ends_unit(timeline, i)) continue;
    const std::int64_t middle = (timeline.signs[i].end + timeline.signs[i + 1].begin) / 2;
    for (const Side side : kSides) {
      Vector3f before = to_model(rest_place(), side);
      for (std::int64_t frame = middle - 15; frame < middle + 15; ++frame) {
        const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
        const Vector3f wrist = pose.positions[static_cast<std::size_t>(signer.side(side).hand)];
        squares += static_cast<double>((wrist - to_model(rest_place(), side)).squaredNorm());
        if (frame > middle - 15) quickest = std::max(quickest, (wrist - before).norm());
        before = wrist;
        ++count;
      }
    }
  }
  const double deviation = 1000 * std::sqrt(squares / count);  // millimetres, of three axes together
  EXPECT_GT(deviation, 0.9);
  EXPECT_LT(deviation, 3.0);
  EXPECT_GT(quickest, 0.0f);
  EXPECT_LT(quickest, 0.0005f);
}

}  // namespace
}  // namespace signweave::demo
