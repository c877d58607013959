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
  std::vector<MethodScores> methods;            ///< the default first; the bounds at the end
  std::vector<Measure> summary;                 ///< the measures reported for every method
  std::vector<std::string> collections = {};    ///< names, ascending
  std::vector<std::size_t> collection_of = {};  ///< [recording]
};

/// Spans of a task that are reported together.
struct ReportGroup {
  std::string name;
  std::vector<std::size_t> spans;  ///< indices
};
/// The groups of a task that have spans; with `by_peaks`, groups of long spans are also split by their number of speed
/// peaks.
std::vector<ReportGroup> groups_of(const EvaluatedTask& task, bool by_peaks);

/// The ratio of a method's measure to another method's on the same spans; none if there is no such method.
std::optional<Estimate> ratio_to(const EvaluatedTask& task, const MethodScores& method, std::string_view other,
                                 const ReportGroup& group, HandChoice hand, Measure measure, Bootstrap& bootstrap);
Estimate estimate_of(const EvaluatedTask& task, const MethodScores& method, const ReportGroup& group, HandChoice hand,
                     Measure measure, Bootstrap& bootstrap);

/// Returns NaN if there is none.
inline double value_of(const std::optional<Estimate>& estimate) {
  return estimate ? estimate->value : std::numeric_limits<double>::quiet_NaN();
}
EstimateAnswer answer_of(const Estimate& estimate);

/// A value of a method in a group; NaN if unknown.
using GroupFigure = std::function<double(const MethodScores&, const ReportGroup&)>;
/// A table of one value: rows are methods, columns groups. Methods without any number are left out; empty if all are.
std::string method_table(const EvaluatedTask& task, std::span<const ReportGroup> groups, const std::string& title,
                         int decimals, const GroupFigure& figure);

/// The number of spans, and a table of the moving hand for each chosen measure: rows are methods, columns groups. The
/// wrist error also has a table of ratios to slerp, that of the fingertips to hermite. A measure that is the same for
/// all methods has one row.
std::string summary_text(const EvaluatedTask& task, std::span<const Measure> chosen, Bootstrap& bootstrap);
/// All measures of the first method, the default: rows are measures, columns groups.
std::string default_text(const EvaluatedTask& task, Bootstrap& bootstrap);
/// Everything, with intervals: for each group and hand, tables with a few measures each; rows are methods.
std::string full_text(const EvaluatedTask& task, Bootstrap& bootstrap);
/// The same as an answer.
TaskAnswer answer_of(const EvaluatedTask& task, Bootstrap& bootstrap);
/// Plots of the given measures of a task, except those without values.
std::vector<ErrorPanel> panels_of(const EvaluatedTask& task, std::span<const Measure> drawn, Bootstrap& bootstrap);

}  // namespace signweave::calls
