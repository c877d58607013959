#include "signweave/calls/lists_call.h"

#include "signweave/annotation/sign.h"
#include "signweave/score/transition.h"

namespace signweave::calls {

std::vector<MethodRow> method_rows() {
  std::vector<MethodRow> rows;
  for (const TransitionMethod& method : transition_methods()) rows.push_back({method.name, method.description});
  return rows;
}

std::vector<PhaseRow> phase_rows() {
  return {{name_of(PhaseKind::preparation), "the hands move to the start of the stroke"},
          {name_of(PhaseKind::stroke), "the part that carries the meaning"},
          {name_of(PhaseKind::hold), "the hands keep still"},
          {name_of(PhaseKind::retraction), "the hands move away or rest"}};
}

const std::vector<UnitRow>& unit_rows() {
  static const std::vector<UnitRow> rows = {{"cm", 0.01}, {"m", 1}, {"mm", 0.001}, {"in", 0.0254}};
  return rows;
}

}  // namespace signweave::calls
