#include "signweave/formats/face/face_csv.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "signweave/drawing/test_person.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kHeading = "Timecode,BlendShapeCount,JawOpen,EyeBlinkLeft\n";

face_csv::Face read_rows(const std::string& rows) {
  return face_csv::read_text("f.csv", kHeading + rows);
}

std::string face_error(const std::string& text) {
  try {
    face_csv::read_text("f.csv", text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// The rows' times in thousandths of a second.
std::vector<long> times_ms(const face_csv::Face& face) {
  std::vector<long> times;
  for (const Seconds time : face.times) times.push_back(std::lround(time.count() * 1000));
  return times;
}

/// Rows one frame apart, for some seconds.
std::string rows_at(int rate, int seconds) {
  std::string rows;
  for (int i = 0; i < rate * seconds; ++i) rows += fmt::format("10:00:{:02}:{:02}.125,2,0,0\n", i / rate, i % rate);
  return rows;
}

TEST(FaceCsv, NamesAreArkitsAndTimesCountFromTheFirstRow) {
  const face_csv::Face face =
      read_rows("11:22:33:30.000,2,0.25,0\n11:22:33:45.000,2,0.5,1e-3\r\n11:22:34:00.000,2,1,-0.5\n");
  ASSERT_EQ(face.tracks.size(), 2u);
  EXPECT_EQ(face.tracks[0].name, "jawOpen");
  EXPECT_THAT(face.tracks[0].values, ElementsAre(0.25f, 0.5f, 1));
  EXPECT_EQ(face.tracks[1].name, "eyeBlinkLeft");
  EXPECT_THAT(face.tracks[1].values, ElementsAre(0, 1e-3f, -0.5f));
  EXPECT_EQ(face.rate, (FrameRate{60, 1}));
  EXPECT_THAT(times_ms(face), ElementsAre(0, 250, 500));
  EXPECT_THAT(face.notices, IsEmpty());
}

TEST(FaceCsv, TheRateIsTheNumberOfFramesInAWholeSecond) {
  for (const int rate : {24, 25, 30, 60, 100, 120}) {
    const face_csv::Face face = read_rows(rows_at(rate, 3));
    EXPECT_EQ(face.rate, (FrameRate{rate, 1}));
    EXPECT_NEAR(face.times.back().count(), 3 - 1.0 / rate, 1e-9);
  }
  EXPECT_EQ(read_rows("0:0:0:0,2,0,0\n0:0:0:29,2,0,0\n").rate, (FrameRate{60, 1})) << "too little is seen";
  EXPECT_EQ(read_rows("0:0:0:0,2,0,0\n0:0:0:30,2,0,0\n0:0:1:0,2,0,0\n0:0:2:0,2,0,0\n").rate, (FrameRate{60, 1}))
      << "rows are not a frame apart";
  EXPECT_EQ(read_rows("0:0:0:0,2,0,0\n0:0:0:75,2,0,0\n").rate, (FrameRate{90, 1})) << "60 has no frame 75";
}

TEST(FaceCsv, TimeContinuesAfterMidnight) {
  EXPECT_THAT(times_ms(read_rows("23:59:59:30,2,0,0\n00:00:00:00,2,0,0\n00:00:00:30,2,0,0\n")),
              ElementsAre(0, 500, 1000));
  constexpr long kHour = 3'600'000;
  EXPECT_THAT(times_ms(read_rows("20:0:0:0,2,0,0\n6:0:0:0,2,0,0\n20:0:0:0,2,0,0\n6:0:0:0,2,0,0\n")),
              ElementsAre(0, 10 * kHour, 24 * kHour, 34 * kHour));
}

TEST(FaceCsv, RowsThatSawNoFaceAreBridged) {
  const face_csv::Face face = read_rows("0:0:0:0,0\n0:0:0:6,2,1,0\n0:0:0:12,0,,\n0:0:0:18,2,0,0\n");
  EXPECT_THAT(face.tracks[0].values, ElementsAre(1, 0));
  EXPECT_THAT(times_ms(face), ElementsAre(100, 300)) << "from the first row, face or not";
  ASSERT_EQ(face.notices.size(), 1u);
  EXPECT_EQ(face.notices[0].text, "2 of 4 rows saw no face and are bridged");
}

TEST(FaceCsv, OtherTracksThanArkitsAreReadAndReported) {
  const face_csv::Face face = face_csv::read_text("f.csv", "timecode,blendshapecount,JawOpen,Ear\n0:0:0:0,2,0,1\n");
  EXPECT_EQ(face.tracks[1].name, "ear");
  ASSERT_EQ(face.notices.size(), 1u);
  EXPECT_EQ(face.notices[0].text, "tracks in addition to ARKit's: ear");
}

TEST(FaceCsv, AnErrorNamesItsLine) {
  EXPECT_THAT(face_error(""), HasSubstr("f.csv:1: the file is empty"));
  EXPECT_THAT(face_error("frame,time_s,Hips.x\n0,0,1\n"),
              HasSubstr("f.csv:1: expected the heading Timecode,BlendShape"));
  EXPECT_THAT(face_error("Timecode,BlendShapeCount\n"), HasSubstr("f.csv:1: expected the heading"));
  EXPECT_THAT(face_error("Timecode,BlendShapeCount,JawOpen,\n"), HasSubstr("f.csv:1: column 4 has no name"));
  EXPECT_THAT(face_error("Timecode,BlendShapeCount,JawOpen,jawOpen\n"), HasSubstr("column 'jawOpen' occurs twice"));
  EXPECT_THAT(face_error("Timecode,BlendShapeCount,Ear\n"),
              HasSubstr("column 'Ear' and the others are not ARKit names"));
  EXPECT_THAT(face_error(kHeading), HasSubstr("f.csv:2: no row with values"));
  EXPECT_THAT(face_error(kHeading + "0:0:0:0,0,,\n"), HasSubstr("f.csv:3: no row with values"));
  EXPECT_THAT(face_error(kHeading + "\n0:0:0:0,2,0,0\n0:0:0:1,2,0\n"),
              HasSubstr("f.csv:4: 3 columns where the heading has 4"));
  EXPECT_THAT(face_error(kHeading + "0:0:0:0,2,0,0,0\n"), HasSubstr("f.csv:2: 5 columns where the heading has 4"));
  EXPECT_THAT(face_error(kHeading + "0:0:0:0,2,0,x\n"),
              HasSubstr("f.csv:2: 'x' in column EyeBlinkLeft is not a finite number"));
  for (const char* value : {"nan", "inf", "1e99", "", "0x1", "1,5 "}) {
    EXPECT_THAT(face_error(kHeading + "0:0:0:0,2,0," + value + "\n"), HasSubstr("f.csv:2: ")) << value;
  }
  EXPECT_THAT(face_error(kHeading + "0:0:0:0,two,0,0\n"),
              HasSubstr("f.csv:2: expected a number in the column BlendShape"));
  EXPECT_THAT(face_error(kHeading + "0:0:0:0\n"), HasSubstr("f.csv:2: expected a number in the column BlendShape"));
  for (const char* code : {"", "0", "0:0:0", "24:0:0:0", "0:60:0:0", "0:0:60:0", "-1:0:0:0", "0:0:0:-1", "0:0:0:1e9",
                           "0:0:0:nan", "0:0:0;0", "0:0:0:0:0", "a:0:0:0"}) {
    EXPECT_THAT(face_error(kHeading + code + ",2,0,0\n"), HasSubstr("is not a timecode")) << code;
  }
  EXPECT_THAT(face_error(kHeading + "0:0:5:0,2,0,0\n0:0:4:59,2,0,0\n"),
              HasSubstr("f.csv:3: the timecode 0:0:4:59 goes back"));
  EXPECT_THAT(face_error(std::string("\0\1", 2)), HasSubstr("f.csv:1: "));
}

TEST(FaceCsv, ResamplingIsLinearAndHoldsTheLastValue) {
  const face_csv::Face face = read_rows("0:0:0:0,2,0,1\n0:0:0:6,2,1,1\n0:0:0:12,2,0,5\n");
  const std::vector<ScalarTrack> tracks = face_csv::resampled(face, {20, 1}, 7);  // 0, 50, 100, … ms
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0].name, "jawOpen");
  const std::vector<float> wanted = {0, 0.5f, 1, 0.5f, 0, 0, 0};
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(tracks[0].values[i], wanted[i], 1e-6f) << i;
  EXPECT_EQ(tracks[1].values.back(), 5);
  EXPECT_THAT(face_csv::resampled(face, {20, 1}, 0)[0].values, IsEmpty());
}

TEST(FaceCsv, BeginsAtTheGivenStart) {
  const face_csv::Face face = read_rows("10:20:30:0,2,0,1\n10:20:30:30,2,1,1\n");
  EXPECT_DOUBLE_EQ(face.first.count(), 37'230);
  // 4 frames a second: the first row at 0.25 s, the second at 0.75 s.
  EXPECT_THAT(face_csv::resampled(face, {4, 1}, 5, Seconds(0.25))[0].values, ElementsAre(0, 0, 0.5f, 1, 1));
  EXPECT_THAT(face_csv::resampled(face, {4, 1}, 3, Seconds(-0.25))[0].values, ElementsAre(0.5f, 1, 1));
}

TEST(FaceCsv, TimecodesGiveItsStartInAMotion) {
  const face_csv::Face face = read_rows("00:00:01:30,2,0,1\n");
  EXPECT_DOUBLE_EQ(face_csv::seconds_of("00:00:01:15", {60, 1})->count(), 1.25);
  EXPECT_FALSE(face_csv::seconds_of("1:15", {60, 1}));
  EXPECT_DOUBLE_EQ(face_csv::start_of(face, Seconds(1.25)).count(), 0.25);
  EXPECT_DOUBLE_EQ(face_csv::start_of(face, Seconds(4)).count(), -2.5);
  const Seconds before_midnight = *face_csv::seconds_of("23:59:59:30", {60, 1});
  EXPECT_DOUBLE_EQ(face_csv::start_of(face, before_midnight).count(), 2.0);
}

TEST(FaceCsv, BeforeTheFirstFaceItsValuesHoldAndEqualTimesAreAStep) {
  const face_csv::Face late = read_rows("0:0:0:0,0\n0:0:0:30,2,1,0\n");
  EXPECT_THAT(face_csv::resampled(late, {4, 1}, 4)[0].values, ElementsAre(1, 1, 1, 1));
  const face_csv::Face step = read_rows("0:0:0:0,2,0,0\n0:0:0:30,2,0,0\n0:0:0:30,2,1,0\n0:0:0:45,2,1,0\n");
  EXPECT_THAT(face_csv::resampled(step, {4, 1}, 4)[0].values, ElementsAre(0, 0, 1, 1));
}

TEST(FaceCsv, EveryArkitNameIsWrittenThenTheOthers) {
  Motion motion(person(), {30, 1}, 2);
  motion.add_track({"ear,\n\"x\"", {1, 2}});
  motion.add_track({"jawOpen", {0.5f, 0.25f}});
  const std::string text = face_csv::write_text(motion);
  EXPECT_TRUE(text.starts_with("Timecode,BlendShapeCount,EyeBlinkLeft,EyeLookDownLeft,EyeLookInLeft,"));
  EXPECT_THAT(text, HasSubstr(",TongueOut,HeadYaw,HeadPitch,HeadRoll,LeftEyeYaw,LeftEyePitch,LeftEyeRoll,RightEyeYaw,"
                              "RightEyePitch,RightEyeRoll,Ear__\"x\"\n00:00:00:00.000,62,0,"));
  EXPECT_THAT(text, HasSubstr("\n00:00:00:02.000,62,0,"));
  EXPECT_EQ(face_csv::track_names().size(), 61u);
  const face_csv::Face face = face_csv::read_text("f.csv", text);
  EXPECT_EQ(face.tracks.size(), 62u);
  EXPECT_THAT(face.tracks[17].values, ElementsAre(0.5f, 0.25f));
}

RC_GTEST_PROP(FaceCsvProperty, WhatIsWrittenIsReadBackAtTheSameFrames, ()) {
  const FrameRate rate = {*rc::gen::element<std::int64_t>(1, 5, 24, 25, 30, 60, 100, 120, 1000), 1};
  const std::int64_t frames = *rc::gen::inRange(1, 400);
  Motion motion(person(), rate, frames);
  for (const char* name : {"browInnerUp", "headYaw", "mine"}) {
    ScalarTrack track{.name = name, .values = {}};
    for (std::int64_t i = 0; i < frames; ++i) {
      track.values.push_back(static_cast<float>(*rc::gen::inRange(-100'000, 100'000)) / 70'000.0f);
    }
    motion.add_track(track);
  }
  const face_csv::Face face = face_csv::read_text("f.csv", face_csv::write_text(motion));
  const std::vector<ScalarTrack> back = face_csv::resampled(face, rate, frames);
  for (const ScalarTrack& track : motion.tracks()) {
    const auto same = std::find_if(back.begin(), back.end(), [&](const auto& one) { return one.name == track.name; });
    RC_ASSERT(same != back.end());
    for (std::size_t i = 0; i < track.values.size(); ++i)
      RC_ASSERT(std::abs(same->values[i] - track.values[i]) < 1e-5f);
  }
}

TEST(FaceCsv, TakesNumbersTooSmallForAFloatAsZero) {
  EXPECT_EQ(face_csv::read_text("f.csv", "Timecode,BlendShapeCount,JawOpen\n0:0:0:0,1,1e-50\n").tracks[0].values[0], 0);
}

TEST(FaceCsv, RefusesAHeadingWithThousandsOfColumns) {
  std::string heading = "Timecode,BlendShapeCount,JawOpen";
  for (int i = 0; i < 600; ++i) heading += fmt::format(",C{}", i);
  EXPECT_THROW(face_csv::read_text("f.csv", heading + "\n"), Error);
}

TEST(FaceCsvResampled, LeavesOutArkitTracksThatAreAlwaysZero) {
  const auto names = [](const std::string& text) {
    std::vector<std::string> found;
    for (const ScalarTrack& track : face_csv::resampled(face_csv::read_text("f.csv", text), {60, 1}, 3)) {
      found.push_back(track.name);
    }
    return found;
  };
  const std::string heading = "Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen,Ear\n";
  EXPECT_THAT(names(heading + "0:0:0:0,3,0,0.5,0\n0:0:0:1,3,0,0,0\n"), testing::ElementsAre("jawOpen", "ear"));
  EXPECT_THAT(names("Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen\n0:0:0:0,2,0,0\n"),
              testing::ElementsAre("eyeBlinkLeft"));
}

}  // namespace
}  // namespace signweave
