#include "signweave/score/junction_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/core/error.h"

namespace signweave {
namespace {

using testing::HasSubstr;

std::string fault_of(const std::vector<std::string>& texts) {
  try {
    parse_junctions(texts);
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

TEST(ParseJunction, PartsAreOptionalAndInAnyOrder) {
  const NumberedJunction all = parse_junction("12=x1.5,hermite,450ms");
  EXPECT_EQ(all.number, 12u);
  EXPECT_EQ(all.choice, (JunctionChoice{find_transition_method("hermite"), 450ms, 1.5}));
  EXPECT_EQ(parse_junction("1=overlap").choice, (JunctionChoice{find_transition_method("overlap"), {}, {}}));
  EXPECT_EQ(parse_junction("1=0ms").choice, (JunctionChoice{nullptr, 0ms, {}}));
  EXPECT_EQ(parse_junction(" 1 = x.5 , 60000ms ").choice, (JunctionChoice{nullptr, 60'000ms, 0.5}));
}

TEST(ParseJunction, ErrorsSayWhatIsExpected) {
  EXPECT_THAT(fault_of({"2:hermite"}), HasSubstr("'2:hermite': expected N=PART"));
  for (const char* number : {"0", "", "-1", "two", "1.5", "99999999999999999999"}) {
    EXPECT_THAT(fault_of({std::string(number) + "=hermite"}), HasSubstr("numbered from 1")) << number;
  }
  EXPECT_THAT(fault_of({"1=hermit"}), HasSubstr("'hermit' is not a method (taught, overlap, gap, "));
  EXPECT_THAT(fault_of({"1=hermit"}), HasSubstr("did you mean hermite?"));
  EXPECT_THAT(fault_of({"1=450"}), HasSubstr("'450': a duration needs its unit, as in 450ms"));
  EXPECT_THAT(fault_of({"1=0.4s"}), HasSubstr("as in 450ms"));
  for (const char* duration : {"4.5ms", "60001ms", "99999999999999999999ms", "1e3ms"}) {
    EXPECT_THAT(fault_of({std::string("1=") + duration}), HasSubstr("is not a duration of 0ms to 60000ms")) << duration;
  }
  for (const char* tempo : {"x0.2", "x4.1", "x-1", "x1,5", "x1.5.1", "x1e9"}) {
    EXPECT_NE(fault_of({std::string("1=") + tempo}), "no fault") << tempo;
  }
  EXPECT_THAT(fault_of({"1=x5"}), HasSubstr("'x5' is not a tempo from x0.25 to x4"));
  EXPECT_THAT(fault_of({"1="}), HasSubstr("a part is empty"));
  EXPECT_THAT(fault_of({"1=hermite,"}), HasSubstr("a part is empty"));
}

TEST(ParseJunction, EachPartAndEachJunctionIsGivenOnce) {
  EXPECT_THAT(fault_of({"1=hermite,sine"}), HasSubstr("'sine': there is a method already"));
  EXPECT_THAT(fault_of({"1=1ms,2ms"}), HasSubstr("'2ms': there is a duration already"));
  EXPECT_THAT(fault_of({"1=x1,x1"}), HasSubstr("'x1': there is a tempo already"));
  EXPECT_THAT(fault_of({"1=hermite", "2=x1", "1=450ms"}),
              HasSubstr("junction 1 is named twice; combine its parts: 1=PART,PART"));
}

RC_GTEST_PROP(ParseJunction, WhatIsWrittenIsReadAgain, ()) {
  JunctionChoice choice;
  const auto methods = transition_methods();
  if (*rc::gen::arbitrary<bool>()) choice.method = &methods[*rc::gen::inRange<std::size_t>(0, methods.size())];
  if (*rc::gen::arbitrary<bool>()) choice.duration = Milliseconds(*rc::gen::inRange(0, 60'001));
  if (*rc::gen::arbitrary<bool>()) choice.tempo = 0.25 + *rc::gen::inRange(0, 3'751) / 1000.0;
  RC_PRE(!choice.empty());
  const NumberedJunction read = parse_junction("7=" + to_string(choice));
  RC_ASSERT(read.number == 7u);
  RC_ASSERT(read.choice == choice);
}

}  // namespace
}  // namespace signweave
