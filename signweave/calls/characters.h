#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/database/database.h"
#include "signweave/features/hand_motion.h"
#include "signweave/retarget/character.h"

namespace signweave::calls {

/// The help of `character`.
inline constexpr const char* kCharacterHelp =
    "show it on this character, whose joints the poses then have: on the command line a GLB that studio/avatar/build "
    "made, of a server a name that /api/characters lists";

/// A character, and the file that shows it. Immutable: threads share it.
struct CharacterFile {
  std::string name;             ///< of the file, without its ending: "woman"
  std::filesystem::path path;   ///< what a browser loads
  std::filesystem::path plain;  ///< what motions are written into; the same where it is not packed
  Character character;
};
using SharedCharacter = std::shared_ptr<const CharacterFile>;

/// Reads a character; "woman.plain.glb" beside "woman.glb" is its plain file. Throws what read_character throws.
SharedCharacter read_character_file(const std::filesystem::path& path);

/// The characters of a folder, by name. Immutable: threads share it.
class Characters {
 public:
  Characters() = default;
  /// Every .glb of the folder. Throws Error{not_found} where there is no such folder or no character in it, and what
  /// read_character throws.
  explicit Characters(const std::filesystem::path& folder);
  explicit Characters(SharedCharacter one) : all_{std::move(one)} {}

  const std::vector<SharedCharacter>& all() const noexcept { return all_; }
  /// Throws Error{not_found} with near matches.
  SharedCharacter at(std::string_view name) const;

 private:
  std::vector<SharedCharacter> all_;
};

/// How a recording's signer is built and where the floor is: measured on frames spread over the whole of it, so that
/// every part of it is put onto a character alike.
struct SignerStance {
  SignerModel signer;
  Motion frames;  ///< those, without tracks
};
/// Throws Error{corrupt}, Error{not_found} where the recording has no motion.
SignerStance stance_of(const Database& database, const RecordingInfo& recording);

/// A motion on a character, at the same rate and with its tracks; what is missing or approximate goes to `notices`.
Motion on_character(const Motion& motion, const SignerStance& stance, const Character& character,
                    std::vector<Notice>& notices);

}  // namespace signweave::calls
