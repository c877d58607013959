#pragma once

#include <re2/re2.h>

#include <memory>

#include "signweave/query/phase_query.h"

namespace signweave {

/// Compiles a pattern for labels in match form: the pattern is normalised to NFC as they are. The caller must check
/// `ok()`. Matching is linear in the label's length for every pattern; memory is bounded by RE2 (8 MiB).
std::unique_ptr<RE2> compile(const Regex& regex);

}  // namespace signweave
