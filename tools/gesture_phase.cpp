#include "tools/gesture_phase.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>

namespace signweave {
namespace {

constexpr std::size_t kColumns = 20;
constexpr float kHeadToSpine = 0.47F;  ///< metres, for an adult as measured by a Kinect

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::optional<double> number(std::string_view word) {
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<MotionPhase> label(std::string_view word) {
  if (word == "Rest") return MotionPhase::rest;
  if (word.starts_with("Prepara")) return MotionPhase::preparation;  // one frame of b1 has it in Portuguese
  if (word == "Stroke") return MotionPhase::stroke;
  if (word == "Hold") return MotionPhase::hold;
  if (word == "Retraction") return MotionPhase::retraction;
  return std::nullopt;
}

/// Rotates from the file's axes (x to the viewer's right, y down, z away from the camera) to those of the signer, who
/// faces it.
void turn_to_signer(UpperBodyTrack& track) {
  std::vector<float> lengths;
  for (const UpperBody& body : track.bodies) lengths.push_back((body.head - body.spine).head<2>().norm());
  std::nth_element(lengths.begin(), lengths.begin() + std::ssize(lengths) / 2, lengths.end());
  const float unit = kHeadToSpine / lengths[lengths.size() / 2];
  const Eigen::Vector3f scale(-unit, -unit, -1.0F);
  for (UpperBody& body : track.bodies) {
    for (Eigen::Vector3f* point :
         {&body.hands[0], &body.hands[1], &body.wrists[0], &body.wrists[1], &body.head, &body.spine}) {
      *point = point->cwiseProduct(scale);
    }
  }
}

}  // namespace

LabelledTrack read_gesture_phase(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw Error(ErrorCode::not_found, path.string() + ": cannot be read");
  const std::string stem = path.stem().string();
  LabelledTrack result{.name = stem.substr(0, stem.find('_'))};
  std::string line;
  std::getline(file, line);  // column names
  for (int row = 2; std::getline(file, line); ++row) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) continue;
    const std::vector<std::string_view> words = split(line);
    const auto phase = words.size() == kColumns ? label(words.back()) : std::nullopt;
    std::array<float, 18> values{};
    bool good = phase.has_value();
    for (std::size_t i = 0; good && i < values.size(); ++i) {
      const auto value = number(words[i]);
      good = value.has_value();
      values[i] = static_cast<float>(value.value_or(0));
    }
    const auto time = good ? number(words[18]) : std::nullopt;
    if (!time) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("{}:{}: expected 18 coordinates, a time and a phase", path.string(), row));
    }
    const auto point = [&](std::size_t i) {
      return Eigen::Vector3f(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    };
    result.track.times.emplace_back(*time / 1000);
    result.track.bodies.push_back(
        {.hands = {point(0), point(1)}, .wrists = {point(4), point(5)}, .head = point(2), .spine = point(3)});
    result.labels.push_back(*phase);
  }
  if (result.labels.empty()) throw Error(ErrorCode::bad_input, path.string() + ": no frames");
  turn_to_signer(result.track);
  return result;
}

std::vector<LabelledTrack> read_gesture_phases(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  std::error_code fault;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "raw", fault)) {
    if (entry.path().string().ends_with("_raw.csv")) paths.push_back(entry.path());
  }
  if (paths.empty()) throw Error(ErrorCode::not_found, (folder / "raw").string() + ": no *_raw.csv here");
  std::sort(paths.begin(), paths.end());
  std::vector<LabelledTrack> result;
  for (const std::filesystem::path& path : paths) result.push_back(read_gesture_phase(path));
  return result;
}

}  // namespace signweave
