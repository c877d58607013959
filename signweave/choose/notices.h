#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/features/duration_fit.h"

/// What is reported of how something is signed, by a file and by a stream in the same words.
namespace signweave {

/// Of a sign of a candidate that is not signed.
Notice notice_left_out(const std::string& recording, const Sign& sign);
/// Where a method had no captured transition to go by.
std::optional<Notice> notice_without_captured(std::string_view method, std::size_t captured);
/// Where nothing in the database tells how long a transition lasts.
std::optional<Notice> notice_without_durations(const DurationFit& durations);

/// Names and values that documents of recordings declare of themselves, such as that shapes are placeholders.
using DeclarationSet = std::set<std::pair<std::string, std::string>>;
/// Adds what anything that is signed from a recording must declare.
void add_declarations(const RecordingInfo& recording, DeclarationSet& declarations);

}  // namespace signweave
