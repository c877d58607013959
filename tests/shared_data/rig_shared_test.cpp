#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "signweave/formats/bvh/bvh.h"
#include "signweave/rig/rig_map.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;
using enum Part;

/// The joints of one exporter, identified in its files by eye. `@` is the side.
/// More than fifteen members: one per joint.
struct Expected {
  std::string files;  ///< the beginning of their paths, below bvh/
  std::string convention;
  std::string left, right;
  std::string pelvis, spine, chest, neck, head;
  std::string collar, arm, elbow, hand, thigh, knee, foot, toes;
  int fingers;          ///< per hand
  std::string knuckle;  ///< of the right index finger
};

std::vector<Expected> table() {
  const Expected hik = {"",     "MotionBuilder", "Left",      "Right", "Hips",     "Spine", "Spine3",
                        "Neck", "Head",          "@Shoulder", "@Arm",  "@ForeArm", "@Hand", "@UpLeg",
                        "@Leg", "@Foot",         "@ToeBase",  0,       ""};
  const Expected biovision = {"",      "Biovision", "Left",    "Right",     "Hips",   "Chest",  "Chest4",
                              "Neck",  "Head",      "@Collar", "@Shoulder", "@Elbow", "@Wrist", "@Hip",
                              "@Knee", "@Ankle",    "@Toe",    0,           ""};
  std::vector<Expected> all;
  const auto add = [&](const Expected& like, const std::string& files, auto change) {
    Expected one = like;
    one.files = files;
    change(one);
    all.push_back(one);
  };
  add(biovision, "animated-drawings/cmu1", [](Expected& one) {
    one.convention = "CMU with Biovision's names";
    one.spine = "lowerback";
    one.chest = "Chest2";
    one.neck = "lowerneck";
    one.fingers = 1;
  });
  add(hik, "animated-drawings/fair1", [](Expected& one) { one.fingers = 1; });
  add(hik, "animated-drawings/rokoko", [](Expected& one) {
    one.convention = "Rokoko";
    one.chest = "Spine2";
    one.fingers = 5;
    one.knuckle = "RightHandIndex1";
  });
  all.push_back({"bandai-namco", "Bandai-Namco", "L", "R", "Hips", "Spine", "Chest", "Neck", "Head", "Shoulder_@",
                 "UpperArm_@", "LowerArm_@", "Hand_@", "UpperLeg_@", "LowerLeg_@", "Foot_@", "Toes_@", 0, ""});
  add(biovision, "ksl-always", [](Expected& one) {
    one.fingers = 5;
    one.knuckle = "RightFinger1";
  });
  for (const char* file : {"pybvh/bvh_example", "pybvh/standard_skeleton"}) add(hik, file, [](Expected&) {});
  add(biovision, "pybvh/bvh_test2", [](Expected&) {});
  add(hik, "pybvh/bvh_test3", [](Expected& one) {
    one.toes = "@ForeFoot";
    one.fingers = 5;
    one.knuckle = "RightHandIndex1";
  });
  add(hik, "pybvh/cmu", [](Expected& one) {
    one.convention = "CMU with MotionBuilder's names";
    one.spine = "LowerBack";
    one.chest = "Spine1";
    one.fingers = 2;
    one.knuckle = "RightHandIndex1";
  });
  add(hik, "signon-thanks", [](Expected& one) {
    one.convention = "Mixamo";
    one.chest = "Spine2";
    for (std::string* name : {&one.pelvis, &one.spine, &one.chest, &one.neck, &one.head, &one.collar, &one.arm,
                              &one.elbow, &one.hand, &one.thigh, &one.knee, &one.foot, &one.toes}) {
      *name = "mixamorig_" + *name;
    }
    one.fingers = 5;
    one.knuckle = "mixamorig_RightHandIndex1";
  });
  // Files without a body, for which the expected result is only that nothing fails.
  all.push_back(
      {"pybvh/full_precision", "", "Left", "Right", "Hips", "", "", "", "Head", "", "", "", "", "", "", "", "", 0, ""});
  all.push_back({"pybvh/rotation_first", "", "Left", "Right", "Hips", "Spine", "", "", "Head", "", "", "", "", "", "",
                 "", "", 0, ""});
  return all;
}

TEST(RigOfRealFiles, IsAsIdentifiedByEye) {
  const fs::path root = fs::path(SIGNWEAVE_SHARED_DATA) / "bvh";
  std::size_t files = 0;
  std::vector<bool> seen(table().size());
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".bvh") continue;
    ++files;
    const std::string name = fs::relative(entry.path(), root).string();
    SCOPED_TRACE(name);
    const std::vector<Expected> rows = table();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const Expected& one) { return name.starts_with(one.files); });
    ASSERT_NE(row, rows.end()) << "a file that the table does not know";
    seen[static_cast<std::size_t>(row - rows.begin())] = true;
    const bvh::File file = bvh::read(entry.path(), {});
    const Skeleton& skeleton = file.motion.skeleton();
    const RigMap map = map_rig(file.motion);
    EXPECT_EQ(map.convention, row->convention);
    EXPECT_FALSE(map.sides_swapped);
    const auto expect = [&](Part part, const std::string& joint) {
      EXPECT_EQ(map.has(part) ? skeleton.joint(map[part].joint).name : "", joint) << name_of(part);
    };
    expect(pelvis, row->pelvis);
    expect(spine, row->spine);
    expect(chest, row->chest);
    expect(neck, row->neck);
    expect(head, row->head);
    if (row->hand.empty()) continue;
    for (const Side side : kSides) {
      const auto sided = [&](std::string joint) {
        return joint.replace(joint.find('@'), 1, side == Side::left ? row->left : row->right);
      };
      expect(of(side, left_clavicle), sided(row->collar));
      expect(of(side, left_upper_arm), sided(row->arm));
      expect(of(side, left_forearm), sided(row->elbow));
      expect(of(side, left_hand), sided(row->hand));
      expect(of(side, left_thigh), sided(row->thigh));
      expect(of(side, left_shin), sided(row->knee));
      expect(of(side, left_foot), sided(row->foot));
      expect(of(side, left_toes), sided(row->toes));
      const auto fingers = std::count_if(kFingers.begin(), kFingers.end(), [&](Finger finger) {
        return map.has(finger_part(side, finger, FingerPoint::proximal)) &&
               map.has(finger_part(side, finger, FingerPoint::tip));
      });
      EXPECT_EQ(fingers, row->fingers);
      EXPECT_GT(map[of(side, left_hand)].confidence, 0.65f);
    }
    expect(finger_part(Side::right, Finger::index, FingerPoint::proximal), row->knuckle);
  }
  EXPECT_GE(files, 79u);
  EXPECT_THAT(seen, testing::Each(true)) << "every exporter was there";
}

/// The left of a mirrored body is where the names say right; every real body must show it.
TEST(RigOfRealFiles, AMirroredBodyHasItsSidesSwapped) {
  const fs::path root = fs::path(SIGNWEAVE_SHARED_DATA) / "bvh";
  std::size_t bodies = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".bvh") continue;
    bvh::ReadOptions mirrored;
    mirrored.mirror = true;
    const RigMap map = map_rig(bvh::read(entry.path(), mirrored).motion);
    if (!map.has(left_hand) || !map.has(right_hand)) continue;
    const RigMap plain = map_rig(bvh::read(entry.path(), {}).motion);
    ++bodies;
    EXPECT_TRUE(map.sides_swapped) << entry.path();
    EXPECT_EQ(map[left_hand].joint, plain[right_hand].joint);
    EXPECT_EQ(map[right_foot].joint, plain[left_foot].joint);
  }
  EXPECT_GE(bodies, 77u);
}

/// From the body's shape alone: every part found is the one found by name.
TEST(RigOfRealFiles, IsTheSameByShapeIfTheBodyIsComplete) {
  const fs::path root = fs::path(SIGNWEAVE_SHARED_DATA) / "bvh";
  std::size_t bodies = 0;
  for (const char* name :
       {"ksl-always/always.bvh", "animated-drawings/rokoko/jesse_dance.bvh", "signon-thanks/NGT Thanks.bvh",
        "animated-drawings/fair1/wave_hello.bvh", "bandai-namco/dataset-1_bow_active_001.bvh", "pybvh/bvh_test2.bvh"}) {
    SCOPED_TRACE(name);
    const bvh::File file = bvh::read(root / name, {});
    const Skeleton& skeleton = file.motion.skeleton();
    std::vector<Joint> joints(skeleton.joints().begin(), skeleton.joints().end());
    for (Joint& joint : joints) joint.name = "x";
    Motion nameless(
        std::make_shared<const Skeleton>(joints, std::vector<Tip>(skeleton.tips().begin(), skeleton.tips().end())),
        file.motion.rate(), 0);
    for (std::int64_t frame = 0; frame < file.motion.frame_count(); ++frame) nameless.append(file.motion.pose(frame));
    const RigMap by_name = map_rig(file.motion);
    const RigMap by_shape = map_rig(nameless);
    for (std::size_t i = 0; i < kPartCount; ++i) {
      const auto part = static_cast<Part>(i);
      if (i >= kNamedParts && by_name.has(part) && !by_shape.has(part)) continue;  // a single thumb
      EXPECT_EQ(by_shape[part].joint, by_name[part].joint) << name_of(part);
      if (by_shape.has(part)) {
        EXPECT_LT(by_shape[part].confidence, by_name[part].confidence) << name_of(part);
      }
    }
    ++bodies;
  }
  EXPECT_EQ(bodies, 6u);
}

}  // namespace
}  // namespace signweave
