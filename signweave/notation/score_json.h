#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "signweave/score/score.h"

namespace signweave {

/// The version of the JSON format that is written. Older versions can be read.
inline constexpr int kScoreVersion = 1;

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
