#include "signweave/transition/learned.h"
#include "signweave/transition/model.h"

namespace signweave {

const TransitionModel& default_transition_model() noexcept {
  static const TransitionModel model{
#include "signweave/transition/transition_weights.inc"
  };
  return model;
}

}  // namespace signweave
