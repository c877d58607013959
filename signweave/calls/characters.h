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

/// A character and its files. Immutable, so it may be shared between threads.
struct CharacterFile {
  std::string name;             ///< of the file without its extension: "woman"
  std::filesystem::path path;   ///< the file that a browser loads
  std::filesystem::path plain;  ///< the file that motions are written into; equal to `path` if that is not packed
  Character character;
};
using SharedCharacter = std::shared_ptr<const CharacterFile>;

/// Reads a character; "woman.plain.glb" next to "woman.glb" is its plain file. Throws what read_character throws.
SharedCharacter read_character_file(const std::filesystem::path& path);

/// The characters of a folder, by name. Immutable, so it may be shared between threads.
class Characters {
 public:
  Characters() = default;
  /// Reads every .glb of the folder. Throws Error{not_found} if the folder does not exist or has no character, and what
  /// read_character throws.
  explicit Characters(const std::filesystem::path& folder);
  explicit Characters(SharedCharacter one) : all_{std::move(one)} {}

  const std::vector<SharedCharacter>& all() const noexcept { return all_; }
  /// Throws Error{not_found} with near matches.
  SharedCharacter at(std::string_view name) const;

 private:
  std::vector<SharedCharacter> all_;
};

/// A signer's proportions and the floor, measured on frames spread over the whole recording, so that every part of it
/// is retargeted to a character in the same way.
struct SignerStance {
  SignerModel signer;
  Motion frames;  ///< the measured frames, without tracks
};
/// Throws Error{corrupt}, and Error{not_found} if the recording has no motion.
SignerStance stance_of(const Database& database, const RecordingInfo& recording);

/// Retargets a motion to a character, at the same rate and with its tracks; adds what is missing or approximate to
/// `notices`.
Motion on_character(const Motion& motion, const SignerStance& stance, const Character& character,
                    std::vector<Notice>& notices);

}  // namespace signweave::calls
