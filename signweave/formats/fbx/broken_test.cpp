#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/fbx/fbx.h"

namespace signweave::fbx {
namespace {

namespace fs = std::filesystem;

const fs::path kBrokenFbx = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "fbx_broken";
const fs::path kWholeFbx = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "fbx";

std::vector<fs::path> fbx_files_in(const fs::path& folder, const char* extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// x.expected next to x.fbx holds what follows "x.fbx:" in the message; a file without one fails here.
TEST(FbxBroken, EveryBrokenFileIsRefusedWithOneLine) {
  const std::vector<fs::path> files = fbx_files_in(kBrokenFbx, ".fbx");
  ASSERT_GE(files.size(), 70u);
  for (fs::path path : files) {
    SCOPED_TRACE(path.filename());
    std::string fault = "no fault";
    try {
      read(path);
    } catch (const Error& error) {
      fault = error.what();
    }
    EXPECT_EQ(fault.find('\n'), std::string::npos);
    const std::string name = path.string();
    ASSERT_EQ(fault.substr(0, name.size() + 1), name + ":") << fault;
    EXPECT_EQ(trimmed(std::string_view(fault).substr(name.size() + 1)),
              trimmed(read_file(path.replace_extension(".expected"))));
  }
}

TEST(FbxBroken, EveryExpectationHasItsFile) {
  for (fs::path path : fbx_files_in(kBrokenFbx, ".expected")) {
    EXPECT_TRUE(fs::exists(path.replace_extension(".fbx"))) << path;
  }
}

TEST(FbxBroken, ATruncatedFileIsRefused) {
  for (const char* name : {"arm.fbx", "arm_7400.fbx", "arm_7700.fbx"}) {
    const std::string bytes = read_file(kWholeFbx / name);
    ASSERT_NO_THROW(read_bytes("whole", bytes));
    const std::size_t last = bytes.find_last_not_of("\r\n\t ");
    for (std::size_t size = 0; size < last; ++size) {
      EXPECT_THROW(read_bytes("cut", std::string_view(bytes).substr(0, size)), Error) << name << ' ' << size;
    }
  }
}

// With every seventh byte changed in turn, the result is a motion or an Error.
TEST(FbxBroken, AFileWithAChangedByteIsHarmless) {
  for (const char* name : {"arm.fbx", "arm_7400.fbx", "arm_7700.fbx"}) {
    const std::string whole = read_file(kWholeFbx / name);
    for (std::size_t at = 0; at < whole.size(); at += 7) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ (at % 3 == 0 ? 0x80 : at % 3 == 1 ? 0x01 : 0xFF));
      try {
        EXPECT_GE(read_bytes("changed", bytes).motion.frame_count(), 1);
      } catch (const Error&) {
      }
    }
  }
}

}  // namespace
}  // namespace signweave::fbx
