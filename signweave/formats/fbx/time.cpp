#include "signweave/formats/fbx/time.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "signweave/core/text.h"

namespace signweave::fbx {
namespace {

// Indexed by FBX' number of the mode. Mode 0 is the program's default and gives no rate, 14 is the custom rate.
constexpr std::array<FrameRate, 19> kTimeModes{{{0, 1},
                                                {120, 1},
                                                {100, 1},
                                                {60, 1},
                                                {50, 1},
                                                {48, 1},
                                                {30, 1},
                                                {30, 1},
                                                {30000, 1001},
                                                {30000, 1001},
                                                {25, 1},
                                                {24, 1},
                                                {1000, 1},
                                                {24000, 1001},
                                                {0, 1},
                                                {96, 1},
                                                {72, 1},
                                                {60000, 1001},
                                                {120000, 1001}}};

constexpr std::array<FrameRate, 17> kStandardRates{{{24, 1},
                                                    {25, 1},
                                                    {30, 1},
                                                    {48, 1},
                                                    {50, 1},
                                                    {60, 1},
                                                    {72, 1},
                                                    {90, 1},
                                                    {96, 1},
                                                    {100, 1},
                                                    {120, 1},
                                                    {24000, 1001},
                                                    {30000, 1001},
                                                    {60000, 1001},
                                                    {120000, 1001},
                                                    {240, 1},
                                                    {1000, 1}}};

/// Bytes that the frames of any file may use, and that each byte of a file adds: sparse keys can make long takes. The
/// bytes per frame are those of the samples of one joint at a time and those that each joint keeps during reading.
constexpr double kPlainRoom = 256.0 * (1 << 20);
constexpr double kRoomPerByte = 64;
constexpr double kBytesPerFrame = 200;
constexpr double kBytesPerJoint = 64;

double frames_between(std::int64_t from, std::int64_t to, FrameRate rate) noexcept {
  return static_cast<double>(to - from) / static_cast<double>(kTicks) * rate.hertz();
}

}  // namespace

std::optional<FrameRate> rate_of(const Settings& settings) {
  if (settings.time_mode == 14) {
    if (!(settings.custom_rate >= 1e-3)) return std::nullopt;
    return parse_frame_rate(fmt::format("{:.6f}", settings.custom_rate));
  }
  if (settings.time_mode <= 0 || settings.time_mode >= static_cast<std::int64_t>(kTimeModes.size()))
    return std::nullopt;
  return kTimeModes[static_cast<std::size_t>(settings.time_mode)];
}

std::optional<FrameRate> rate_of(const std::vector<std::int64_t>& ticks) {
  if (ticks.size() < 2) return std::nullopt;
  for (const FrameRate rate : kStandardRates) {
    const bool stand = std::all_of(ticks.begin(), ticks.end(), [&](std::int64_t tick) {
      const double frame = frames_between(ticks.front(), tick, rate);
      return std::abs(frame - std::round(frame)) < 1e-3;
    });
    if (stand) return rate;
  }
  return std::nullopt;
}

Frames frames_of(const Source& source, const Scene& scene, const Take& take, const std::vector<std::int64_t>& keys,
                 std::optional<FrameRate> wanted, std::size_t joints, std::vector<Notice>& notices) {
  Frames frames;
  if (wanted) {
    frames.rate = *wanted;
  } else if (const auto named = rate_of(scene.settings)) {
    frames.rate = *named;
  } else if (const auto found = rate_of(keys)) {
    frames.rate = *found;
    notices.push_back(
        {source.name, fmt::format("it names no frame rate; its keys fit {} frames a second", to_string(frames.rate))});
  } else {
    notices.push_back({source.name, "it names no frame rate, and its keys fit none; 30 frames a second assumed"});
  }
  std::int64_t start = keys.front();
  std::int64_t stop = keys.back();
  if (take.start < take.stop) {
    const std::int64_t most = std::int64_t{1} << 53;
    if (take.stop < start || take.start > stop || take.start < -most || take.stop > most) {
      notices.push_back({source.name, fmt::format("take '{}' has no key between its start and its stop; it is read "
                                                  "from its first key to its last",
                                                  printable(take.name))});
    } else {
      const double slack = 0.5 * frames.rate.frame_time().count() * static_cast<double>(kTicks);
      if (static_cast<double>(take.start - start) > slack || static_cast<double>(stop - take.stop) > slack) {
        notices.push_back({source.name, fmt::format("take '{}' has keys before its start or after its stop; they are "
                                                    "left out, as its own program does",
                                                    printable(take.name))});
      }
      start = take.start;
      stop = take.stop;
    }
  }
  const double count = std::floor(frames_between(start, stop, frames.rate) + 1e-3) + 1;
  const double room = kPlainRoom + kRoomPerByte * static_cast<double>(source.bytes.size());
  if (count * (kBytesPerFrame + kBytesPerJoint * static_cast<double>(joints)) > room) {
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: take '{}' lasts {:.0f} frames, too many for {} bones and a file of its size; cut it",
                            source.name, printable(take.name), count, joints));
  }
  frames.ticks.reserve(static_cast<std::size_t>(count));
  const long double ticks_per_frame = static_cast<long double>(kTicks) *
                                      static_cast<long double>(frames.rate.denominator) /
                                      static_cast<long double>(frames.rate.numerator);
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(count); ++i) {
    frames.ticks.push_back(start + std::llround(ticks_per_frame * static_cast<long double>(i)));
  }
  return frames;
}

}  // namespace signweave::fbx
