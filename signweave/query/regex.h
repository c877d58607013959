#pragma once

#include <re2/re2.h>

#include <memory>

#include "signweave/query/phase_query.h"

namespace signweave {

/// Compiled for labels in match form: the pattern is brought to NFC as they are. Check `ok()`. Linear in the label's
/// length whatever the pattern; its memory is bounded by RE2 (8 MiB).
std::unique_ptr<RE2> compile(const Regex& regex);

}  // namespace signweave
