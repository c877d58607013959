#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace signweave {

/// The form in which labels are compared: Unicode NFC, white space trimmed at both ends. Bytes that are not valid UTF-8
/// are only trimmed. Labels are always *stored* as they were written.
std::string match_form(std::string_view label);

/// True if `text` is valid UTF-8.
bool is_utf8(std::string_view text) noexcept;

/// Lower case of every letter of any script, in NFC: for searching, never for storage.
std::string fold_case(std::string_view text);

/// A form of a label that ignores spelling details: without case, accents (U+0300 to U+036F), width and other
/// compatibility variants (Unicode NFKD), ligatures (œ, æ) and kinds of apostrophe; white space becomes one blank. For
/// searching, never for storage.
std::string loose_form(std::string_view label);

/// The up to `most` entries of `known` that are nearest to `wanted` by edit distance over letters (case folded),
/// nearest first. Entries farther away than about a third of the length are left out.
std::vector<std::string> near_matches(std::string_view wanted, std::span<const std::string> known,
                                      std::size_t most = 3);

/// "A, B or C"
std::string either_of(std::span<const std::string> names);

/// Returns "; did you mean A, B or C?", or "" if there is no near match. For the end of an error's text.
std::string did_you_mean(std::string_view wanted, std::span<const std::string> known);

/// `text` made safe for a message of one line: control characters become `\xNN`, and it is cut after 80 characters.
std::string printable(std::string_view text);

/// `text` without white space (ASCII) at both ends.
std::string_view trimmed(std::string_view text) noexcept;

/// A number of bytes for people: "12.3 MiB".
std::string size_text(std::uint64_t bytes);

}  // namespace signweave
