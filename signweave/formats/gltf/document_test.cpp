#include "signweave/formats/gltf/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/core/error.h"
#include "signweave/formats/gltf/test_reader.h"

namespace signweave {
namespace {

using testing::HasSubstr;
using testing_gltf::elements;

TEST(GltfDocument, FramesWithEqualTimesAreRefused) {
  EXPECT_EQ(gltf::key_times({30'000, 1'001}, 3)[2], static_cast<float>(2 * 1001 / 30'000.0));
  EXPECT_NO_THROW(gltf::key_times({100, 1}, 1'000'000));  // nearly three hours
  try {
    gltf::key_times({1'000'000, 1}, (1 << 24) + 3);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_THAT(error.what(), HasSubstr("glTF cannot distinguish its time"));
  }
}

TEST(GltfDocument, RefusesToExceedItsLimit) {
  gltf::Document document(40, "too large for a test");
  const std::vector<float> numbers(8, 1.0f);
  document.scalars(numbers);
  EXPECT_NO_THROW(document.scalars(std::span(numbers).first(2)));
  try {
    document.scalars(std::span(numbers).first(1));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_STREQ(error.what(), "too large for a test");
  }
}

TEST(GltfDocument, JointsBeyondAByteTakeTwo) {
  gltf::Document document(1000, "");
  const std::vector<int> joints = {0, 256, 65'000};
  const int index = document.joints(joints);
  EXPECT_EQ(elements(document.model(), index)[2][0], 65'000);
}

}  // namespace
}  // namespace signweave
