// Atomic writing of glTF files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "signweave/core/atomic_file.h"
#include "signweave/core/error.h"
#include "signweave/drawing/test_person.h"
#include "signweave/formats/gltf/gltf.h"

namespace signweave {
namespace {

using testing::HasSubstr;

class GltfFile : public testing::Test {
 public:
  ~GltfFile() override { std::filesystem::remove_all(folder_); }

 protected:
  GltfFile() {
    std::string name = (std::filesystem::temp_directory_path() / "gltf_test.XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  std::filesystem::path folder_;
};

TEST_F(GltfFile, TheExtensionDeterminesTheFormat) {
  gltf::write(folder_ / "a.GLTF", moving_person(2), {});
  gltf::write(folder_ / "a.glb", moving_person(2), {});
  EXPECT_EQ(read_file(folder_ / "a.GLTF"), gltf::to_bytes(moving_person(2), {}, gltf::Container::text));
  EXPECT_EQ(read_file(folder_ / "a.glb"), gltf::to_bytes(moving_person(2), {}, gltf::Container::binary));
}

TEST_F(GltfFile, AnErrorLeavesTheOldFile) {
  std::ofstream(folder_ / "a.glb") << "old";
  Motion motion = moving_person(2);
  motion.pose(1).translations[0].x() = std::nanf("");
  try {
    gltf::write(folder_ / "a.glb", motion, {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.glb: frame 1: the translation"));
  }
  EXPECT_EQ(read_file(folder_ / "a.glb"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << "no temporary file is left";
  EXPECT_THROW(gltf::write(folder_ / "none" / "a.glb", moving_person(2), {}), Error);
}

}  // namespace
}  // namespace signweave
