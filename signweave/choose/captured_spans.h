#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "signweave/database/database.h"
#include "signweave/transition/joint_groups.h"
#include "signweave/transition/method.h"
#include "signweave/transition/model.h"

namespace signweave {

/// No more of a corpus is looked at for captured spans: evenly spread, so that it costs the same in a large one.
inline constexpr std::size_t kMostSpanRecordings = 24;
inline constexpr std::size_t kMostSpanTransitions = 400;
/// An annotated transition that lasts longer hides more than one movement. (ours)
inline constexpr Seconds kLongestSpan{3.0};

/// What a method needs of a corpus.
struct CapturedSpans {
  std::shared_ptr<const TransitionModel> model;  ///< the default one, with these spans and what movements taught
  std::size_t transitions = 0;                   ///< that they are of
};

/// The annotated transitions (see transitions_in) of recordings with the same joints as `skeleton`, whose groups these
/// are: each from the last stroke frame of one sign to the first of the next, and once more its middle half, for the
/// gaps that are left where some of both sides is kept. Read are their frames and kContext on both sides. A recording
/// that is damaged is left out, and so is the one named `without`: a method that is judged by a recording must not have
/// seen it. Beside them what movements taught (Learned::residuals), unless one is named; that alone where `needs` asks
/// for no spans.
CapturedSpans captured_spans(const Snapshot& snapshot, const Skeleton& skeleton, const JointGroups& groups, Needs needs,
                             std::string_view without = {});

}  // namespace signweave
