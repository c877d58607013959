#include "signweave/motion_db/packet.h"

#include <gtest/gtest.h>

#include <sstream>

#include "signweave/core/atomic_file.h"
#include "signweave/motion_db/quantise.h"

namespace signweave::motion_db {
namespace {

/// The motion of the worked example in docs/store.md.
Motion example() {
  auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{.name = "Hips", .parent = kNoJoint, .offset = Eigen::Vector3f(0, 1, 0), .translated = true},
                         {.name = "Spine", .parent = 0, .offset = Eigen::Vector3f(0, 0.25f, 0), .translated = false}},
      std::vector<Tip>{{.joint = 1, .offset = Eigen::Vector3f(0, 0.5f, 0)}});
  Motion motion(std::move(skeleton), FrameRate{60, 1}, 3);
  motion.pose(1).rotations[1] = Eigen::Quaternionf(0.6f, 0.8f, -0.0f, 0);  // w, x, y, z
  motion.pose(1).translations[0] = Eigen::Vector3f(0.5f, 1, -2);
  motion.pose(2).translations[0] = Eigen::Vector3f(0.5f, 1, -2.5f);
  motion.add_track({"smile", {0, 0.5f, 1}});
  return motion;
}

std::string hex(ByteSpan bytes) {
  std::ostringstream out;
  for (const std::byte byte : bytes) {
    constexpr char kDigits[] = "0123456789abcdef";
    out << kDigits[static_cast<int>(byte) >> 4] << kDigits[static_cast<int>(byte) & 15];
  }
  return out.str();
}

/// The hexadecimal digits of the block ```hex NAME of docs/store.md, without offsets (before ':') and remarks (after
/// ';').
std::string documented(const std::string& name) {
  std::istringstream text(read_file(SIGNWEAVE_SOURCE_DIR "/docs/store.md"));
  std::string digits;
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = line == "```hex " + name;
    } else if (inside) {
      const std::size_t colon = line.find(':');
      for (const char c : line.substr(colon + 1, line.find(';') - colon - 1)) {
        if (c != ' ') digits += c;
      }
    }
  }
  return digits;
}

TEST(StoreDocument, ItsBytesMatchTheEncoder) {
  const Motion motion = example();
  const StoredMotion stored = describe(motion, {AccessMode::Kind::by_frame, 2}, 7);
  const Record packet{.kind = RecordKind::packet, .part = kAllJoints, .block = 0, .frames = {0, 2}};
  EXPECT_EQ(documented("key"), hex(key_of(7, packet)));
  EXPECT_EQ(documented("packet"), hex(encode_packet(7, motion, packet)));
  EXPECT_EQ(documented("skeleton"), hex(encode_skeleton(7, motion.skeleton())));
  const Record track{.kind = RecordKind::tracks, .part = 0, .block = 0, .frames = {0, 3}};
  EXPECT_EQ(documented("tracks"), hex(encode_tracks(7, motion.tracks(), track)));
  ByteWriter out;
  encode(stored, out);
  EXPECT_EQ(documented("descriptor"), hex(out.bytes()));
}

TEST(StoreDocument, ItsCompactBytesMatchTheEncoder) {
  const Motion motion = quantise(example(), 0.001f);
  const StoredMotion stored = describe(motion, {AccessMode::Kind::by_frame, 16}, 7, 0.001f);
  const Record packet{.kind = RecordKind::packet, .part = kAllJoints, .block = 0, .frames = {0, 3}};
  EXPECT_EQ(documented("compact"), hex(encode_packet(7, motion, packet, packing_of(stored))));
  const Record joint{.kind = RecordKind::packet, .part = 1, .block = 0, .frames = {0, 3}};
  EXPECT_EQ(documented("compact of one joint"), hex(encode_packet(7, motion, joint, packing_of(stored))));
  ByteWriter out;
  encode(stored, out);
  EXPECT_EQ(documented("compact descriptor"), hex(out.bytes()));
}

TEST(Packet, KeysAreOrderedAsRecordsAreWritten) {
  StoredMotion stored;
  stored.frames = 100'000;
  stored.joints = 300;
  stored.mode = {AccessMode::Kind::by_joint_and_frame, 300};
  Key before = key_of(0, {});
  for (const std::uint64_t generation : {1, 255, 256}) {
    stored.generation = generation;
    const Key skeleton = key_of(generation, {});
    EXPECT_LT(before, skeleton);
    before = skeleton;
    for_each_packet(stored, {0, stored.frames}, {}, [&](const Record& record) {
      const Key key = key_of(generation, record);
      ASSERT_LT(before, key);
      before = key;
    });
  }
}

TEST(Packet, AWidthIsThatOfOneJointOrOfAll) {
  const Motion motion = example();
  const auto width = [&](std::uint16_t part) {
    return width_of(motion.skeleton(), {.kind = RecordKind::packet, .part = part, .block = 0, .frames = {}});
  };
  EXPECT_EQ(width(kAllJoints), (Width{2, 1}));
  EXPECT_EQ(width(0), (Width{1, 1}));
  EXPECT_EQ(width(1), (Width{1, 0}));
  EXPECT_EQ(width(kAllJoints).frame_bytes(), 44u);
}

}  // namespace
}  // namespace signweave::motion_db
