#pragma once

// Common functions for CSV tables about recordings, in which a column names a recording.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/text_reader.h"
#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// The fields of the rest of a CSV line, trimmed. A field may be quoted; two double quotes inside it mean one. Throws
/// Error{bad_input, "FILE:LINE: …"} for an unclosed quote.
std::vector<std::string> csv_fields(TextReader& reader);

/// The index of the recording that a row names: by its full name, or by the end of it after a '/', with or without a
/// motion file's extension, because recordings of a database have none. Throws Error{bad_input, "FILE:LINE: …"} if
/// several match, or if none does, with near names.
std::size_t recording_named(const std::string& name, std::span<const EvaluatedMotion> recordings,
                            const TextReader& reader);

/// True if `name` in a row refers to the recording `whole`.
bool names_recording(const std::string& name, const std::string& whole);

}  // namespace signweave
