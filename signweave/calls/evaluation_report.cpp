#include "signweave/calls/evaluation_report.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "signweave/calls/table.h"

namespace signweave::calls {
namespace {

using TextRows = std::vector<std::vector<std::string>>;

constexpr std::string_view kYardstick = "slerp";          // of the wrist's error
constexpr std::string_view kFingerYardstick = "hermite";  // of the fingertips'
constexpr std::size_t kColumns = 4;                       // measures of one table with intervals
constexpr HandChoice kHands[] = {HandChoice::moving, HandChoice::left, HandChoice::right};

std::string number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

/// "26.4 (20.1–31.9)".
std::string with_interval(const Estimate& estimate, int decimals) {
  if (!std::isfinite(estimate.value)) return "-";
  if (!std::isfinite(estimate.low)) return number(estimate.value, decimals);
  return fmt::format("{} ({}–{})", number(estimate.value, decimals), number(estimate.low, decimals),
                     number(estimate.high, decimals));
}

std::string title_of(const MeasureInfo& info) {
  return info.unit.empty() ? std::string(info.name) : fmt::format("{}, {}", info.name, info.unit);
}

/// The method that a measure is also given as a ratio to; empty if none.
std::string_view yardstick_of(Measure measure) {
  if (measure == Measure::wrist) return kYardstick;
  return measure == Measure::fingertips ? kFingerYardstick : std::string_view();
}

/// Whether a measure does not depend on the method: durations are predicted before a method is applied.
bool same_for_all(Measure measure) {
  return measure == Measure::duration || measure == Measure::mean_duration;
}

std::size_t recordings_of(const EvaluatedTask& task, const ReportGroup& group) {
  std::set<std::size_t> recordings;
  for (const std::size_t span : group.spans) recordings.insert(task.spans[span].recording);
  return recordings.size();
}

std::size_t collections_of(const EvaluatedTask& task, const ReportGroup& group) {
  std::set<std::size_t> collections;
  for (const std::size_t span : group.spans) collections.insert(task.collection_of[task.spans[span].recording]);
  return collections.size();
}

}  // namespace

EstimateAnswer answer_of(const Estimate& estimate) {
  const auto finite = [](double value) { return null_unless(std::isfinite(value), value); };
  return {.value = finite(estimate.value),
          .low = finite(estimate.low),
          .high = finite(estimate.high),
          .spans = estimate.scores,
          .recordings = estimate.clusters,
          .collections = estimate.collections};
}

std::vector<ReportGroup> groups_of(const EvaluatedTask& task, bool by_peaks) {
  std::vector<ReportGroup> groups;
  for (std::size_t group = 0; group < task.groups.size(); ++group) {
    ReportGroup all{task.groups[group], {}};
    ReportGroup one{fmt::format("{}, long, 1 peak", task.groups[group]), {}};
    ReportGroup several{fmt::format("{}, long, 2 or more peaks", task.groups[group]), {}};
    for (std::size_t i = 0; i < task.spans.size(); ++i) {
      if (task.spans[i].group != group) continue;
      all.spans.push_back(i);
      if (task.spans[i].is_long) (task.spans[i].peaks > 1 ? several : one).spans.push_back(i);
    }
    if (all.spans.empty()) continue;
    groups.push_back(std::move(all));
    if (!by_peaks) continue;
    if (!one.spans.empty()) groups.push_back(std::move(one));
    if (!several.spans.empty()) groups.push_back(std::move(several));
  }
  return groups;
}

Estimate estimate_of(const EvaluatedTask& task, const MethodScores& method, const ReportGroup& group, HandChoice hand,
                     Measure measure, Bootstrap& bootstrap) {
  std::vector<ClusteredScore> scores;
  scores.reserve(group.spans.size());
  for (const std::size_t span : group.spans) {
    const std::size_t recording = task.spans[span].recording;
    scores.push_back({.cluster = recording,
                      .score = method.spans[span].at(hand, measure),
                      .collection = task.collection_of[recording]});
  }
  return bootstrap.estimate(scores, info_of(measure).pooling);
}

std::optional<Estimate> ratio_to(const EvaluatedTask& task, const MethodScores& method, std::string_view other,
                                 const ReportGroup& group, HandChoice hand, Measure measure, Bootstrap& bootstrap) {
  for (const MethodScores& yardstick : task.methods) {
    if (yardstick.name != other) continue;
    std::vector<ClusteredScore> scores;
    for (const std::size_t span : group.spans) {
      const std::size_t recording = task.spans[span].recording;
      scores.push_back(
          {.cluster = recording,
           .score = {method.spans[span].at(hand, measure).value, yardstick.spans[span].at(hand, measure).value},
           .collection = task.collection_of[recording]});
    }
    return bootstrap.estimate(scores, Pooling::ratio);
  }
  return std::nullopt;
}

std::string method_table(const EvaluatedTask& task, std::span<const ReportGroup> groups, const std::string& title,
                         int decimals, const GroupFigure& figure) {
  TextRows rows = {{title}};
  for (const ReportGroup& group : groups) rows[0].push_back(group.name);
  for (const MethodScores& method : task.methods) {
    std::vector<std::string> row = {method.name};
    bool any = false;
    for (const ReportGroup& group : groups) {
      row.push_back(number(figure(method, group), decimals));
      any = any || row.back() != "-";
    }
    if (any) rows.push_back(std::move(row));
  }
  return rows.size() > 1 ? fmt::format("\n{}", format_table(rows)) : std::string();
}

std::string summary_text(const EvaluatedTask& task, std::span<const Measure> chosen, Bootstrap& bootstrap) {
  const std::vector<ReportGroup> groups = groups_of(task, false);
  if (groups.empty()) return fmt::format("{}: no span\n", task.name);
  TextRows counts = {{task.name}, {"spans"}, {"recordings"}, {"collections"}};
  for (const ReportGroup& group : groups) {
    counts[0].push_back(group.name);
    counts[1].push_back(std::to_string(group.spans.size()));
    counts[2].push_back(std::to_string(recordings_of(task, group)));
    counts[3].push_back(std::to_string(collections_of(task, group)));
  }
  if (task.collections.size() < 2) counts.pop_back();
  for (const Measure measure : chosen) {
    if (!same_for_all(measure)) continue;
    counts.push_back({title_of(info_of(measure))});
    for (const ReportGroup& group : groups) {
      counts.back().push_back(
          number(estimate_of(task, task.methods[0], group, HandChoice::moving, measure, bootstrap).value, 1));
    }
  }
  std::string text = format_table(counts);
  for (const Measure measure : chosen) {
    if (same_for_all(measure)) continue;
    const MeasureInfo& info = info_of(measure);
    text += method_table(task, groups, title_of(info), info.decimals,
                         [&](const MethodScores& method, const ReportGroup& group) {
                           return estimate_of(task, method, group, HandChoice::moving, measure, bootstrap).value;
                         });
    const std::string_view yardstick = yardstick_of(measure);
    if (yardstick.empty()) continue;
    text += method_table(
        task, groups, fmt::format("{} / {}", info.name, yardstick), 3,
        [&](const MethodScores& method, const ReportGroup& group) {
          return value_of(ratio_to(task, method, yardstick, group, HandChoice::moving, measure, bootstrap));
        });
  }
  return text;
}

std::string default_text(const EvaluatedTask& task, Bootstrap& bootstrap) {
  const std::vector<ReportGroup> groups = groups_of(task, false);
  if (groups.empty() || task.methods.empty()) return {};
  const MethodScores& method = task.methods[0];
  TextRows rows = {{method.name}};
  for (const ReportGroup& group : groups) rows[0].push_back(group.name);
  const auto add = [&](std::string title, int decimals, auto figure) {
    std::vector<std::string> row = {std::move(title)};
    for (const ReportGroup& group : groups) {
      const std::optional<Estimate> estimate = figure(group);
      row.push_back(estimate ? number(estimate->value, decimals) : "-");
    }
    if (std::any_of(row.begin() + 1, row.end(), [](const std::string& cell) { return cell != "-"; })) {
      rows.push_back(std::move(row));
    }
  };
  for (const MeasureInfo& info : measures()) {
    // Run times depend on the machine and the moment, so only the full report has them.
    if (same_for_all(info.measure) || info.measure == Measure::microseconds) continue;
    add(title_of(info), info.decimals, [&](const ReportGroup& group) {
      return std::optional(estimate_of(task, method, group, HandChoice::moving, info.measure, bootstrap));
    });
    const std::string_view yardstick = yardstick_of(info.measure);
    if (yardstick.empty()) continue;
    add(fmt::format("{} / {}", info.name, yardstick), 3, [&](const ReportGroup& group) {
      return ratio_to(task, method, yardstick, group, HandChoice::moving, info.measure, bootstrap);
    });
  }
  return fmt::format("\n{}", format_table(rows));
}

std::string full_text(const EvaluatedTask& task, Bootstrap& bootstrap) {
  std::string text;
  for (const ReportGroup& group : groups_of(task, true)) {
    for (const HandChoice hand : kHands) {
      text += fmt::format("\n{}, {}: {} hand, {} of {}\n", task.name, group.name, name_of(hand),
                          counted(group.spans.size(), "span"), counted(recordings_of(task, group), "recording"));
      TextRows columns;  // of each column: title, a cell for each method, number of spans
      const auto add = [&](const std::string& title, int decimals, auto figure) {
        std::vector<std::string> column = {title};
        std::size_t most = 0;
        for (const MethodScores& method : task.methods) {
          const std::optional<Estimate> estimate = figure(method);
          column.push_back(estimate ? with_interval(*estimate, decimals) : "-");
          if (estimate) most = std::max(most, estimate->scores);
        }
        column.push_back(std::to_string(most));
        if (most > 0) columns.push_back(std::move(column));
      };
      for (const MeasureInfo& info : measures()) {
        add(title_of(info), info.decimals, [&](const MethodScores& method) {
          return std::optional(estimate_of(task, method, group, hand, info.measure, bootstrap));
        });
        const std::string_view yardstick = yardstick_of(info.measure);
        if (yardstick.empty()) continue;
        add(fmt::format("{} / {}", info.name, yardstick), 3, [&](const MethodScores& method) {
          return ratio_to(task, method, yardstick, group, hand, info.measure, bootstrap);
        });
      }
      for (std::size_t first = 0; first < columns.size(); first += kColumns) {
        TextRows rows = {{""}};
        for (const MethodScores& method : task.methods) rows.push_back({method.name});
        rows.push_back({"spans"});
        for (std::size_t i = first; i < std::min(columns.size(), first + kColumns); ++i) {
          for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(columns[i][row]);
        }
        // A method without a number in a table is left out of it.
        std::erase_if(rows, [](const std::vector<std::string>& row) {
          return std::all_of(row.begin() + 1, row.end(), [](const std::string& cell) { return cell == "-"; });
        });
        text += format_table(rows);
      }
    }
  }
  return text;
}

namespace {

/// The values of a method in a group for one hand. Measures without a score are left out.
FiguresAnswer figures_of(const EvaluatedTask& task, const ReportGroup& group, HandChoice hand,
                         const MethodScores& method, Bootstrap& bootstrap) {
  FiguresAnswer figures;
  for (const MeasureInfo& info : measures()) {
    const Estimate estimate = estimate_of(task, method, group, hand, info.measure, bootstrap);
    if (estimate.scores == 0) continue;
    MeasureAnswer answer{.estimate = answer_of(estimate), .unit = {}, .over = {}};
    if (!info.unit.empty()) answer.unit = info.unit;
    if (const std::string_view yardstick = yardstick_of(info.measure); !yardstick.empty()) {
      if (const auto ratio = ratio_to(task, method, yardstick, group, hand, info.measure, bootstrap)) {
        answer.over.emplace(yardstick, answer_of(*ratio));
      }
    }
    figures.emplace_back(info.name, std::move(answer));
  }
  return figures;
}

}  // namespace

TaskAnswer answer_of(const EvaluatedTask& task, Bootstrap& bootstrap) {
  TaskAnswer answer{.task = task.key, .groups = {}};
  for (const ReportGroup& group : groups_of(task, true)) {
    GroupAnswer one{.group = group.name,
                    .spans = group.spans.size(),
                    .recordings = recordings_of(task, group),
                    .collections = collections_of(task, group),
                    .hands = {}};
    for (const HandChoice hand : kHands) {
      std::vector<std::pair<std::string, FiguresAnswer>> methods;
      for (const MethodScores& method : task.methods) {
        methods.emplace_back(method.name, figures_of(task, group, hand, method, bootstrap));
      }
      one.hands.emplace_back(name_of(hand), std::move(methods));
    }
    answer.groups.push_back(std::move(one));
  }
  return answer;
}

std::vector<ErrorPanel> panels_of(const EvaluatedTask& task, std::span<const Measure> drawn, Bootstrap& bootstrap) {
  const std::vector<ReportGroup> groups = groups_of(task, false);
  std::vector<ErrorPanel> panels;
  const auto add = [&](const std::string& what, auto figure) {
    ErrorPanel panel{.title = fmt::format("{}: {}", task.name, what), .places = {}, .rows = {}};
    for (const ReportGroup& group : groups) panel.places.push_back(group.name);
    for (const MethodScores& method : task.methods) {
      ErrorRow row{.name = method.name, .marks = {}};
      bool any = false;
      for (const ReportGroup& group : groups) {
        const std::optional<Estimate> estimate = figure(method, group);
        row.marks.push_back(estimate ? ErrorMark{estimate->value, estimate->low, estimate->high} : ErrorMark{});
        any = any || std::isfinite(row.marks.back().value);
      }
      if (any) panel.rows.push_back(std::move(row));
    }
    if (!panel.rows.empty()) panels.push_back(std::move(panel));
  };
  for (const Measure measure : drawn) {
    const std::string_view yardstick = yardstick_of(measure);
    add(title_of(info_of(measure)), [&](const MethodScores& method, const ReportGroup& group) {
      return std::optional(estimate_of(task, method, group, HandChoice::moving, measure, bootstrap));
    });
    if (yardstick.empty()) continue;
    add(fmt::format("{} over {}'s", info_of(measure).name, yardstick),
        [&](const MethodScores& method, const ReportGroup& group) {
          return ratio_to(task, method, yardstick, group, HandChoice::moving, measure, bootstrap);
        });
  }
  return panels;
}

}  // namespace signweave::calls
