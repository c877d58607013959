#include <gtest/gtest.h>

#include "signweave/formats/fbx.h"

namespace signweave::fbx {
namespace {

// Only in a build with the option SIGNWEAVE_FBX off.
TEST(FbxAbsent, ReadingSaysHowToBuildWithIt) {
  EXPECT_FALSE(built_in());
  try {
    read("signer.fbx");
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_STREQ(error.what(),
                 "signer.fbx: this build does not read FBX; build it with -DSIGNWEAVE_FBX=ON and "
                 "libassimp-dev");
  }
}

}  // namespace
}  // namespace signweave::fbx
