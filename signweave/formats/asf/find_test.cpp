#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "signweave/formats/asf/asf.h"
#include "signweave/formats/asf/test_text.h"

namespace signweave::asf {
namespace {

namespace fs = std::filesystem;

/// A separate folder with empty files.
class AsfFind : public testing::Test {
 public:
  ~AsfFind() override { fs::remove_all(folder_); }

 protected:
  AsfFind() : folder_(fs::path(testing::TempDir()) / ("asf_find_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void put(const std::string& name, const std::string& text = "") { std::ofstream(folder_ / name) << text; }
  std::string found(const std::string& amc) { return skeleton_of(folder_ / amc).filename().string(); }

  fs::path folder_;
};

TEST_F(AsfFind, TheSameStemThenTheStemUpToAnUnderscoreThenTheOnlyOne) {
  put("only.asf");
  EXPECT_EQ(found("07_01.amc"), "only.asf");
  put("07.asf");
  EXPECT_EQ(found("07_01.amc"), "07.asf");
  put("07_01.ASF");
  EXPECT_EQ(found("07_01.amc"), "07_01.ASF");
  EXPECT_EQ(found("07_02.amc"), "07.asf");
  EXPECT_EQ(found("07_01_part_2.amc"), "07_01.ASF");
  EXPECT_EQ(skeleton_of(folder_ / "07_02.amc"), folder_ / "07.asf");
}

TEST_F(AsfFind, WithoutASkeletonTheErrorListsTheNamesThatWereTried) {
  const auto fault = [&] {
    try {
      skeleton_of(folder_ / "07_01.amc");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::not_found);
      return std::string(error.what());
    }
    return std::string("no fault");
  };
  const std::string head = (folder_ / "07_01.amc").string() +
                           ": no skeleton belongs to it: looked for 07_01.asf, 07.asf in " + folder_.string();
  fs::create_directory(folder_ / "07.asf");
  EXPECT_EQ(fault(), head + ", where is no .asf file");
  put("a.asf");
  put("b.asf");
  EXPECT_EQ(fault(), head + ", where are 2 other .asf files");
}

TEST_F(AsfFind, TheSkeletonThatIsNamedIsRead) {
  put("a.asf", one_bone({.dof = "rx"}));
  put("07.asf", "nonsense");
  put("07.amc", "1\nroot 0 0 0\nbone 5\n");
  EXPECT_THROW(read(folder_ / "07.amc"), Error);
  const File file = read(folder_ / "07.amc", {.skeleton = folder_ / "a.asf", .unit = 1.0});
  EXPECT_EQ(file.skeleton, folder_ / "a.asf");
  EXPECT_EQ(file.motion.frame_count(), 1);
}

TEST_F(AsfFind, AMissingRecordingIsReportedBeforeItsSkeleton) {
  try {
    read(folder_ / "none.amc");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_NE(std::string(error.what()).find("none.amc: cannot be read"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace signweave::asf
