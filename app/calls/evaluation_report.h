#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "signweave/evaluation/bootstrap.h"
#include "signweave/evaluation/evaluate.h"
#include "signweave/formats/error_plot.h"

namespace signweave::calls {

/// One task that was evaluated.
struct EvaluatedTask {
  std::string name;  ///< "duration given"
  std::string key;   ///< in JSON: "given"
  std::vector<EvaluatedSpan> spans;
  std::vector<std::string> groups;    ///< [EvaluatedSpan::group]
  std::vector<MethodScores> methods;  ///< the default first; what bounds them at the end
  std::vector<Measure> summary;       ///< what is told of every method
};

/// Some spans of a task that are told together.
struct ReportGroup {
  std::string name;
  std::vector<std::size_t> spans;  ///< indices
};
/// The groups of a task that have spans; with `by_peaks`, those with long spans by how many speed peaks these have,
/// too.
std::vector<ReportGroup> groups_of(const EvaluatedTask& task, bool by_peaks);

/// Of one measure, of one method, over some spans, over another method's on the same spans; none where there is no such
/// method.
std::optional<Estimate> ratio_to(const EvaluatedTask& task, const MethodScores& method, std::string_view other,
                                 const ReportGroup& group, HandChoice hand, Measure measure, Bootstrap& bootstrap);
Estimate estimate_of(const EvaluatedTask& task, const MethodScores& method, const ReportGroup& group, HandChoice hand,
                     Measure measure, Bootstrap& bootstrap);

/// How many spans there are, and a table for each of some measures, of the moving hand: rows are methods, columns
/// groups; for the wrist's error also over slerp's, for the fingertips' also over hermite's. What is the same for each
/// method is one row.
std::string summary_text(const EvaluatedTask& task, std::span<const Measure> chosen, Bootstrap& bootstrap);
/// All measures of the first method, which is the default: rows are measures, columns groups.
std::string default_text(const EvaluatedTask& task, Bootstrap& bootstrap);
/// Everything, with intervals: for each group and hand tables of some measures; rows are methods.
std::string full_text(const EvaluatedTask& task, Bootstrap& bootstrap);
/// The same as JSON.
nlohmann::ordered_json json_of(const EvaluatedTask& task, Bootstrap& bootstrap);
/// Plots of some measures of a task; none of what it does not know.
std::vector<ErrorPanel> panels_of(const EvaluatedTask& task, std::span<const Measure> drawn, Bootstrap& bootstrap);

}  // namespace signweave::calls
