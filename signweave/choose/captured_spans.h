#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "signweave/database/database.h"
#include "signweave/transition/joint_groups.h"
#include "signweave/transition/method.h"
#include "signweave/transition/model.h"

namespace signweave {

/// Limits on the captured spans read from a corpus, evenly spread, so that the cost is bounded in a large one.
inline constexpr std::size_t kMostSpanRecordings = 24;
inline constexpr std::size_t kMostSpanTransitions = 400;
/// Longer annotated transitions usually contain more than one movement and are skipped. (ours)
inline constexpr Seconds kLongestSpan{3.0};

/// The data that a method needs from a corpus.
struct CapturedSpans {
  std::shared_ptr<const TransitionModel> model;  ///< the default model with these spans and the learned residuals
  std::size_t transitions = 0;                   ///< number of transitions that the spans come from
};

/// Collects the annotated transitions (see transitions_in) of recordings with the same joints as `skeleton`, whose
/// groups are `groups`: each from the last stroke frame of one sign to the first of the next, and additionally its
/// middle half, for the gaps that remain if parts of both sides are kept. Their frames and kContext on both sides are
/// read. Damaged recordings are skipped, and so is `without`: a method that is evaluated on a recording must not have
/// seen it. Adds the learned residuals (Learned::residuals) unless `without` is given; only those if `needs` requests
/// no spans.
CapturedSpans captured_spans(const Snapshot& snapshot, const Skeleton& skeleton, const JointGroups& groups, Needs needs,
                             std::string_view without = {});

}  // namespace signweave
