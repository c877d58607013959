// Reading glTF, against tinygltf's own parse of the same file, which splits it and copies its numbers but builds no
// motion from them.
//
// Prints lines "name value unit yardstick ratio goal": medians of interleaved rounds.
//   --quick        a small file, few rounds
//   FILE           these files instead of the generated one
// The result is compared with the numbers that tinygltf found; a difference ends the program with status 1.

#include <malloc.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/table.h"
#include "signweave/formats/gltf/gltf.h"
#include "signweave/formats/gltf/read.h"

namespace {

using namespace signweave;
namespace fs = std::filesystem;

/// All joints turn and the root moves, differently in each frame.
Motion made_motion(std::int64_t frames, int joint_count) {
  std::vector<Joint> joints;
  for (int i = 0; i < joint_count; ++i) {
    joints.push_back({.name = fmt::format("joint {}", i),
                      .parent = i == 0 ? kNoJoint : (i - 1) / 2,
                      .offset = {0.05f, 0.1f, 0},
                      .translated = i == 0});
  }
  Motion motion(std::make_shared<const Skeleton>(std::move(joints), std::vector<Tip>()), {100, 1}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const MutablePoseView pose = motion.pose(frame);
    for (std::size_t i = 0; i < pose.rotations.size(); ++i) {
      const auto phase = static_cast<float>(frame) * 0.01f + static_cast<float>(i);
      const Eigen::Vector3f axis(std::cos(phase), std::sin(phase), 0);
      pose.rotations[i] = Eigen::AngleAxisf(0.5f * std::sin(3 * phase), axis);
    }
    pose.translations[0] = {std::sin(static_cast<float>(frame) * 0.02f), 1, 0};
  }
  return motion;
}

bool no_picture(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

tinygltf::Model parsed(const fs::path& path) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(no_picture, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  if (!loader.LoadBinaryFromFile(&model, &error, &warning, path.string())) {
    throw std::runtime_error(path.string() + ": tinygltf: " + error);
  }
  return model;
}

/// Compares the rotations that tinygltf found with ours, key by key.
void require_same(const tinygltf::Model& model, const Motion& motion) {
  for (const tinygltf::AnimationChannel& channel : model.animations.at(0).channels) {
    if (channel.target_path != "rotation") continue;
    const auto& node = model.nodes[static_cast<std::size_t>(channel.target_node)];
    const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(channel.sampler)];
    const auto& accessor = model.accessors[static_cast<std::size_t>(sampler.output)];
    const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const auto joint = static_cast<std::size_t>(motion.skeleton().find(node.name).value());
    if (static_cast<std::int64_t>(accessor.count) != motion.frame_count()) {
      throw std::runtime_error(fmt::format("{}: {} keys, {} frames", node.name, accessor.count, motion.frame_count()));
    }
    for (std::size_t key = 0; key < accessor.count; ++key) {
      Eigen::Vector4f theirs;
      std::memcpy(theirs.data(), model.buffers[0].data.data() + view.byteOffset + accessor.byteOffset + 16 * key, 16);
      const Eigen::Vector4f ours = motion.pose(static_cast<std::int64_t>(key)).rotations[joint].coeffs();
      if (std::min((ours - theirs).norm(), (ours + theirs).norm()) < 1e-6f) continue;
      throw std::runtime_error(fmt::format("{}: key {} has a different rotation", node.name, key));
    }
  }
}

void measure(const std::string& name, const fs::path& path, int rounds) {
  require_same(parsed(path), gltf::read(path).motion);
  bench::Table table("gltf_read", "ms", 1e3, "<= 2", false);
  table.add(name, bench::compare(
                      rounds, [&] { bench::keep(gltf::read(path)); }, [&] { bench::keep(parsed(path)); }));
  table.print();
}

}  // namespace

int main(int count, char** arguments) {
  // As in bench/import.cpp: the results are large, and page faults must not be measured.
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
  ::mallopt(M_MMAP_THRESHOLD, 1 << 30);
  try {
    bool quick = false;
    bool given = false;
    for (int i = 1; i < count; ++i) {
      const std::string_view word = arguments[i];
      if (word == "--quick") {
        quick = true;
      } else if (word.starts_with("--")) {
        fmt::print(stderr, "gltf: no option '{}'; the only one is --quick\n", word);
        return 2;
      } else {
        given = true;
        measure(fs::path(word).filename().string(), word, 15);
      }
    }
    if (given) return 0;
    const bench::Folder folder("gltf");
    const fs::path made = folder.path() / "made.glb";
    const std::int64_t frames = quick ? 6'000 : 10 * 60 * 100;
    gltf::write(made, made_motion(frames, 60), {});
    measure(fmt::format("{}_frames_of_60_joints", frames), made, quick ? 7 : 15);
  } catch (const std::exception& error) {
    fmt::print(stderr, "gltf: {}\n", error.what());
    return 1;
  }
  return 0;
}
