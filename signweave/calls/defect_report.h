#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/answer.h"
#include "signweave/features/defects.h"

namespace signweave::calls {

/// A defect as answers contain it.
struct DefectRow {
  std::string_view kind;
  OrNull<std::string> joint;  ///< its name; none: the whole motion
  double value = 0;
  std::string text;
  std::optional<FrameRange> frames = {};  ///< none: all
};
template <class Visit>
void fields(Visit& visit, const DefectRow& row) {
  const FrameRange frames = row.frames.value_or(FrameRange());
  visit.type("Defect");
  visit(AnswerField{.name = "kind"}, row.kind);
  visit(AnswerField{.name = "joint", .help = "null: the whole motion"}, row.joint);
  visit(AnswerField{.name = "value"}, row.value);
  visit(AnswerField{.name = "text"}, row.text);
  visit(AnswerField{.name = "first_frame", .help = "missing: all frames"},
        given_if(row.frames.has_value(), frames.begin));
  visit(AnswerField{.name = "end_frame", .help = "the one after the last"},
        given_if(row.frames.has_value(), frames.end));
}

/// All defects. `skeleton` is the motion's.
std::vector<DefectRow> defect_rows(const std::vector<Defect>& defects, const Skeleton& skeleton);

/// Defects as a text table: kind, joint, frames, description; empty if there is none. Leaves out defects that a notice
/// of the reader already reports: a permuted root, an unusual unit.
std::string table_of(const std::vector<Defect>& defects, const Skeleton& skeleton, const std::vector<Notice>& notices);

}  // namespace signweave::calls
