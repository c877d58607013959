#include <fmt/format.h>

#include <fstream>
#include <string>
#include <vector>

#include "signweave/core/text.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

RigNames read_rig_names(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) {
    std::error_code ignored;
    const bool there = std::filesystem::exists(path, ignored);
    throw Error(there ? ErrorCode::io : ErrorCode::not_found,
                fmt::format("{}: {}", path.string(), there ? "cannot be read" : "no such mapping file"));
  }
  std::vector<std::string> known;
  for (std::size_t part = 0; part < kPartCount; ++part) known.emplace_back(name_of(static_cast<Part>(part)));
  RigNames names;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const auto fail = [&](const std::string& what) {
      throw Error(ErrorCode::bad_input, fmt::format("{}:{}: {}", path.string(), number, what));
    };
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    const std::string_view text = trimmed(line);
    // A joint's name may contain a '#', so a comment is a separate line or follows a blank.
    if (text.empty() || text.front() == '#') continue;
    if (text.find('\0') != std::string_view::npos) fail("not a text file: a mapping file has lines `part = joint`");
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
      fail(fmt::format("expected `part = joint`, not \"{}\"", printable(text)));
    }
    const std::string_view name = trimmed(text.substr(0, equals));
    std::string_view joint = text.substr(equals + 1);
    for (const std::string_view comment : {" #", "\t#"}) joint = joint.substr(0, joint.find(comment));
    const std::optional<Part> part = part_named(name);
    if (!part && part_named(fmt::format("{}_proximal", name))) {
      fail(fmt::format(
          "\"{0}\" has several joints: {0}_metacarpal, {0}_proximal, {0}_intermediate, {0}_distal and {0}_tip", name));
    }
    if (!part) fail(fmt::format("unknown part \"{}\"{}", printable(name), did_you_mean(name, known)));
    if (!names.emplace(*part, std::string(trimmed(joint))).second) {
      fail(fmt::format("part \"{}\" is given twice; keep one line", name));
    }
  }
  if (file.bad()) throw Error(ErrorCode::io, fmt::format("{}: cannot be read", path.string()));
  return names;
}

}  // namespace signweave
