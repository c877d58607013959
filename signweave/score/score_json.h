#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "signweave/score/score.h"

namespace signweave {

/// The version of the JSON form that is written. Older ones are read.
inline constexpr int kScoreVersion = 1;

/// Bytes that a score's file may have; a sign takes about two thousand.
inline constexpr std::size_t kLargestScore = std::size_t{256} << 20;

/// A score as JSON, indented, with a line feed at its end. It reads back equal.
std::string json_of(const Score& score);
/// The same on one line, without a line feed.
std::string json_line_of(const Score& score);
/// The score that JSON stands for, checked (see check). Throws Error{bad_input, "FILE: WHERE: what"},
/// Error{unsupported} for a version that is newer.
Score score_from_json(std::string_view text, const std::string& file);

}  // namespace signweave
