#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/calls/evaluation_answer.h"
#include "signweave/drawing/error_plot.h"
#include "signweave/evaluation/bootstrap.h"
#include "signweave/evaluation/evaluate.h"

namespace signweave::calls {

/// One task that was evaluated.
struct EvaluatedTask {
  std::string name;  ///< "duration given"
  std::string key;   ///< in JSON: "given"
  std::vector<EvaluatedSpan> spans;
  std::vector<std::string> groups;              ///< [EvaluatedSpan::group]
  std::vector<MethodScores> methods;            ///< the default first; what bounds them at the end
  std::vector<Measure> summary;                 ///< what is told of every method
  std::vector<std::string> collections = {};    ///< names, ascending
  std::vector<std::size_t> collection_of = {};  ///< [recording]
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

/// Not a number where there is none.
inline double value_of(const std::optional<Estimate>& estimate) {
  return estimate ? estimate->value : std::numeric_limits<double>::quiet_NaN();
}
EstimateAnswer answer_of(const Estimate& estimate);

/// A figure of a method in a group; not a number where it is not known.
using GroupFigure = std::function<double(const MethodScores&, const ReportGroup&)>;
/// A table of one figure: rows are methods, columns groups. Methods without any number are left out; empty where all
/// are.
std::string method_table(const EvaluatedTask& task, std::span<const ReportGroup> groups, const std::string& title,
                         int decimals, const GroupFigure& figure);

/// How many spans there are, and a table for each of some measures, of the moving hand: rows are methods, columns
/// groups; for the wrist's error also over slerp's, for the fingertips' also over hermite's. What is the same for each
/// method is one row.
std::string summary_text(const EvaluatedTask& task, std::span<const Measure> chosen, Bootstrap& bootstrap);
/// All measures of the first method, which is the default: rows are measures, columns groups.
std::string default_text(const EvaluatedTask& task, Bootstrap& bootstrap);
/// Everything, with intervals: for each group and hand tables of some measures; rows are methods.
std::string full_text(const EvaluatedTask& task, Bootstrap& bootstrap);
/// The same as an answer.
TaskAnswer answer_of(const EvaluatedTask& task, Bootstrap& bootstrap);
/// Plots of some measures of a task; none of what it does not know.
std::vector<ErrorPanel> panels_of(const EvaluatedTask& task, std::span<const Measure> drawn, Bootstrap& bootstrap);

}  // namespace signweave::calls
