#include "signweave/nonmanual/mouthing/mouthing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "signweave/nonmanual/mouthing/pronounce.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The weights of the mouth over the frames of a mouthing, on top of a captured mouth that is wide open.
std::vector<MouthWeights> shown(const TimedCurve& mouthing, FrameRate rate, float amount = 1) {
  const FrameRange at = frames_of(mouthing.at, {.frame_time = rate.frame_time()});
  Curve curve = mouthing.curve;
  curve.amount = amount;
  std::vector<std::vector<float>> values;
  for (std::size_t i = 0; i < viseme_tracks().size(); ++i) {
    values.emplace_back(static_cast<std::size_t>(at.size()), viseme_tracks()[i] == "jawOpen" ? 0.8f : 0.1f);
  }
  std::vector<TrackSpan> spans;
  for (std::size_t i = 0; i < values.size(); ++i) spans.push_back({viseme_tracks()[i], values[i]});
  apply(curve, at, rate, at, spans);
  std::vector<MouthWeights> frames(static_cast<std::size_t>(at.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto weight = static_cast<std::size_t>(*mouth_weight_of(viseme_tracks()[i]));
    for (std::size_t frame = 0; frame < frames.size(); ++frame) frames[frame][weight] = values[i][frame];
  }
  return frames;
}

std::int64_t frame_of(const MouthKey& key, FrameRate rate) {
  return std::llround(count_of(key.at) * rate.hertz() / 1000);
}

TEST(Mouthing, TheLipsCloseAtEveryPBMWhateverTheSpeed) {
  for (const char* ipa : {"bɔ̃ʒuʁ", "papa", "pɔpylasjɔ̃", "tɑ̃peʁatyʁ", "apamabapama", "bmpa", "ʃaʃpaʃa", "ɪmpɔːtənt"}) {
    for (const Milliseconds stroke : {60ms, 250ms, 600ms, 2500ms}) {
      for (const FrameRate rate : {FrameRate{12, 1}, FrameRate{25, 1}, FrameRate{60, 1}, FrameRate{120, 1}}) {
        for (const float amount : {1.0f, 0.3f}) {
          const TimedCurve mouthing = mouthing_over(ipa, phones_of_ipa(ipa), {1000ms, 1000ms + stroke});
          const std::vector<MouthWeights> frames = shown(mouthing, rate, amount);
          for (const MouthKey& key : mouthing.curve.mouth) {
            if (key.viseme != Viseme::pp) continue;
            EXPECT_LE(lip_gap(frames[static_cast<std::size_t>(frame_of(key, rate))]), 0.1f)
                << ipa << ' ' << stroke.count() << " ms " << rate.hertz() << " Hz at " << key.at.count();
          }
        }
      }
    }
  }
}

TEST(Mouthing, VowelsBetweenClosuresStayOpen) {
  for (const Milliseconds stroke : {250ms, 600ms}) {
    const FrameRate rate{60, 1};
    const TimedCurve mouthing = mouthing_over("papa", phones_of_ipa("papa"), {1000ms, 1000ms + stroke});
    const std::vector<MouthWeights> frames = shown(mouthing, rate);
    for (const MouthKey& key : mouthing.curve.mouth) {
      const MouthWeights& weights = frames[static_cast<std::size_t>(frame_of(key, rate))];
      if (key.viseme == Viseme::aa) EXPECT_GT(lip_gap(weights), 5) << stroke.count();
    }
  }
}

TEST(Mouthing, RoundedVowelsDifferFromOneAnotherAndFromSpread) {
  const auto middle = [](const char* ipa) {
    const TimedCurve mouthing = mouthing_over(ipa, phones_of_ipa(ipa), {1000ms, 1400ms});
    const std::vector<MouthWeights> frames = shown(mouthing, {100, 1});
    return frames[frames.size() / 2];
  };
  const auto of = [](const MouthWeights& weights, MouthWeight weight) {
    return weights[static_cast<std::size_t>(weight)];
  };
  EXPECT_GT(of(middle("y"), MouthWeight::pucker), 0.6f);
  EXPECT_LT(of(middle("i"), MouthWeight::pucker), 0.05f);
  EXPECT_GT(of(middle("i"), MouthWeight::smile), 0.3f);
  EXPECT_NEAR(of(middle("y"), MouthWeight::jaw_open), of(middle("u"), MouthWeight::jaw_open) / 2, 0.01f);
  EXPECT_GT(of(middle("ø"), MouthWeight::jaw_open), of(middle("y"), MouthWeight::jaw_open) + 0.1f);
}

TEST(Mouthing, NeighboursColourASound) {
  const auto lips_of_s = [](const char* ipa) {
    const std::vector<MouthKey> keys = fit_sounds(phones_of_ipa(ipa), 195ms).keys;
    const VisemeShares shares = viseme_shares(keys, count_of(keys[1].at));
    float pucker = 0;
    for (std::size_t v = 0; v < kVisemeCount; ++v) {
      pucker += shares[v] * shape_of(static_cast<Viseme>(v))[static_cast<std::size_t>(MouthWeight::pucker)];
    }
    return pucker;
  };
  EXPECT_GT(lips_of_s("usu"), 0.3f);
  EXPECT_LT(lips_of_s("isi"), 0.01f);
}

RC_GTEST_PROP(Mouthing, SumsStayBetweenZeroAndOne, ()) {
  const std::size_t count = *rc::gen::inRange<std::size_t>(1, 30);
  std::vector<MouthKey> keys;
  Milliseconds at{0};
  for (std::size_t i = 0; i < count; ++i) {
    at += Milliseconds(*rc::gen::inRange(0, 400));
    keys.push_back({.viseme = static_cast<Viseme>(*rc::gen::inRange<int>(0, kVisemeCount)),
                    .at = at,
                    .held = Milliseconds(*rc::gen::inRange(0, 300))});
  }
  for (double t = -200; t < count_of(at) + 900; t += 7) {
    float sum = 0;
    for (const float share : viseme_shares(keys, t)) {
      RC_ASSERT(share >= 0);
      sum += share;
    }
    RC_ASSERT(sum <= 1.0001f);
  }
  const TimedCurve mouthing{.curve = {.name = "x", .mouth = keys}, .at = {0ms, at + 100ms}};
  for (const MouthWeights& weights : shown(mouthing, {50, 1})) {
    for (const float weight : weights) RC_ASSERT(weight >= 0 && weight <= 1);
  }
}

std::string visemes_of(const std::vector<MouthKey>& keys) {
  std::string text;
  for (const MouthKey& key : keys) text += std::string(text.empty() ? "" : " ") + std::string(name_of(key.viseme));
  return text;
}

TEST(FitSounds, FillTheSpanIfTheyNearlyDo) {
  const std::vector<Phone> phones = phones_of_ipa("matɛ̃");  // 4 sounds, some 263 ms
  for (const Milliseconds span : {160ms, 200ms, 263ms, 340ms}) {
    const FittedSounds fitted = fit_sounds(phones, span);
    EXPECT_EQ(fitted.phones, 4U) << span.count();
    EXPECT_NEAR(fitted.tempo, 263.25 / count_of(span), 0.02);
    EXPECT_EQ(fitted.keys.back().held, 0ms);
    EXPECT_NEAR(count_of(span - fitted.keys.back().at), 31 / fitted.tempo, 2);
  }
}

TEST(FitSounds, HoldTheLastVowelOfAShortWord) {
  const FittedSounds fitted = fit_sounds(phones_of_ipa("nɔʁ"), 500ms);
  EXPECT_EQ(fitted.tempo, 1);
  EXPECT_EQ(visemes_of(fitted.keys), "nn O kk");
  EXPECT_EQ(fitted.keys[0].held, 0ms);
  EXPECT_NEAR(count_of(fitted.keys[1].held), 500 - 65 * (0.9 + 1 + 1.15), 2);
  EXPECT_GT(fitted.keys[2].at, 450ms);
}

TEST(FitSounds, LeaveOutTheLastSyllables) {
  const std::vector<Phone> phones = phones_of_ipa("tɑ̃peʁatyʁ");
  EXPECT_EQ(visemes_of(fit_sounds(phones, 400ms).keys), "DD aa PP E kk aa DD Y kk");
  EXPECT_EQ(visemes_of(fit_sounds(phones, 250ms).keys), "DD aa PP E kk aa");
  EXPECT_EQ(visemes_of(fit_sounds(phones, 160ms).keys), "DD aa PP E");
  EXPECT_EQ(visemes_of(fit_sounds(phones, 20ms).keys), "DD aa");  // the first always
}

TEST(FitSounds, StayInOrderAndInside) {
  for (const Milliseconds span : {0ms, 1ms, 10ms, 100ms, 5000ms}) {
    const FittedSounds fitted = fit_sounds(phones_of_ipa("pɔpylasjɔ̃"), span);
    for (std::size_t i = 0; i < fitted.keys.size(); ++i) {
      EXPECT_LE(fitted.keys[i].at + fitted.keys[i].held, std::max(span, 1ms));
      if (i > 0) EXPECT_GE(fitted.keys[i].at, fitted.keys[i - 1].at);
    }
  }
  EXPECT_THAT(fit_sounds({}, 500ms).keys, IsEmpty());
}

TEST(MouthingOver, CoversTheStrokeAndALittleMore) {
  const TimedCurve mouthing = mouthing_over("pluie", phones_of_ipa("plɥi"), {1000ms, 1500ms});
  EXPECT_LE(mouthing.at.begin, 940ms);
  EXPECT_GE(mouthing.at.end, 1540ms);
  EXPECT_EQ(mouthing.curve.name, "pluie");
  // At the first sound the mouth is all authored.
  EXPECT_GE(mouthing.curve.mouth.front().at, mouthing.curve.onset);
  EXPECT_NO_THROW(check(mouthing.curve, "x"));
  EXPECT_TRUE(mouthing_over("", {}, {0ms, 1s}).curve.mouth.empty());
}

TEST(LipGap, IsOneAtRestAndNoneWhenPressed) {
  EXPECT_FLOAT_EQ(lip_gap({}), 1);
  EXPECT_FLOAT_EQ(lip_gap(shape_of(Viseme::pp)), 0);
  EXPECT_GT(lip_gap(shape_of(Viseme::aa)), 15);
  MouthWeights half_pressed{};
  half_pressed[static_cast<std::size_t>(MouthWeight::press)] = 0.3f;
  EXPECT_NEAR(lip_gap(half_pressed), 0.55f, 1e-5f);
}

}  // namespace
}  // namespace signweave
