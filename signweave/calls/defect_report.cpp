#include "signweave/calls/defect_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "signweave/calls/table.h"
#include "signweave/core/text.h"

namespace signweave::calls {
namespace {

bool any_says(const std::vector<Notice>& notices, std::string_view words) {
  return std::any_of(notices.begin(), notices.end(),
                     [&](const Notice& notice) { return notice.text.find(words) != std::string::npos; });
}

bool is_said(const Defect& defect, const std::vector<Notice>& notices) {
  if (defect.kind == DefectKind::permuted_root) return any_says(notices, "look permuted");
  if (defect.kind == DefectKind::scale) return any_says(notices, "unusual") || any_says(notices, "may well be wrong");
  return false;
}

/// "0" or "12..40", with an inclusive end.
std::string frames_of(const Defect& defect) {
  if (defect.frames.empty()) return "all";
  if (defect.frames.size() == 1) return std::to_string(defect.frames.begin);
  return fmt::format("{}..{}", defect.frames.begin, defect.frames.end - 1);
}

}  // namespace

std::vector<DefectRow> defect_rows(const std::vector<Defect>& defects, const Skeleton& skeleton) {
  std::vector<DefectRow> rows;
  for (const Defect& defect : defects) {
    rows.push_back({.kind = name_of(defect.kind), .joint = {}, .value = defect.value, .text = defect.text});
    if (defect.joint != kNoJoint) rows.back().joint.value = skeleton.joint(defect.joint).name;
    if (!defect.frames.empty()) rows.back().frames = defect.frames;
  }
  return rows;
}

std::string table_of(const std::vector<Defect>& defects, const Skeleton& skeleton, const std::vector<Notice>& notices) {
  std::vector<std::vector<std::string>> rows = {{"defect", "joint", "frames", "what"}};
  for (const Defect& defect : defects) {
    if (is_said(defect, notices)) continue;
    rows.push_back({std::string(name_of(defect.kind)),
                    defect.joint == kNoJoint ? "-" : printable(skeleton.joint(defect.joint).name), frames_of(defect),
                    defect.text});
  }
  return rows.size() == 1 ? std::string() : format_table(rows);
}

}  // namespace signweave::calls
