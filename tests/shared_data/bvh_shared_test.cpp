#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/bvh/bvh.h"

namespace signweave::bvh {
namespace {

namespace fs = std::filesystem;

/// A BVH file as plain text and numbers, read without any of the library's own code.
struct Plain {
  std::vector<std::string> hierarchy;              ///< all words except the numbers of OFFSET
  std::vector<double> offsets;                     ///< all numbers of OFFSET
  std::vector<std::vector<std::string>> channels;  ///< [joint]
  std::string frames;
  std::string frame_time;
  std::vector<double> numbers;  ///< all frames
};

Plain read_plain(const std::string& text) {
  Plain plain;
  std::istringstream words(text);
  std::string word;
  while (words >> word && word != "MOTION") {
    plain.hierarchy.push_back(word);
    if (word == "OFFSET") {
      for (int i = 0; i < 3; ++i) {
        words >> word;
        plain.offsets.push_back(std::stod(word));
      }
    } else if (word == "CHANNELS") {
      words >> word;
      plain.channels.emplace_back(std::stoul(word));
      for (std::string& channel : plain.channels.back()) words >> channel;
      plain.hierarchy.push_back(word);
      plain.hierarchy.insert(plain.hierarchy.end(), plain.channels.back().begin(), plain.channels.back().end());
    }
  }
  words >> word >> plain.frames >> word >> word >> plain.frame_time;
  while (words >> word) plain.numbers.push_back(std::stod(word));
  return plain;
}

/// The rotation of one joint in one frame, from the file's own angles.
Eigen::Quaterniond rotation_of(const std::vector<std::string>& channels, const double* numbers) {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].substr(1) != "rotation") continue;
    rotation =
        rotation * Eigen::AngleAxisd(numbers[i] * std::numbers::pi / 180, Eigen::Vector3d::Unit(channels[i][0] - 'X'));
  }
  return rotation;
}

double degrees_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * 180 / std::numbers::pi;
}

bool same_length(double a, double b) {
  return std::abs(a - b) <= std::max(1e-5, 1e-6 * std::abs(b));
}

struct Worst {
  double degrees = 0;
  double length = 0;
  std::size_t lengths_off = 0;
};

Worst compare_frames(const Plain& written, const Plain& original, bool rotation_first) {
  Worst worst;
  std::size_t at = 0;
  while (at < original.numbers.size()) {
    for (std::size_t joint = 0; joint < original.channels.size(); ++joint) {
      std::vector<std::string> channels = original.channels[joint];
      if (joint == 0 && rotation_first) std::rotate(channels.begin(), channels.begin() + 3, channels.end());
      worst.degrees = std::max(worst.degrees, degrees_between(rotation_of(channels, &written.numbers[at]),
                                                              rotation_of(channels, &original.numbers[at])));
      for (std::size_t i = 0; i < channels.size(); ++i, ++at) {
        if (channels[i].substr(1) != "position") continue;
        worst.length = std::max(worst.length, std::abs(written.numbers[at] - original.numbers[at]));
        worst.lengths_off += same_length(written.numbers[at], original.numbers[at]) ? 0 : 1;
      }
    }
  }
  return worst;
}

std::vector<fs::path> bvh_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SIGNWEAVE_SHARED_DATA) / "bvh")) {
    if (entry.path().extension() == ".bvh") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void expect_round_trip(const fs::path& path, const ReadOptions& options) {
  SCOPED_TRACE(path.string());
  const std::string text = read_file(path);
  const File file = read(path, options);
  const std::string again = write_text(file.motion, file.layout);
  const Plain original = read_plain(text);
  const Plain written = read_plain(again);
  EXPECT_EQ(written.hierarchy, original.hierarchy);
  EXPECT_EQ(written.channels, original.channels);
  EXPECT_EQ(written.frames, original.frames);
  EXPECT_EQ(written.frame_time, original.frame_time);
  ASSERT_EQ(written.offsets.size(), original.offsets.size());
  for (std::size_t i = 0; i < original.offsets.size(); ++i) {
    EXPECT_TRUE(same_length(written.offsets[i], original.offsets[i])) << written.offsets[i] << original.offsets[i];
  }
  ASSERT_EQ(written.numbers.size(), original.numbers.size());
  const Worst worst = compare_frames(written, original, options.root_columns == RootColumns::rotation_first);
  EXPECT_LE(worst.degrees, 1e-4);
  EXPECT_EQ(worst.lengths_off, 0u) << "worst " << worst.length;
  EXPECT_GT(file.motion.frame_count(), 0);

  const File second = read_text("again", again,
                                {.up = file.layout.up,
                                 .unit = file.layout.unit,
                                 .root_unit = file.layout.root_unit,
                                 .root_columns = options.root_columns,
                                 .mirror = options.mirror});
  EXPECT_EQ(second.layout, file.layout);
  EXPECT_TRUE(second.motion.skeleton() == file.motion.skeleton());
  EXPECT_TRUE(std::ranges::equal(second.motion.translations(), file.motion.translations()));
}

TEST(SharedBvh, EveryFileIsWrittenBackUnchanged) {
  const std::vector<fs::path> files = bvh_files();
  ASSERT_GE(files.size(), 60u);
  for (const fs::path& path : files) expect_round_trip(path, {});
}

TEST(SharedBvh, EveryFileIsWrittenBackUnchangedThroughAMirror) {
  for (const fs::path& path : bvh_files()) expect_round_trip(path, {.mirror = true});
}

TEST(SharedBvh, APermutedRootIsReportedFixedAndRestored) {
  std::size_t found = 0;
  for (const fs::path& path : bvh_files()) {
    SCOPED_TRACE(path.string());
    const bool permuted = path.parent_path().filename() == "signon-thanks";
    const Remedies remedies{{"root_order", "rotation_first"}, {"root_unit", "m"}};
    std::size_t notices = 0;
    for (const Notice& notice : read(path).notices) notices += notice.remedies == remedies ? 1u : 0u;
    EXPECT_EQ(notices, permuted ? 1u : 0u);
    if (!permuted) continue;
    ++found;
    const ReadOptions fixed{.root_unit = 1.0, .root_columns = RootColumns::rotation_first};
    const File file = read(path, fixed);
    for (const Notice& notice : file.notices) EXPECT_THAT(notice.text, testing::Not(testing::HasSubstr("permuted")));
    EXPECT_NEAR(file.motion.pose(0).translations[0].y(), 0.890477, 1e-6);
    expect_round_trip(path, fixed);
  }
  EXPECT_EQ(found, 3u);
}

TEST(SharedBvh, GuessesArePlausible) {
  std::map<std::string, std::set<std::string>> reported;
  std::map<std::string, std::set<UpAxis>> up;
  for (const fs::path& path : bvh_files()) {
    const File file = read(path);
    const std::string folder = path.parent_path().filename().string();
    up[folder == "pybvh" ? path.filename().string() : folder].insert(file.layout.up);
    for (const Notice& notice : file.notices) {
      const bool alike = folder == "bandai-namco";
      reported[folder].insert((alike ? std::string() : path.filename().string() + ": ") + notice.text);
    }
  }
  for (const auto& [folder, notices] : reported) {
    std::cout << folder << '\n';
    for (const std::string& notice : notices) std::cout << "  " << notice << '\n';
  }
  const std::set<UpAxis> y = {UpAxis::y};
  const std::set<UpAxis> z = {UpAxis::z};
  EXPECT_EQ(up["fair1"], z);
  EXPECT_EQ(up["bvh_example.bvh"], z);
  EXPECT_EQ(up["bandai-namco"], y);
  EXPECT_EQ(up["cmu1"], y);
  EXPECT_EQ(up["rokoko"], y);
  EXPECT_EQ(up["ksl-always"], y);
  EXPECT_EQ(up["signon-thanks"], y);
  EXPECT_EQ(up["cmu_12_01_walk.bvh"], y);
}

}  // namespace
}  // namespace signweave::bvh
