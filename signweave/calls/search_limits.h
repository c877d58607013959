#pragma once

#include <cstdint>

#include "signweave/calls/field.h"

namespace signweave::calls {

/// Describes the members `limit` and `timeout_ms` of a call that searches.
template <class Visit, class Call>
void limit_fields(Visit& visit, Call& call) {
  visit(Field{.name = "limit",
              .help = "at most so many answers",
              .range = Range{std::int64_t{1}, std::int64_t{1'000'000'000}}},
        call.limit);
  visit(Field{.name = "timeout_ms",
              .help = "give up after so many ms",
              .words = "timeout",
              .range = Range{std::int64_t{1}, std::int64_t{1'000'000'000}}},
        call.timeout_ms);
}

}  // namespace signweave::calls
