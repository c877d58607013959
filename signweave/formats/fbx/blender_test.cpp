#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/fbx/fbx.h"
#include "signweave/motion/kinematics.h"

namespace signweave::fbx {
namespace {

namespace fs = std::filesystem;

struct BonePose {
  std::int64_t frame = 0;
  std::string bone;
  Eigen::Vector3d head;
  Eigen::Quaterniond turn;
};

/// Blender's own positions, in our space: its Z is up, its -Y front.
std::vector<BonePose> places_of_blender(const fs::path& path) {
  const Eigen::Quaterniond ours(Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
  std::istringstream in(read_file(path));
  std::vector<BonePose> places;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::vector<std::string> words;
    for (std::string word; std::getline(cells, word, ',');) words.push_back(word);
    if (words.size() != 9) throw std::runtime_error(line);
    std::vector<double> n;
    for (std::size_t i = 2; i < 9; ++i) n.push_back(std::stod(words[i]));
    places.push_back({.frame = std::stoll(words[0]),
                      .bone = words[1],
                      .head = ours * Eigen::Vector3d(n[0], n[1], n[2]),
                      .turn = ours * Eigen::Quaterniond(n[3], n[4], n[5], n[6])});
  }
  return places;
}

const fs::path kBlenderFolder = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "fbx";

// Blender rotates bones about themselves for another primary axis, so a bone's rotation is compared with its own in
// frame 0.
TEST(FbxOfBlender, EveryBoneOfEveryVariantIsWhereBlenderHasIt) {
  const std::vector<BonePose> places = places_of_blender(kBlenderFolder / "blender.csv");
  ASSERT_EQ(places.size(), 36u);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(kBlenderFolder)) {
    if (entry.path().extension() != ".fbx" || entry.path().filename().string().rfind("blender_", 0) != 0) continue;
    SCOPED_TRACE(entry.path().filename());
    ++files;
    const File file = read(entry.path(), {.take = "Body|first"});
    ASSERT_EQ(file.motion.frame_count(), 6);
    EXPECT_EQ(file.motion.rate(), (FrameRate{25, 1}));
    for (const BonePose& place : places) {
      const auto joint = file.motion.skeleton().find(place.bone);
      ASSERT_TRUE(joint) << place.bone;
      const auto index = static_cast<std::size_t>(*joint);
      const ModelPose pose = to_model_space(file.motion.skeleton(), file.motion.pose(place.frame));
      const ModelPose first = to_model_space(file.motion.skeleton(), file.motion.pose(0));
      EXPECT_LT((pose.positions[index].cast<double>() - place.head).norm(), 1e-5) << place.bone << place.frame;
      const auto start =
          std::find_if(places.begin(), places.end(), [&](const BonePose& one) { return one.bone == place.bone; });
      const Eigen::Quaterniond expected = place.turn * start->turn.conjugate();
      const Eigen::Quaterniond found = (pose.rotations[index] * first.rotations[index].conjugate()).cast<double>();
      EXPECT_LT(expected.angularDistance(found) * 180 / std::numbers::pi, 0.01) << place.bone << place.frame;
    }
  }
  EXPECT_EQ(files, 4);
}

TEST(FbxOfBlender, TakesAreFoundByNameAndNumber) {
  const fs::path path = kBlenderFolder / "blender_plain.fbx";
  const File first = read(path);
  ASSERT_FALSE(first.notices.empty());
  const File by_number = read(path, {.take = "2"});
  EXPECT_NE(first.take, by_number.take);
  EXPECT_TRUE(same_bits(read(path, {.take = by_number.take}).motion, by_number.motion));
  EXPECT_FALSE(same_bits(first.motion, by_number.motion));
}

}  // namespace
}  // namespace signweave::fbx
