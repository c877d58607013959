#include "signweave/calls/characters.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/features/phase_features.h"
#include "signweave/retarget/retarget.h"

namespace signweave::calls {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".glb";
constexpr std::string_view kPlainExtension = ".plain.glb";

}  // namespace

SharedCharacter read_character_file(const fs::path& path) {
  std::string name = path.filename().string();
  const bool plain = name.ends_with(kPlainExtension);
  const std::string_view extension = plain                        ? kPlainExtension
                                     : name.ends_with(kExtension) ? kExtension
                                                                  : std::string_view();
  name.erase(name.size() - extension.size());
  CharacterFile file{.name = std::move(name), .path = path, .plain = path, .character = read_character(path)};
  if (!plain) {
    fs::path plain_file = path;
    plain_file.replace_extension(kPlainExtension);
    std::error_code ignored;
    if (fs::is_regular_file(plain_file, ignored)) file.plain = plain_file;
  }
  return std::make_shared<const CharacterFile>(std::move(file));
}

Characters::Characters(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() == kExtension) paths.push_back(at->path());
  }
  if (error) throw Error(ErrorCode::not_found, fmt::format("{}: no folder of characters", folder.string()));
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    const std::string name = path.filename().string();
    if (name.ends_with(kPlainExtension)) {
      const fs::path packed = folder / (name.substr(0, name.size() - kPlainExtension.size()) + std::string(kExtension));
      if (std::ranges::find(paths, packed) != paths.end()) continue;
    }
    all_.push_back(read_character_file(path));
  }
  if (all_.empty()) {
    throw Error(ErrorCode::not_found,
                fmt::format("{}: no character (.glb) in this folder; studio/avatar/build makes some", folder.string()));
  }
}

SharedCharacter Characters::at(std::string_view name) const {
  std::vector<std::string> known;
  for (const SharedCharacter& one : all_) {
    if (one->name == name) return one;
    known.push_back(one->name);
  }
  throw Error(ErrorCode::not_found,
              all_.empty() ? fmt::format("no character '{}': the server has none", printable(name))
                           : fmt::format("no character '{}'{}", printable(name), did_you_mean(name, known)));
}

SignerStance stance_of(const Database& database, const RecordingInfo& recording) {
  const Snapshot snapshot = database.snapshot();
  const std::unique_ptr<MotionSource> source = snapshot.motion(recording);
  const std::int64_t all = source->frame_count();
  const std::int64_t looked_at = std::min(all, kBodyFrames);
  Motion some;
  some.reset(source->skeleton(), source->rate(), looked_at);
  for (std::int64_t i = 0; i < looked_at; ++i) {
    const std::int64_t frame = i * all / looked_at;
    source->read({frame, frame + 1}, some.poses({i, i + 1}));
  }
  SignerModel signer = model_of(some, recording.rig);
  return {std::move(signer), std::move(some)};
}

Motion on_character(const Motion& motion, const SignerStance& stance, const Character& character,
                    std::vector<Notice>& notices) {
  RetargetOptions options = options_for(stance.frames, stance.signer, character);
  options.face_joints = motion.tracks().empty();
  Retargeted shown = retarget(motion, stance.signer, character, options);
  notices.insert(notices.end(), shown.notices.begin(), shown.notices.end());
  return std::move(shown.motion);
}

}  // namespace signweave::calls
