#include "signweave/motion_db/access_mode.h"

#include <array>
#include <charconv>

namespace signweave {

namespace {

struct Name {
  AccessMode::Kind kind;
  std::string_view text;
  bool cut_by_frame;  ///< has a p
};

constexpr std::array kNames = {
    Name{AccessMode::Kind::full, "full", false},
    Name{AccessMode::Kind::by_frame, "by_frame", true},
    Name{AccessMode::Kind::by_joint, "by_joint", false},
    Name{AccessMode::Kind::by_joint_and_frame, "by_joint_and_frame", true},
};

}  // namespace

std::optional<AccessMode> parse_access_mode(std::string_view text) {
  const std::size_t colon = text.find(':');
  for (const Name& name : kNames) {
    if (text.substr(0, colon) != name.text) continue;
    AccessMode mode{.kind = name.kind, .frames_per_packet = 0};
    if (colon == std::string_view::npos) return mode;
    const std::string_view number = text.substr(colon + 1);
    const char* const end = number.data() + number.size();
    const auto [rest, fault] = std::from_chars(number.data(), end, mode.frames_per_packet);
    if (!name.cut_by_frame || fault != std::errc{} || rest != end || mode.frames_per_packet == 0) return std::nullopt;
    return mode;
  }
  return std::nullopt;
}

std::string to_string(AccessMode mode) {
  const Name& name = kNames.at(static_cast<std::size_t>(mode.kind));
  std::string text(name.text);
  if (name.cut_by_frame && mode.frames_per_packet > 0) text += ':' + std::to_string(mode.frames_per_packet);
  return text;
}

}  // namespace signweave
