#include "app/calls/defect_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/calls/table.h"
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

/// "0", "12..40", the last one inclusive as people count.
std::string frames_of(const Defect& defect) {
  if (defect.frames.empty()) return "all";
  if (defect.frames.size() == 1) return std::to_string(defect.frames.begin);
  return fmt::format("{}..{}", defect.frames.begin, defect.frames.end - 1);
}

}  // namespace

nlohmann::json json_of(const std::vector<Defect>& defects, const Skeleton& skeleton) {
  nlohmann::json list = nlohmann::json::array();
  for (const Defect& defect : defects) {
    nlohmann::json one = {
        {"kind", name_of(defect.kind)}, {"joint", nullptr}, {"value", defect.value}, {"text", defect.text}};
    if (defect.joint != kNoJoint) one["joint"] = skeleton.joint(defect.joint).name;
    if (!defect.frames.empty()) {
      one["first_frame"] = defect.frames.begin;
      one["end_frame"] = defect.frames.end;
    }
    list.push_back(std::move(one));
  }
  return list;
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
