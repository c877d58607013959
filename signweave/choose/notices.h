#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "signweave/annotation/declarations.h"
#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/features/duration_fit.h"

/// Notices about a synthesis, with the same text for files and streams.
namespace signweave {

/// Reports a sign of a candidate that is left out.
Notice notice_left_out(const std::string& recording, const Sign& sign);
/// Returns a notice if a method had no captured transitions to use.
std::optional<Notice> notice_without_captured(std::string_view method, std::size_t captured);
/// Returns a notice if the database does not determine the duration of transitions.
std::optional<Notice> notice_without_durations(const DurationFit& durations);

/// Adds the declarations that must accompany everything signed from a recording. `declarations` is sorted, each is in
/// it once, and it stays so.
void add_declarations(const RecordingInfo& recording, Declarations& declarations);

}  // namespace signweave
