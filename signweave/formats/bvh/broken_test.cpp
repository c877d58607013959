#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/bvh/bvh.h"

namespace signweave::bvh {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder, const char* extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string fault_in_file(const fs::path& path) {
  try {
    read(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "no fault";
}

const fs::path kBrokenFolder = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "bvh_broken";

// x.expected next to x.bvh holds what follows "x.bvh:" in the message; a file without one fails here.
TEST(BvhBroken, EveryBrokenFileIsRefusedWithItsLineAndARepair) {
  const std::vector<fs::path> files = files_in(kBrokenFolder, ".bvh");
  ASSERT_GE(files.size(), 50u);
  for (fs::path path : files) {
    SCOPED_TRACE(path.filename());
    const std::string fault = fault_in_file(path);
    const std::string text = read_file(path);
    std::string by_text;
    try {
      read_text(path.string(), text);
    } catch (const Error& error) {
      by_text = error.what();
    }
    EXPECT_EQ(fault, by_text);
    EXPECT_EQ(fault.find('\n'), std::string::npos);
    const std::string name = path.string();
    const std::string expected = read_file(path.replace_extension(".expected"));
    EXPECT_EQ(fault, name + ":" + std::string(trimmed(expected)));
  }
}

TEST(BvhBroken, EveryExpectationHasItsFile) {
  for (fs::path path : files_in(kBrokenFolder, ".expected"))
    EXPECT_TRUE(fs::exists(path.replace_extension(".bvh"))) << path;
}

// A truncated file must be refused, and must never crash or be accepted as complete, unless only blanks are lost.
TEST(BvhBroken, ATruncatedFileIsRefused) {
  const std::string text = read_file(fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "bvh" / "signer.bvh");
  ASSERT_NO_THROW(read_text("whole", text));
  const std::size_t last_number = text.find_last_of(" \t", text.size() - 2) + 1;
  for (std::size_t size = 0; size <= last_number; ++size) {
    EXPECT_THROW(read_text("cut", std::string_view(text).substr(0, size)), Error) << size;
  }
}

}  // namespace
}  // namespace signweave::bvh
