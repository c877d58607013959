#include "signweave/nonmanual/gaze.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

// 45° to the side is the place of a third person in signing space; up and down are ours.
constexpr float kAside = 45;
constexpr float kAbove = 20;
constexpr float kBelow = -25;
constexpr NamedGaze kNamedGazes[] = {
    {"left", {kAside, 0}},
    {"right", {-kAside, 0}},
    {"up", {0, kAbove}},
    {"down", {0, kBelow}},
    {"front", {0, 0}},
    {"addressee", {0, 0}},
    {"AD", {0, 0}},
    {"FR", {0, 0}},
    {"UP", {0, kAbove}},
    {"DN", {0, kBelow}},
    {"LE", {kAside, 0}},
    {"RI", {-kAside, 0}},
    {"LU", {kAside, kAbove}},
    {"LD", {kAside, kBelow}},
    {"RU", {-kAside, kAbove}},
    {"RD", {-kAside, kBelow}},
};

}  // namespace

std::span<const NamedGaze> named_gazes() noexcept {
  return kNamedGazes;
}

GazeDirection find_gaze(std::string_view name) {
  std::vector<std::string> known;
  for (const NamedGaze& one : kNamedGazes) {
    if (one.name == name) return one.direction;
    known.emplace_back(one.name);
  }
  if (name == "hands" || name == "HD" || name == "HI" || name == "HC") {
    throw Error(ErrorCode::unsupported,
                fmt::format("gaze '{}' would have to follow a hand, which is not possible yet; give a direction: left, "
                            "right, up, down, front or addressee",
                            name));
  }
  const std::string hint = did_you_mean(name, known);
  throw Error(ErrorCode::not_found,
              fmt::format("there is no gaze '{}'{}", printable(name),
                          hint.empty() ? "; give left, right, up, down, front or addressee" : hint));
}

Curve gaze_at(GazeDirection direction, std::string name) {
  return {.name = std::move(name),
          .onset = kSaccade,
          .offset = kSaccade,
          .weights = {},
          .head = {.turn = {.pitch = kHeadShare * direction.pitch, .yaw = kHeadShare * direction.yaw, .roll = 0},
                   .swing = {},
                   .delay = kHeadDelay},
          .mouth = {},
          .gaze = direction,
          .merge = Merge::replace};
}

std::vector<TimeSpan> plan_gaze(TimeSpan whole, std::span<const TimeSpan> units) {
  std::vector<TimeSpan> glances;
  const auto add = [&](TimeSpan span) {
    if (span.duration() >= kShortestGlance) glances.push_back(span);
  };
  Milliseconds end = whole.begin;
  for (const TimeSpan& unit : units) {
    add({end, std::min(unit.begin, whole.end)});
    end = std::max(end, unit.end);
  }
  add({end, whole.end});
  return glances;
}

TimeSpan gaze_span(Milliseconds first_preparation, Milliseconds last_stroke_end) noexcept {
  return {first_preparation, last_stroke_end + kGazeStays};
}

}  // namespace signweave
