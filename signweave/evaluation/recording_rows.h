#pragma once

// What tables about recordings have in common: rows of CSV, of which a column names a recording.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/text_reader.h"
#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// The fields of the rest of a line of CSV, without blanks at their ends; a field may be quoted, and double quotes
/// stand for one inside. Throws Error{bad_input, "FILE:LINE: …"} for a quote that is not closed.
std::vector<std::string> csv_fields(TextReader& reader);

/// The recording that a row names: by its whole name, or by the end of it from a '/' on, with or without a motion
/// file's ending, for a recording of a database has none. Throws Error{bad_input, "FILE:LINE: …"} where several are
/// named so, and where none is, with near names.
std::size_t recording_named(const std::string& name, std::span<const EvaluatedMotion> recordings,
                            const TextReader& reader);

/// Whether a row that names `name` means the recording that is called `whole`.
bool names_recording(const std::string& name, const std::string& whole);

}  // namespace signweave
