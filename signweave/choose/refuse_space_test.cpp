#include "signweave/choose/refuse_space.h"

#include <gtest/gtest.h>

#include "signweave/core/error.h"

namespace signweave {
namespace {

TEST(RefuseSpace, OnlyWhatAsksForAChange) {
  for (const char* text : {"A", "A{size 1; repeat 1; move 0/0/0}", "[A | weak: B]"}) {
    EXPECT_NO_THROW(refuse_space(parse_utterance(text))) << text;
  }
  for (const char* text : {"A B{to @left}", "A{@a = @left}", "{slow: A}", "A{mirrored}", "A{plural}"}) {
    EXPECT_THROW(refuse_space(parse_utterance(text)), Error) << text;
  }
}

}  // namespace
}  // namespace signweave
