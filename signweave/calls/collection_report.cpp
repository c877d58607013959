#include "signweave/calls/collection_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "signweave/calls/table.h"
#include "signweave/evaluation/judge.h"
#include "signweave/transition/method.h"

namespace signweave::calls {
namespace {

using TextRows = std::vector<std::vector<std::string>>;

const MethodScores* scores_of(const EvaluatedTask& task, std::string_view name) {
  const auto found = std::ranges::find(task.methods, name, &MethodScores::name);
  return found == task.methods.end() ? nullptr : &*found;
}

bool signs(const MethodScores& method) {
  const GapMethod* const known = find_gap_method(method.name);
  return known != nullptr && known->offered == Offered::signing;
}

/// The methods that `sign` offers, compared with kriging.
std::vector<Judgement> judgements_of(const EvaluatedTask& task, Bootstrap& bootstrap) {
  std::vector<Judgement> judgements;
  const MethodScores* const other = scores_of(task, kReferenceMethod);
  if (other == nullptr || task.spans.empty()) return judgements;
  for (const MethodScores& method : task.methods) {
    if (!signs(method) || &method == other) continue;
    judgements.push_back(judge(method, *other, task.spans, task.collection_of, task.collections.size(), bootstrap));
  }
  return judgements;
}

std::string cell_of(const Estimate& estimate) {
  if (!std::isfinite(estimate.value)) return "-";
  if (!std::isfinite(estimate.low)) return fmt::format("{:.3f}", estimate.value);
  return fmt::format("{:.3f} ({:.2f}–{:.2f})", estimate.value, estimate.low, estimate.high);
}

/// The mean over the collections of the median over their spans.
double median_of(const EvaluatedTask& task, const MethodScores& method, const ReportGroup& group) {
  std::map<std::size_t, std::vector<double>> errors;
  for (const std::size_t span : group.spans) {
    const double error = method.spans[span].at(HandChoice::moving, Measure::wrist).value;
    if (std::isfinite(error)) errors[task.collection_of[task.spans[span].recording]].push_back(error);
  }
  double sum = 0;
  for (auto& [collection, of] : errors) {
    const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
    std::ranges::nth_element(of, middle);
    double median = *middle;
    if (of.size() % 2 == 0) median = 0.5 * (median + *std::max_element(of.begin(), middle));
    sum += median;
  }
  return sum / static_cast<double>(errors.size());
}

/// The ratio of the first method's error to slerp's: rows are collections.
std::string default_by_collection(const EvaluatedTask& task, const std::vector<ReportGroup>& groups,
                                  Bootstrap& bootstrap) {
  const MethodScores& method = task.methods.front();
  TextRows rows = {{fmt::format("{} / slerp, by collection", method.name)}};
  for (const ReportGroup& group : groups) rows[0].push_back(group.name);
  for (std::size_t collection = 0; collection < task.collections.size(); ++collection) {
    std::vector<std::string> row = {task.collections[collection]};
    for (const ReportGroup& group : groups) {
      ReportGroup part{group.name, {}};
      for (const std::size_t span : group.spans) {
        if (task.collection_of[task.spans[span].recording] == collection) part.spans.push_back(span);
      }
      const auto ratio = ratio_to(task, method, "slerp", part, HandChoice::moving, Measure::wrist, bootstrap);
      const bool known = ratio && std::isfinite(ratio->value);
      row.push_back(known ? fmt::format("{:.3f} (n={})", ratio->value, ratio->scores) : "-");
    }
    rows.push_back(std::move(row));
  }
  return fmt::format("\n{}", format_table(rows));
}

}  // namespace

std::string judged_text(const EvaluatedTask& task, Bootstrap& bootstrap) {
  const std::vector<Judgement> judgements = judgements_of(task, bootstrap);
  if (judgements.empty()) return {};
  const bool several = task.collections.size() > 1;
  TextRows rows = {{fmt::format("wrist / {}, all groups", kReferenceMethod)}};
  if (several) rows[0].insert(rows[0].end(), task.collections.begin(), task.collections.end());
  rows[0].emplace_back("all");
  rows[0].emplace_back("may be the default");
  for (const Judgement& one : judgements) {
    std::vector<std::string> row = {one.method};
    if (several) {
      for (const Estimate& estimate : one.collections) row.push_back(cell_of(estimate));
    }
    row.push_back(cell_of(one.all));
    row.emplace_back(one.wins() ? "yes" : one.worse_in().empty() ? "no: not better" : "no: worse");
    rows.push_back(std::move(row));
  }
  std::string text = fmt::format("\n{}", format_table(rows));
  std::vector<ReportGroup> groups = groups_of(task, false);
  if (several) text += default_by_collection(task, groups, bootstrap);
  text += method_table(task, groups, "wrist, mm, median", 1, [&](const MethodScores& method, const ReportGroup& group) {
    return median_of(task, method, group);
  });
  groups = groups_of(task, true);
  std::erase_if(groups, [](const ReportGroup& group) { return group.name.find(", long") == std::string::npos; });
  if (groups.empty()) return text;
  return text + method_table(task, groups, "wrist / slerp, by speed peaks", 3,
                             [&](const MethodScores& method, const ReportGroup& group) {
                               return value_of(ratio_to(task, method, "slerp", group, HandChoice::moving,
                                                        Measure::wrist, bootstrap));
                             });
}

std::vector<JudgedAnswer> judged_answers(const EvaluatedTask& task, Bootstrap& bootstrap) {
  std::vector<JudgedAnswer> list;
  for (const Judgement& one : judgements_of(task, bootstrap)) {
    JudgedAnswer answer{.method = one.method,
                        .over = std::string(kReferenceMethod),
                        .all = answer_of(one.all),
                        .collections = {},
                        .may_be_default = one.wins()};
    for (std::size_t i = 0; i < one.collections.size(); ++i) {
      answer.collections.push_back({.collection = task.collections[i], .estimate = answer_of(one.collections[i])});
    }
    list.push_back(std::move(answer));
  }
  return list;
}

}  // namespace signweave::calls
