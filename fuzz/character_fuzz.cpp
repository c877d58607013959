#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/formats/gltf/character.h"
#include "signweave/retarget/character.h"

using namespace signweave;

/// Any bytes are either rejected with an Error or read as a character; a motion of its own skeleton is put into its
/// file, and the result is a character again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::shared_ptr<const Skeleton> skeleton =
      std::make_shared<const Skeleton>(std::vector<Joint>{{.name = "root"}}, std::vector<Tip>());
  bool read = false;
  try {
    const Character character = read_character_bytes("fuzz", bytes);
    if (!std::isfinite(character.height)) std::abort();
    skeleton = character.skeleton;
    read = true;
  } catch (const Error&) {
  }
  std::string shown;
  try {
    shown = gltf::on_character("fuzz", bytes, Motion(skeleton, {50, 1}, 2), {});
  } catch (const Error&) {
    return 0;
  }
  if (read) read_character_bytes("shown", shown);
  return 0;
}
