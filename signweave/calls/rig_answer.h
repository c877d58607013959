#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/core/answer.h"
#include "signweave/rig/rig_map.h"

namespace signweave::calls {

/// "name", "shape", "file", "none".
std::string_view name_of(Evidence evidence);

/// The joint of a part of the body.
struct PartAnswer {
  std::string joint;
  JointIndex index = 0;
  std::string_view evidence;
  double confidence = 0;                       ///< in [0, 1]
  std::optional<std::array<float, 3>> offset;  ///< metres, in the joint's space; of tips only
};
template <class Visit>
void fields(Visit& visit, const PartAnswer& part) {
  visit.type("RigPart");
  visit(AnswerField{.name = "joint"}, part.joint);
  visit(AnswerField{.name = "index"}, part.index);
  visit(AnswerField{.name = "evidence", .one_of = {"none", "name", "shape", "file"}}, part.evidence);
  visit(AnswerField{.name = "confidence", .help = "from 0 to 1"}, part.confidence);
  visit(AnswerField{.name = "offset", .help = "metres, in the joint's space; of tips only"}, part.offset);
}

/// The known parts of the body.
struct RigAnswer {
  std::string convention;  ///< "MotionBuilder", "CMU", …; empty if none fits
  bool sides_swapped = false;
  std::vector<std::pair<std::string, PartAnswer>> parts;  ///< by the part's name
  std::vector<std::string> notices;
};
template <class Visit>
void fields(Visit& visit, const RigAnswer& rig) {
  visit.type("Rig");
  visit(AnswerField{.name = "convention", .help = "the table of joint names that fits; empty: none"}, rig.convention);
  visit(AnswerField{.name = "sides_swapped"}, rig.sides_swapped);
  visit(AnswerField{.name = "parts"}, rig.parts);
  visit(AnswerField{.name = "notices"}, rig.notices);
}

RigAnswer rig_answer(const Skeleton& skeleton, const RigMap& map);

}  // namespace signweave::calls
