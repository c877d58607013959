// Compact packets: their size, their largest error, how fast they are written, and what it costs to unpack two
// neighbouring frames and interpolate between them, against a plain nlerp of frames in memory.
//
// Prints lines "name value unit yardstick ratio goal". Motions: two minutes of the demo corpus, and the files with
// fingers under ../shared/data/bvh (others without a goal). --quick: less of the demo, fewer rounds.

#include <algorithm>
#include <ctime>
#include <map>
#include <random>

#include "bench/measure.h"
#include "demo/corpus.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/motion_db/compact.h"
#include "signweave/motion_db/quantise.h"

namespace {

using namespace signweave;
namespace fs = std::filesystem;

constexpr float kTolerance = 1e-4f;   // metres
constexpr std::size_t kFingers = 40;  // a skeleton with at least this many joints has fingers
constexpr float kMillimetres = 1000.0f;
bool quick = false;

struct Named {
  std::string name;
  Motion motion;
};

Motion without_tracks(Motion motion) {
  motion.take_tracks();
  keep_hemisphere(motion);
  return motion;
}

/// A motion stored in its own database.
struct Stored {
  bench::Folder folder{"compact"};
  std::unique_ptr<kv::KvStore> store;
  motion_db::StoredMotion stored;
  double seconds = 0;  ///< on one core, to quantise and put

  Stored(const Motion& motion, AccessMode mode, float tolerance) {
    kv::create(folder.path() / "db", kv::engines().front());
    store = kv::open(folder.path() / "db", kv::Access::read_write);
    const std::clock_t begin = std::clock();
    const Motion quantised = tolerance > 0 ? motion_db::quantise(motion, tolerance) : motion;
    stored = motion_db::describe(quantised, mode, 1, tolerance);
    motion_db::put(*store, stored, quantised);
    seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }
  /// Stores the whole motion and measures the time.
  Motion read(motion_db::ReadCost& cost) const {
    const auto snapshot = store->read();
    const auto skeleton = motion_db::read_skeleton(*snapshot, stored);
    return motion_db::read(*snapshot, stored, skeleton, {0, stored.frames}, {}, &cost);
  }
};

double bytes_a_joint(const motion_db::ReadCost& cost, const Motion& motion) {
  return static_cast<double>(cost.bytes) / static_cast<double>(motion.rotations().size());
}

/// Returns the bytes of the packets.
std::uint64_t measure_size(const Named& named, AccessMode::Kind kind, float tolerance, const std::string& goal) {
  const Motion& motion = named.motion;
  const Stored stored(motion, {kind, 0}, tolerance);
  motion_db::ReadCost cost;
  const Motion back = stored.read(cost);
  const double off = motion_db::largest_distance(motion, back);
  if (!(off <= static_cast<double>(tolerance))) {
    throw std::runtime_error(fmt::format("{}: error of {} m, the limit is {}", named.name, off, tolerance));
  }
  const std::string name =
      fmt::format("{}/{:.4g}mm/{}", named.name, tolerance * kMillimetres, to_string(stored.stored.mode));
  const double plain = 16.0 + 12.0 * static_cast<double>(motion.skeleton().translation_count()) /
                                  static_cast<double>(motion.skeleton().joint_count());
  const double bytes = bytes_a_joint(cost, motion);
  bench::print("size/" + name, bytes, "B/joint/frame", plain, bytes / plain, goal);
  if (kind != AccessMode::Kind::by_frame) return cost.bytes;
  bench::print("largest_error/" + name, off * static_cast<double>(kMillimetres), "mm",
               static_cast<double>(tolerance * kMillimetres), off / static_cast<double>(tolerance), "<= 1");
  const double real_time = motion.duration().count() / stored.seconds;
  bench::print("write/" + name, stored.seconds, "s", motion.duration().count(), real_time, ">= 20");
  return cost.bytes;
}

/// The least that an interpolation costs: normalised linear, over quaternions as stored in a Motion.
__attribute__((noinline)) void nlerp(const float* __restrict a, const float* __restrict b, float t,
                                     float* __restrict out, std::size_t count) {
  for (std::size_t i = 0; i < 4 * count; i += 4) {
    const float dot = a[i] * b[i] + a[i + 1] * b[i + 1] + a[i + 2] * b[i + 2] + a[i + 3] * b[i + 3];
    const float from = 1.0f - t;
    const float to = std::copysign(t, dot);
    const float x = from * a[i] + to * b[i];
    const float y = from * a[i + 1] + to * b[i + 1];
    const float z = from * a[i + 2] + to * b[i + 2];
    const float w = from * a[i + 3] + to * b[i + 3];
    const float scale = 1.0f / std::sqrt(x * x + y * y + z * z + w * w);
    out[i] = x * scale;
    out[i + 1] = y * scale;
    out[i + 2] = z * scale;
    out[i + 3] = w * scale;
  }
}

void measure_speed(const Named& named) {
  using namespace motion_db;
  const Motion motion = quantise(named.motion, kTolerance);
  const Skeleton& skeleton = motion.skeleton();
  const StoredMotion stored = describe(motion, {AccessMode::Kind::by_frame, 0}, 1, kTolerance);
  struct Packed {
    Record record;
    Bytes payload;
  };
  std::vector<Packed> packets;
  for_each_packet(stored, {0, stored.frames}, {}, [&](const Record& record) {
    packets.push_back({record, pack(motion, record)});
  });
  const std::size_t joints = skeleton.joint_count();
  const std::int64_t p = packet_frames(stored);
  Motion pair(motion.shared_skeleton(), motion.rate(), 2);
  Motion result(motion.shared_skeleton(), motion.rate(), 1);
  const MutablePoses both = pair.poses({0, 2});
  const MutablePoses single = result.poses({0, 1});
  const auto floats = [](auto rotations) { return rotations.front().coeffs().data(); };

  // Random pairs of neighbours within one packet.
  std::mt19937 random(1);
  std::vector<std::int64_t> starts;
  while (starts.size() < 1000) {
    const auto frame = static_cast<std::int64_t>(random() % static_cast<unsigned>(stored.frames - 1));
    if (frame / p == (frame + 1) / p) starts.push_back(frame);
  }
  const auto unpack_at = [&](std::int64_t frame, std::int64_t count, MutablePoses out) {
    const Packed& packet = packets[static_cast<std::size_t>(frame / p)];
    unpack(packet.payload, packet.record, skeleton, {frame, frame + count}, {}, out);
  };
  unpack_at(starts[0], 2, both);
  if (std::memcmp(both.rotations.data(), motion.pose(starts[0]).rotations.data(), 16 * joints) != 0) {
    throw std::runtime_error(named.name + ": unpacked frames differ");
  }
  const int rounds = quick ? 11 : 101;
  const double per_joint = 1e9 / static_cast<double>(joints * starts.size());
  const auto all = [&](auto&& action) {
    return [&, action] {
      for (const std::int64_t frame : starts) action(frame);
    };
  };
  const auto compared = bench::compare(
      rounds, all([&](std::int64_t frame) {
        unpack_at(frame, 2, both);
        nlerp(floats(both.rotations), floats(both.rotations) + 4 * joints, 0.3f, floats(single.rotations), joints);
        bench::keep(single.rotations.front());
      }),
      all([&](std::int64_t frame) {
        const auto at = motion.pose(frame).rotations;
        nlerp(floats(at), floats(at) + 4 * joints, 0.3f, floats(single.rotations), joints);
        bench::keep(single.rotations.front());
      }));
  bench::print("unpack_two_and_nlerp/" + named.name, per_joint, "ns/joint", compared, "<= 3");
  // The same number of frames one after another.
  std::vector<std::int64_t> sorted = starts;
  std::sort(sorted.begin(), sorted.end());
  const auto order = bench::compare(rounds, all([&](std::int64_t frame) { unpack_at(frame, 1, single); }), [&] {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      unpack_at(static_cast<std::int64_t>(i) % stored.frames, 1, single);
    }
  });
  bench::print("unpack_random_frame/" + named.name, per_joint, "ns/joint", order, "<= 1.2");
  const std::int64_t many = std::min<std::int64_t>(p, stored.frames);
  Motion whole(motion.shared_skeleton(), motion.rate(), many);
  const auto bulk = bench::compare(
      rounds,
      [&] {
        unpack_at(0, many, whole.poses({0, many}));
      },
      [&] {
        std::memcpy(whole.poses({0, many}).rotations.data()->coeffs().data(),
                    motion.rotations().data()->coeffs().data(), 16 * joints * static_cast<std::size_t>(many));
        bench::keep(whole);
      });
  bench::print("unpack_packet_against_memcpy/" + named.name,
               1e9 / static_cast<double>(joints) / static_cast<double>(many), "ns/joint", bulk, "-");
}

/// Two minutes of the demo corpus; with --quick ten seconds of it.
std::vector<Named> demo_motions() {
  std::vector<Named> all;
  for (const demo::Script& script : demo::corpus_scripts(2.0)) {
    const Motion motion = without_tracks(demo::make_recording(script, FrameRate{60, 1}, 1).motion);
    all.push_back({"demo/" + script.name, motion.slice({0, quick ? std::min<std::int64_t>(motion.frame_count(), 600)
                                                                 : motion.frame_count()})});
    if (quick) break;
  }
  return all;
}

void run() {
  for (const Named& demo : demo_motions()) {
    measure_size(demo, AccessMode::Kind::by_frame, kTolerance, "<= 2.5 B");
    measure_speed(demo);
    for (const AccessMode::Kind kind :
         {AccessMode::Kind::by_joint_and_frame, AccessMode::Kind::by_joint, AccessMode::Kind::full}) {
      measure_size(demo, kind, kTolerance, "-");
    }
    if (quick) return;
    for (const float tolerance : {1e-5f, 1e-3f}) measure_size(demo, AccessMode::Kind::by_frame, tolerance, "-");
  }
  const fs::path shared = fs::path(SIGNWEAVE_SHARED_DATA) / "bvh";
  if (!fs::exists(shared)) {
    fmt::print("shared_data not run: no shared data\n");
    return;
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(shared)) {
    if (entry.path().extension() == ".bvh") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  struct Folder {
    std::uint64_t bytes = 0;
    std::size_t numbers = 0;  ///< joints and frames
  };
  std::map<std::string, Folder> folders;
  std::string last;
  for (const fs::path& file : files) {
    const std::string folder = file.parent_path().filename().string();
    std::string name = folder + "/" + file.stem().string();
    std::ranges::replace(name, ' ', '_');  // fields of a line are separated by blanks
    const Named named{std::move(name), without_tracks(bvh::read(file).motion)};
    const bool fingers = named.motion.skeleton().joint_count() >= kFingers && named.motion.frame_count() > 1;
    if (!fingers && folder == last) continue;  // of those without fingers, one per folder
    last = folder;
    const std::uint64_t bytes = measure_size(named, AccessMode::Kind::by_frame, kTolerance, "-");
    if (!fingers) continue;
    folders[folder].bytes += bytes;
    folders[folder].numbers += named.motion.rotations().size();
    measure_speed(named);
  }
  for (const auto& [name, folder] : folders) {
    const double bytes = static_cast<double>(folder.bytes) / static_cast<double>(folder.numbers);
    bench::print(fmt::format("size_of_folder/{}/0.1mm", name), bytes, "B/joint/frame", 16, bytes / 16, "<= 2.5 B");
  }
}

}  // namespace

int main(int count, char** arguments) {
  quick = count > 1 && std::string_view(arguments[1]) == "--quick";
  try {
    run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compact: %s\n", error.what());
    return 1;
  }
  return 0;
}
