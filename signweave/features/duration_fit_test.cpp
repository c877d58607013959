#include "signweave/features/duration_fit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "signweave/core/error.h"

namespace signweave {
namespace {

TransitionTask task(float distance, float approach = 0, float speed = 0) {
  TransitionTask task{.hands = {}, .shoulder_width = 0.36f};
  task.hands[1] = {
      .known = true, .distance = distance, .speed_before = speed, .speed_after = speed, .approach = approach};
  return task;
}

/// Transitions that follow a law plus noise, from the given number of recordings.
std::vector<TimedTransition> lawful(std::size_t count, std::size_t recordings, float noise) {
  std::mt19937 random(7);
  std::vector<TimedTransition> result;
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() % 1000) / 1000.0f;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const float distance = uniform(0.02f, 0.6f);
    const float approach = uniform(-0.5f, 0.8f);
    const float seconds = 0.9f * std::pow(distance + 0.02f, 0.4f) * std::exp(-0.3f * approach + uniform(-noise, noise));
    result.push_back(
        {.task = task(distance, approach, 0.3f), .duration = Seconds(seconds), .recording = i % recordings});
  }
  return result;
}

TEST(Durations, AreFittedIfTheTaskPredictsThem) {
  const DurationFit fit = fit_durations(lawful(80, 4, 0.1f));
  EXPECT_EQ(fit.count, 80u);
  ASSERT_FALSE(fit.weights.empty());
  EXPECT_LT(fit.fitted_error, 0.5 * fit.mean_error);
  EXPECT_NEAR(duration_of(fit, task(0.3f, 0, 0.3f)).count(), 0.9 * std::pow(0.32, 0.4), 0.05);
  EXPECT_LT(duration_of(fit, task(0.1f, 0, 0.3f)), duration_of(fit, task(0.4f, 0, 0.3f)));
  EXPECT_LT(duration_of(fit, task(0.3f, 0.5f, 0.3f)), duration_of(fit, task(0.3f, -0.2f, 0.3f)));
}

TEST(Durations, AreTheMeanIfTheTaskPredictsNothing) {
  std::vector<TimedTransition> transitions = lawful(60, 3, 0.1f);
  std::mt19937 random(3);
  for (TimedTransition& one : transitions) one.duration = Seconds(0.3 + 0.001 * static_cast<double>(random() % 500));
  const DurationFit fit = fit_durations(transitions);
  EXPECT_TRUE(fit.weights.empty());
  EXPECT_GT(fit.fitted_error, 0.95 * fit.mean_error);
  EXPECT_EQ(duration_of(fit, task(0.01f)), fit.mean);
  EXPECT_EQ(duration_of(fit, task(0.9f)), fit.mean);
}

TEST(Durations, FewTransitionsGiveTheirMean) {
  const DurationFit fit = fit_durations(lawful(kLeastTransitions - 1, 3, 0));
  EXPECT_TRUE(fit.weights.empty());
  EXPECT_EQ(fit.fitted_error, Seconds(0));
  EXPECT_GT(fit.mean, Seconds(0));
  EXPECT_EQ(fit_durations({}).count, 0u);
}

TEST(Durations, OneRecordingIsDivided) {
  EXPECT_FALSE(fit_durations(lawful(60, 1, 0.1f)).weights.empty());
}

TEST(Durations, AnUnknownHandIsIgnored) {
  const DurationFit fit = fit_durations(lawful(80, 4, 0.1f));
  EXPECT_EQ(duration_of(fit, {}), fit.mean);
}

RC_GTEST_PROP(Durations, StayWithinTheTrainingRange, ()) {
  static const std::vector<TimedTransition> seen = lawful(80, 4, 0.2f);
  static const DurationFit fit = fit_durations(seen);
  Seconds least = seen[0].duration;
  Seconds most = seen[0].duration;
  for (const TimedTransition& one : seen) {
    least = std::min(least, one.duration);
    most = std::max(most, one.duration);
  }
  const auto number = [](int low, int high) { return 0.01f * static_cast<float>(*rc::gen::inRange(low, high)); };
  const Seconds predicted = duration_of(fit, task(number(0, 500), number(-900, 900), number(0, 900)));
  RC_ASSERT(predicted.count() >= least.count() - 1e-6);
  RC_ASSERT(predicted.count() <= most.count() + 1e-6);
}

TEST(Durations, SurviveStorage) {
  for (const DurationFit& fit :
       {fit_durations(lawful(80, 4, 0.1f)), fit_durations(lawful(5, 2, 0.1f)), DurationFit{}}) {
    ByteWriter out;
    encode(fit, out);
    ByteReader in(out.bytes(), "fit");
    const DurationFit read = decode_duration_fit(in);
    in.finish();
    EXPECT_EQ(read.weights, fit.weights);
    EXPECT_EQ(read.fitted_error, fit.fitted_error);
    EXPECT_TRUE(nearly_same(read, fit));
    EXPECT_EQ(duration_of(read, task(0.3f, 0, 0.3f)), duration_of(fit, task(0.3f, 0, 0.3f)));
  }
}

TEST(Durations, InvalidBytesAreRefused) {
  const DurationFit fit = fit_durations(lawful(80, 4, 0.1f));
  const auto refused = [](const DurationFit& wrong) {
    ByteWriter out;
    encode(wrong, out);
    ByteReader in(out.bytes(), "fit");
    EXPECT_THROW(decode_duration_fit(in), Error);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  DurationFit wrong = fit;
  wrong.mean = Seconds(-1);
  refused(wrong);
  wrong = fit;
  wrong.weights[2] = nan;
  refused(wrong);
  wrong = fit;
  std::swap(wrong.least, wrong.most);
  refused(wrong);
  wrong = fit;
  std::swap(wrong.inputs_least, wrong.inputs_most);
  refused(wrong);
  wrong = fit;
  wrong.fastest = nan;
  refused(wrong);
}

}  // namespace
}  // namespace signweave
