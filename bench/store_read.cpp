// Random warm reads from a stored motion, against a bare memcpy of the same numbers from memory.
//
// Prints lines "name value unit yardstick ratio goal": microseconds a read (the median of interleaved rounds), those of
// the memcpy, their ratio, and the ratio that we want ("-": none set). Arguments: further access modes to measure.

#include <malloc.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>

#include "bench/measure.h"
#include "signweave/motion_db/motion_db.h"

namespace {

using namespace signweave;

constexpr int kJoints = 53;                     // a body with fingers
constexpr std::int64_t kFrames = 44 * 60 * 60;  // the paper's 44 minutes, at 60 frames a second
constexpr std::int64_t kAsked = 64;             // a sign
constexpr int kRounds = 31;
constexpr int kReads = 200;

Motion long_motion() {
  std::vector<Joint> joints;
  for (int i = 0; i < kJoints; ++i) {
    joints.push_back(
        {.name = "joint " + std::to_string(i), .parent = i - 1, .offset = {0, 0.1f, 0}, .translated = i == 0});
  }
  Motion motion(std::make_shared<const Skeleton>(std::move(joints), std::vector<Tip>{}), FrameRate{60, 1}, kFrames);
  std::mt19937 random(1);
  for (std::int64_t frame = 0; frame < kFrames; ++frame) {
    for (Eigen::Quaternionf& rotation : motion.pose(frame).rotations) {
      rotation.coeffs() = Eigen::Vector4f::Constant(static_cast<float>(random()) * 1e-9f);
    }
  }
  return motion;
}

struct Row {
  std::string name;
  motion_db::StoredMotion stored;
  std::int64_t asked = kAsked;
  JointSet joints;
  std::string goal = "-";
  std::vector<double> read = {};
  std::vector<double> copy = {};
};

/// Microseconds that one of `kReads` calls takes.
template <typename Action>
double microseconds(int calls, const Action& action) {
  return 1e6 * bench::seconds_of(action, calls);
}

float sink = 0;  // so that no copy is optimised away

void measure(Row& row, const kv::KvStore& store, const Motion& motion, std::mt19937& random) {
  const auto snapshot = store.read();
  const auto skeleton = motion_db::read_skeleton(*snapshot, row.stored);
  std::uniform_int_distribution<std::int64_t> start(0, kFrames - row.asked);
  const bool slow = row.asked > kAsked || motion_db::packet_count(row.stored) <= kJoints;
  const int calls = slow ? 1 : kReads;
  row.read.push_back(microseconds(calls, [&] {
    const std::int64_t begin = start(random);
    const Motion part = motion_db::read(*snapshot, row.stored, skeleton, {begin, begin + row.asked}, row.joints);
    sink += part.rotations().back().x();
  }));
  std::vector<Eigen::Quaternionf> rotations(static_cast<std::size_t>(row.asked) * kJoints);
  std::vector<Eigen::Vector3f> translations(static_cast<std::size_t>(row.asked));
  row.copy.push_back(microseconds(calls, [&] {
    const auto begin = static_cast<std::size_t>(start(random));
    if (row.joints.empty()) {
      std::memcpy(static_cast<void*>(rotations.data()), motion.rotations().data() + begin * kJoints,
                  rotations.size() * sizeof(rotations[0]));
      std::memcpy(static_cast<void*>(translations.data()), motion.translations().data() + begin,
                  translations.size() * sizeof(translations[0]));
    } else {
      for (std::size_t frame = 0; frame < translations.size(); ++frame) {
        for (const JointIndex joint : row.joints) {
          const std::size_t at = static_cast<std::size_t>(joint);
          std::memcpy(static_cast<void*>(&rotations[frame * kJoints + at]),
                      motion.rotations().data() + (begin + frame) * kJoints + at, sizeof(rotations[0]));
        }
      }
    }
    sink += rotations.back().x();
  }));
}

/// One access mode, in a database of its own: more motion beside it would only cost the cache.
void run(const std::string& text, const Motion& motion) {
  const auto mode = parse_access_mode(text);
  if (!mode) throw Error(ErrorCode::bad_input, "'" + text + "' is no access mode");
  const auto folder = std::filesystem::temp_directory_path() / "signweave_bench_store_read";
  std::filesystem::remove_all(folder);
  kv::create(folder, kv::engines().front());
  {
    const auto store = kv::open(folder, kv::Access::read_write);
    const auto stored = motion_db::describe(motion, *mode, 1);
    const std::string name = to_string(stored.mode);
    const double put = microseconds(1, [&] { motion_db::put(*store, stored, motion); });
    std::printf("put_whole/%s %.1f ms - - -\n", name.c_str(), put / 1e3);
    const JointSet arm = {10, 11, 12, 13, 14, 15, 16, 17};
    Row rows[] = {
        {.name = "read_whole/" + name, .stored = stored, .asked = kFrames, .joints = {}},
        {.name = "read_64_frames/" + name, .stored = stored, .joints = {}, .goal = text == "by_frame" ? "<= 5" : "-"},
        {.name = "read_64_frames_of_8_joints/" + name, .stored = stored, .joints = arm},
    };
    std::mt19937 random(2);
    for (int round = 0; round < kRounds; ++round) {
      for (Row& row : rows) {
        if (row.asked == kAsked || round < 5) measure(row, *store, motion, random);
      }
    }
    for (const Row& row : rows) {
      const double read = bench::median(row.read);
      const double copy = bench::median(row.copy);
      std::printf("%s %.2f us %.2f %.2f %s\n", row.name.c_str(), read, copy, read / copy, row.goal.c_str());
    }
  }
  std::filesystem::remove_all(folder);
}

}  // namespace

int main(int count, char** arguments) {
  // A read makes a new Motion. Left alone, glibc gives its memory back to the system after each, and half of what we
  // measured would be page faults.
  ::mallopt(M_TRIM_THRESHOLD, 1 << 28);
  ::mallopt(M_MMAP_THRESHOLD, 1 << 25);
  try {
    std::vector<std::string> modes = {"by_frame", "by_joint_and_frame", "by_frame:1"};
    modes.insert(modes.end(), arguments + 1, arguments + count);
    const Motion motion = long_motion();
    for (const std::string& mode : modes) run(mode, motion);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "store_read: %s\n", error.what());
    return 1;
  }
  return sink == 0.5f ? 2 : 0;
}
