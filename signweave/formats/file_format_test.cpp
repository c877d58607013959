#include "signweave/formats/file_format.h"

#include <gtest/gtest.h>

#include <set>

#include "signweave/formats/motion_file.h"
#include "signweave/formats/write_file.h"

namespace signweave {
namespace {

TEST(FileFormats, AreFoundByTheLongestExtensionInAnyCase) {
  EXPECT_EQ(file_format("a/b.BVH")->name, "BVH");
  EXPECT_EQ(file_format("meteo.face.csv")->kind, FileKind::face);
  EXPECT_EQ(file_format("meteo.csv")->kind, FileKind::product);
  EXPECT_EQ(file_format("meteo.txt"), nullptr);
  EXPECT_EQ(file_format(".bvh"), nullptr);
  EXPECT_EQ(file_format("folder.bvh/meteo"), nullptr);
}

TEST(FileFormats, HaveEachExtensionOnceAndSayWhatTheyHold) {
  std::set<std::string_view> extensions;
  for (const FileFormat& format : file_formats()) {
    EXPECT_TRUE(extensions.insert(format.extension).second) << format.extension;
    EXPECT_TRUE(format.reads || format.writes()) << format.extension;
    EXPECT_FALSE(format.name.empty() || format.holds.empty() || format.lost.empty() || format.media_type.empty());
    EXPECT_EQ(format.extension, file_format(std::string("x") + std::string(format.extension))->extension);
  }
}

TEST(FileFormats, ThatAreWrittenAndNoOthersHaveAWriter) {
  for (const FileFormat& format : file_formats()) {
    try {
      file_text(format.extension, {}, "x");
      FAIL() << format.extension;
    } catch (const Error& error) {
      // A writer asks for its content; without a writer the extension is wrong.
      EXPECT_EQ(error.code(), format.writes() ? ErrorCode::not_found : ErrorCode::bad_input) << error.what();
    }
  }
}

TEST(MotionFiles, OfEveryReadableExtensionHaveAReader) {
  for (const FileFormat& format : file_formats()) {
    if (format.kind != FileKind::motion || !format.reads) continue;
    try {
      motion_file::read(std::string("no such file") + std::string(format.extension));
      FAIL() << format.extension;
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::unsupported) << error.what();
    }
  }
}

TEST(MotionFiles, SayWhichOptionsTheyPassOver) {
  const std::filesystem::path file = std::filesystem::path(SIGNWEAVE_SOURCE_DIR) / "testdata/bvh/signer.bvh";
  motion_file::ReadOptions options;
  options.take = "walk";
  options.unit = 0.01;
  const motion_file::File read = motion_file::read(file, options);
  EXPECT_EQ(read.format, "BVH");
  EXPECT_TRUE(read.layout);
  ASSERT_FALSE(read.notices.empty());
  EXPECT_EQ(read.notices.back().text, "take does not apply to BVH files and was ignored");
  EXPECT_EQ(motion_file::given_options(file, options), "unit=0.01");
}

TEST(MotionFiles, GivenOptionsAreReadBack) {
  motion_file::ReadOptions options;
  options.unit = 0.0254;
  options.rate = FrameRate{30'000, 1001};
  options.take = "walk;unit=3=x";
  const std::string line = motion_file::given_options("a.glb", options);
  const motion_file::ReadOptions back = motion_file::options_in(line);
  EXPECT_EQ(back.unit, options.unit);
  EXPECT_EQ(back.rate, options.rate);
  EXPECT_EQ(back.take, options.take);
  EXPECT_EQ(motion_file::given_options("a.glb", back), line);
  EXPECT_EQ(motion_file::given_options("a.glb", motion_file::options_in("")), "");
}

}  // namespace
}  // namespace signweave
