#include "signweave/motion_db/access_mode.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

TEST(AccessMode, EveryPrintedTextParsesBack) {
  for (const char* text : {"full", "by_frame", "by_frame:64", "by_frame:1", "by_frame:4294967295", "by_joint",
                           "by_joint_and_frame", "by_joint_and_frame:253"}) {
    const std::optional<AccessMode> mode = parse_access_mode(text);
    ASSERT_TRUE(mode) << text;
    EXPECT_EQ(to_string(*mode), text);
  }
}

TEST(AccessMode, TheTextNamesKindAndFrames) {
  EXPECT_EQ(parse_access_mode("full"), (AccessMode{AccessMode::Kind::full, 0}));
  EXPECT_EQ(parse_access_mode("by_frame:7"), (AccessMode{AccessMode::Kind::by_frame, 7}));
  EXPECT_EQ(parse_access_mode("by_joint_and_frame"), (AccessMode{AccessMode::Kind::by_joint_and_frame, 0}));
}

TEST(AccessMode, AnyOtherTextIsRefused) {
  for (const char* text :
       {"", "Full", "full:1", "by_joint:1", "by_frame:", "by_frame:0", "by_frame:-1", "by_frame:+1", "by_frame: 1",
        "by_frame:1 ", "by_frame:1x", "by_frame:4294967296", "by_frame:1:2", "by_frame2", "by_fram", "by_joint_and"}) {
    EXPECT_EQ(parse_access_mode(text), std::nullopt) << '"' << text << '"';
  }
}

}  // namespace
}  // namespace signweave
