#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/database/plan_input.h"
#include "signweave/database/plan_motion.h"

/// Internal to `database`: the part of an import plan about the clock that ties frames to annotation time.
namespace signweave {

struct PlannedClock {
  FrameClock clock;
  bool given = false;  ///< now or at an earlier import; else it follows from the files
};

/// Returns the clock as given now; else as given before; else as the document states; else both begin together. Throws
/// Error{bad_input} for a clock that no recording can have.
PlannedClock plan_clock(const PlanInput& input, const PlannedMotion& motion,
                        const std::optional<AnnotationDocument>& document);

/// Adds a notice if signs lie outside of the motion: they can be found but not signed.
void report_uncovered(const std::vector<Sign>& signs, const FrameClock& clock, std::int64_t frames,
                      const std::string& where, std::vector<Notice>& notices);

}  // namespace signweave
