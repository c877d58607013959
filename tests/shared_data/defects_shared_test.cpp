// The defects of the real files, each verified by eye: on contact sheets of the reported frames, and in the numbers if
// nothing is visible.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "signweave/features/defects.h"
#include "signweave/formats/bvh/bvh.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

/// "T-pose [0, 42)" for each defect, in order.
std::vector<std::string> defects_of(const fs::path& path, const bvh::ReadOptions& options = {}) {
  const Motion motion = bvh::read(path, options).motion;
  std::vector<std::string> result;
  for (const Defect& defect : find_defects(motion, map_rig(motion))) {
    result.push_back(std::string(name_of(defect.kind)) + " [" + std::to_string(defect.frames.begin) + ", " +
                     std::to_string(defect.frames.end) + ")");
  }
  return result;
}

TEST(SharedDefects, EveryFileHasItsKnownDefects) {
  const std::map<std::string, std::vector<std::string>> known = {
      {"always.bvh", {"T-pose [0, 1)"}},
      {"cmu_12_01_walk.bvh", {"T-pose [0, 1)"}},
      {"standard_skeleton.bvh", {"T-pose [0, 1)"}},
      // 3.6 cm would be about right; the reader only considers 2.54 and 5.64 and reports an unusual stature.
      {"dab.bvh", {"T-pose [0, 42)", "scale [0, 0)"}},
      {"zombie.bvh", {"T-pose [0, 35)", "scale [0, 0)"}},
      {"jumping.bvh", {"T-pose [0, 143)", "scale [0, 0)"}},
      // The hands and neck of this suit have one value in all frames.
      {"jesse_dance.bvh", {"frozen joint [0, 0)"}},
      // The avatars' idle arm (NGT) and some finger joints (VGT) have one value in all frames; all three roots are
      // permuted.
      {"ISL Thanks.bvh", {"permuted root [0, 0)"}},
      {"NGT Thanks.bvh", {"frozen joint [0, 0)", "permuted root [0, 0)"}},
      {"VGT Thanks.bvh", {"frozen joint [0, 0)", "permuted root [0, 0)"}},
  };
  std::size_t files = 0;
  std::size_t found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SIGNWEAVE_SHARED_DATA) / "bvh")) {
    if (entry.path().extension() != ".bvh") continue;
    SCOPED_TRACE(entry.path().string());
    ++files;
    const auto expected = known.find(entry.path().filename().string());
    found += expected != known.end() ? 1u : 0u;
    EXPECT_EQ(defects_of(entry.path()), expected == known.end() ? std::vector<std::string>() : expected->second);
  }
  EXPECT_GE(files, 60u);
  EXPECT_EQ(found, known.size());
}

TEST(SharedDefects, AFixedRootIsNotADefect) {
  const fs::path path = fs::path(SIGNWEAVE_SHARED_DATA) / "bvh/signon-thanks/ISL Thanks.bvh";
  EXPECT_TRUE(defects_of(path, {.root_unit = 1.0, .root_columns = bvh::RootColumns::rotation_first}).empty());
}

}  // namespace
}  // namespace signweave
