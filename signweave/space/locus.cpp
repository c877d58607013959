#include "signweave/space/locus.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr float kDegree = std::numbers::pi_v<float> / 180;
constexpr std::array<std::string_view, 5> kBuiltIn = {"left", "right", "front", "addressee", "self"};
constexpr float kAside = 45;                                                       // degrees
constexpr SpaceAngles kAddressee = {.azimuth = 0, .elevation = 5, .distance = 3};  // shoulder widths
constexpr std::string_view kForms =
    "give a name such as @left, angles such as @30 or @30/10/1.2 (azimuth, elevation, distance), or a point such as "
    "@0.3,0.1,0.8 (left, up, forward in shoulder widths)";

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
  throw Error(ErrorCode::bad_input, fmt::format("'@{}' is no locus: {}", printable(text), why));
}

float number_of(std::string_view text, std::string_view whole) {
  float value = 0;
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (fault != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) refuse(whole, kForms);
  return value == 0 ? 0 : value;  // no negative zero
}

void check_range(float value, float least, float most, std::string_view what, std::string_view text) {
  if (value >= least && value <= most) return;
  refuse(text, fmt::format("its {} is {}; give one from {} to {}", what, value, least, most));
}

LocusRef read_numbers(std::string_view text) {
  const bool is_point = text.find(',') != std::string_view::npos;
  LocusRef locus{.kind = is_point ? LocusRef::Kind::point : LocusRef::Kind::angles, .name = {}, .numbers = {}};
  if (!is_point) locus.numbers[2] = kLocusDistance;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(is_point ? ',' : '/', begin), text.size());
    if (count == 3) refuse(text, kForms);
    locus.numbers[count++] = number_of(text.substr(begin, end - begin), text);
    begin = end + 1;
  }
  if (is_point) {
    if (count != 3) refuse(text, kForms);
    for (const float value : locus.numbers) check_range(value, -kFarthestLocus, kFarthestLocus, "coordinate", text);
    return locus;
  }
  check_range(locus.numbers[0], -180, 180, "azimuth", text);
  check_range(locus.numbers[1], -90, 90, "elevation", text);
  if (!(locus.numbers[2] > 0)) refuse(text, fmt::format("its distance is {}; give one above 0", locus.numbers[2]));
  check_range(locus.numbers[2], 0, kFarthestLocus, "distance", text);
  return locus;
}

std::string unknown_locus(std::string_view name, std::span<const LocusSetup> setups, std::size_t place) {
  for (const LocusSetup& setup : setups) {
    if (setup.name == name && setup.from > place) {
      return fmt::format("the locus '@{}' is set up later, at place {}; set it up before it is used", printable(name),
                         setup.from + 1);
    }
  }
  std::vector<std::string> known(kBuiltIn.begin(), kBuiltIn.end());
  for (const LocusSetup& setup : setups) known.push_back(setup.name);
  const std::string hint = did_you_mean(name, known);
  return fmt::format(
      "there is no locus '@{}'{}", printable(name),
      hint.empty() ? fmt::format("; set it up at a sign before: SIGN{{@{} = @left}}", printable(name)) : hint);
}

}  // namespace

Eigen::Vector3f point_of(const SpaceAngles& angles) noexcept {
  const float level = angles.distance * std::cos(angles.elevation * kDegree);
  return {level * std::sin(angles.azimuth * kDegree), angles.distance * std::sin(angles.elevation * kDegree),
          level * std::cos(angles.azimuth * kDegree)};
}

SpaceAngles angles_of(const Eigen::Vector3f& point) noexcept {
  const float level = std::hypot(point.x(), point.z());
  return {.azimuth = level > 0 ? std::atan2(point.x(), point.z()) / kDegree : 0,
          .elevation = std::atan2(point.y(), level) / kDegree,
          .distance = point.norm()};
}

LocusRef read_locus(std::string_view text) {
  if (text.empty()) refuse(text, kForms);
  if (std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos) return read_numbers(text);
  if (text.size() > kLongestLocusName) {
    refuse(text.substr(0, 20), fmt::format("its name has more than {} bytes", kLongestLocusName));
  }
  if (text.find_first_of(" \t\r\n[]{}();:=|@\",/") != std::string_view::npos) refuse(text, kForms);
  return {.kind = LocusRef::Kind::name, .name = std::string(text), .numbers = {}};
}

std::string to_string(const LocusRef& locus) {
  const auto& [a, b, c] = locus.numbers;
  switch (locus.kind) {
    case LocusRef::Kind::name:
      return locus.name;
    case LocusRef::Kind::point:
      return fmt::format("{},{},{}", a, b, c);
    case LocusRef::Kind::angles:
      break;
  }
  if (c != kLocusDistance) return fmt::format("{}/{}/{}", a, b, c);
  return b != 0 ? fmt::format("{}/{}", a, b) : fmt::format("{}", a);
}

std::span<const std::string_view> built_in_loci() noexcept {
  return kBuiltIn;
}

bool is_built_in_locus(std::string_view name) noexcept {
  return std::ranges::find(kBuiltIn, name) != kBuiltIn.end();
}

LocusRef without_setups(const LocusRef& locus, std::span<const LocusSetup> setups, std::size_t place) {
  LocusRef known = locus;
  // A name is the last setup by this place; what that refers to was set up before it.
  for (std::size_t i = setups.size(); known.kind == LocusRef::Kind::name && !is_built_in_locus(known.name);) {
    while (i > 0 && !(setups[i - 1].name == known.name && setups[i - 1].from <= place)) --i;
    if (i == 0) throw Error(ErrorCode::not_found, unknown_locus(known.name, setups, place));
    known = setups[--i].is;
  }
  return known;
}

Locus resolve(const LocusRef& locus, std::span<const LocusSetup> setups, std::size_t place, const SignerBody& body) {
  const LocusRef known = without_setups(locus, setups, place);
  const auto& [a, b, c] = known.numbers;
  if (known.kind == LocusRef::Kind::point) return {.at = {a, b, c}, .self = false};
  if (known.kind == LocusRef::Kind::angles) return {.at = point_of({a, b, c}), .self = false};
  if (known.name == "self") {
    const float chest = body.heights[static_cast<std::size_t>(Height::chest)];
    const float shoulder = body.heights[static_cast<std::size_t>(Height::shoulder)];
    return {.at = {0, (chest + shoulder) / 2, kChestDepth}, .self = true};
  }
  if (known.name == "addressee") return {.at = point_of(kAddressee), .self = false};
  const float aside = known.name == "left" ? kAside : known.name == "right" ? -kAside : 0;
  return {.at = point_of({aside, 0, kLocusDistance}), .self = false};
}

}  // namespace signweave
