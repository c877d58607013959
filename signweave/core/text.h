#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace signweave {

/// The form in which labels are compared: Unicode NFC, white space trimmed at both ends. Bytes that are not UTF-8 are
/// returned trimmed and otherwise as they are. Labels are always *stored* as they were written.
std::string match_form(std::string_view label);

/// True where `text` is valid UTF-8.
bool is_utf8(std::string_view text) noexcept;

/// Lower case of every letter of any script, in NFC: for finding, never for storing.
std::string fold_case(std::string_view text);

/// What a label is where its spelling does not matter: without case, accents (U+0300 to U+036F), width and other
/// variants of compatibility (Unicode NFKD), ligatures (œ, æ) and kinds of apostrophe; one blank for white space.
/// For finding, never for storing.
std::string loose_form(std::string_view label);

/// At most `most` of `known` that are nearest to `wanted` by edit distance over letters (case folded), nearest first;
/// those farther than about a third of the length are left out.
std::vector<std::string> near_matches(std::string_view wanted, std::span<const std::string> known,
                                      std::size_t most = 3);

/// "A, B or C"
std::string either_of(std::span<const std::string> names);

/// "; did you mean A, B or C?", or nothing where there is no near match. For the end of an error's text.
std::string did_you_mean(std::string_view wanted, std::span<const std::string> known);

/// `text` as it may stand in a message of one line: control characters as `\xNN`, cut after 80 characters.
std::string printable(std::string_view text);

/// Without the white space (ASCII) at both ends.
std::string_view trimmed(std::string_view text) noexcept;

/// A number of bytes for people: "12.3 MiB".
std::string size_text(std::uint64_t bytes);

}  // namespace signweave
