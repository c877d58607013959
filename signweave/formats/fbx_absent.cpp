#include <fmt/format.h>

#include "signweave/formats/fbx.h"

// In place of all other fbx*.cpp where the build has the option off.
namespace signweave::fbx {

File read(const std::filesystem::path& path, const ReadOptions& options) {
  return read_bytes(path.string(), {}, options);
}

File read_bytes(const std::string& name, std::string_view, const ReadOptions&) {
  throw Error(
      ErrorCode::unsupported,
      fmt::format("{}: this build does not read FBX; build it with -DSIGNWEAVE_FBX=ON and libassimp-dev", name));
}

bool built_in() {
  return false;
}

}  // namespace signweave::fbx
