// Contact sheets of generated recordings.

#include "demo/sheets.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

namespace signweave::demo {
namespace {

std::size_t count(const std::string& text, std::string_view what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

const SyntheticRecording& made() {
  static const SyntheticRecording recording =
      make_recording({.name = "short",
                      .units = {{"BONJOUR", "METEO"}, {"PARIS", "PLUIE", "NORD"}},
                      .transition_mean = 735ms,
                      .transition_deviation = 224ms},
                     {100, 1}, 1);
  return recording;
}

TEST(Sheets, ShowBothEndsOfEveryStroke) {
  const std::string sheet = stroke_sheet(made());
  EXPECT_EQ(count(sheet, "<g "), 10U);
  for (const char* gloss : {"BONJOUR", "METEO", "PARIS", "PLUIE", "NORD"}) {
    EXPECT_EQ(count(sheet, fmt::format(">{} [", gloss)), 1U) << gloss;
  }
  EXPECT_THAT(sheet, testing::HasSubstr("placeholder shapes, not LSF"));
}

TEST(Sheets, ShowASentenceFromItsBeginToItsEnd) {
  const std::string sheet = sentence_sheet(made(), 1);
  const PlacedSign& first = made().timeline.signs[2];
  const PlacedSign& last = made().timeline.signs[4];
  EXPECT_EQ(count(sheet, "<g "), static_cast<std::size_t>((last.end - first.begin + 9) / 10));
  EXPECT_THAT(sheet, testing::HasSubstr("short: PARIS PLUIE NORD"));
  EXPECT_THAT(sheet, testing::HasSubstr("placeholder shapes, not LSF"));
  EXPECT_GE(count(sheet, ">PLUIE<"), 3U);
  EXPECT_EQ(count(sheet, ">METEO<"), 0U);
  EXPECT_NE(sheet, sentence_sheet(made(), 1, 75));
}

TEST(Sheets, ShowEveryHandshapeTwice) {
  const std::string sheet = handshape_sheet();
  EXPECT_EQ(count(sheet, "<g "), 2U * kHandshapes);
  for (int i = 0; i < kHandshapes; ++i) {
    EXPECT_EQ(count(sheet, fmt::format(">{}<", name_of(static_cast<Handshape>(i)))), 2U) << i;
  }
  EXPECT_THAT(sheet, testing::HasSubstr("placeholder shapes, not LSF"));
}

}  // namespace
}  // namespace signweave::demo
