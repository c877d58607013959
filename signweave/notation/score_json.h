#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "signweave/score/score.h"

namespace signweave {

/// The newest version of the JSON format. Older versions can be read, and a score is written in the oldest one that can
/// hold it: version 2 added holds, clips of single channels, and the lanes of fingers and head, version 3 clips that
/// are changed in space.
inline constexpr int kScoreVersion = 3;
int version_of(const Score& score) noexcept;

/// Maximum size of a score file in bytes; a sign takes about two thousand.
inline constexpr std::size_t kLargestScore = std::size_t{256} << 20;

/// A score as indented JSON that ends with a line feed. Reading it back gives an equal score.
std::string json_of(const Score& score);
/// The same on one line, without a line feed.
std::string json_line_of(const Score& score);
/// Parses and checks a score (see check). Throws Error{bad_input, "FILE: WHERE: what"}, Error{unsupported} for a newer
/// version.
Score score_from_json(std::string_view text, const std::string& file);

}  // namespace signweave
