#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/gltf/read.h"

namespace signweave::gltf {
namespace {

namespace fs = std::filesystem;

const fs::path kBrokenFolder = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "gltf_broken";

bool is_gltf(const fs::path& path) {
  return path.extension() == ".glb" || path.extension() == ".gltf";
}

std::string fault_of_file(const fs::path& path) {
  try {
    read(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

// x.expected next to x.glb or x.gltf holds what follows the file's name and a colon in the message; a file without one
// fails here.
TEST(GltfBroken, EveryBrokenFileIsRefusedWithItsPlaceAndARepair) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kBrokenFolder)) {
    if (is_gltf(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 60u);
  for (fs::path path : files) {
    SCOPED_TRACE(path.filename());
    std::string fault = fault_of_file(path);
    EXPECT_EQ(fault.find('\n'), std::string::npos);
    EXPECT_LT(fault.size() - path.string().size(), 200u) << fault;
    const std::string name = path.string();
    const std::string folder = kBrokenFolder.string();
    for (std::size_t at = fault.find(folder, name.size()); at != fault.npos; at = fault.find(folder, name.size())) {
      fault.replace(at, folder.size(), "FOLDER");
    }
    const std::string expected = read_file(path.replace_extension(".expected"));
    ASSERT_TRUE(fault.starts_with(name + ":")) << fault;
    EXPECT_EQ(trimmed(std::string_view(fault).substr(name.size() + 1)), trimmed(expected));
  }
}

TEST(GltfBroken, EveryExpectationHasItsFile) {
  for (const auto& entry : fs::directory_iterator(kBrokenFolder)) {
    fs::path path = entry.path();
    if (path.extension() != ".expected") continue;
    EXPECT_TRUE(fs::exists(path.replace_extension(".glb")) || fs::exists(path.replace_extension(".gltf"))) << path;
  }
}

}  // namespace
}  // namespace signweave::gltf
