#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/nonmanual/mouthing/letters.h"
#include "signweave/nonmanual/mouthing/phone.h"

namespace signweave {

/// Where pronunciations come from.
enum class MouthingSource {
  letters,  ///< rules of our own: the same on every machine
  espeak,   ///< the program espeak-ng, if there is one; otherwise letters, with a notice
  none,     ///< texts are not mouthed
};
std::string_view name_of(MouthingSource source) noexcept;
std::optional<MouthingSource> mouthing_source(std::string_view name) noexcept;

struct PronounceOptions {
  MouthingSource source = MouthingSource::letters;
  MouthingLanguage language = MouthingLanguage::fr;
  std::filesystem::path program = "espeak-ng";  ///< its name in the PATH, or a path
  Milliseconds patience{2000};                  ///< for each text
};

/// The longest text of one mouthing, in characters.
inline constexpr std::size_t kMostMouthed = 1000;

struct Pronunciation {
  std::string ipa;
  std::vector<Phone> phones;
  std::vector<Notice> notices;
};

/// Turns texts into what the mouth shows. After the first failure of the program it uses letters, so that there is one
/// notice and one delay. Not thread-safe.
class Pronouncer {
 public:
  explicit Pronouncer(PronounceOptions options = {}) : options_(std::move(options)) {}

  /// Throws Error{bad_input} for a text that is not UTF-8 or longer than kMostMouthed. A text without letters has no
  /// phones. `where` is the place of the text for errors and notices.
  Pronunciation pronounce(std::string_view text, const std::string& where);

 private:
  std::optional<std::string> by_program(std::string_view text, const std::string& where, std::vector<Notice>& notices);

  PronounceOptions options_;
  bool program_failed_ = false;
};

}  // namespace signweave
