#include "app/cli/selection_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "signweave/calls/table.h"
#include "signweave/core/text.h"

namespace signweave::cli {
namespace {

constexpr std::size_t kMostOfPlace = 5;  ///< candidates shown per place: the rest is only counted

std::string label_of(const Candidate& candidate) {
  if (candidate.signs.empty() || !candidate.at_strokes) return "(piece)";
  if (candidate.signs.size() == 1) return candidate.gloss();
  return fmt::format("{}..{}", candidate.gloss(), candidate.signs.back().gloss);
}

/// A dot for a cost of zero, so that other costs stand out.
std::string cost_text(float cost) {
  return cost < 0.0005f ? "." : fmt::format("{:.3f}", cost);
}

/// The candidates of a place, cheapest first; among equal costs the chosen one is first.
std::vector<std::size_t> cheapest_first(const std::vector<CandidateCosts>& costs, std::size_t chosen) {
  std::vector<std::size_t> order(costs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (a == chosen || b == chosen) return a == chosen && b != chosen;
    return costs[a].cost < costs[b].cost;
  });
  return order;
}

std::vector<std::string> head_of() {
  std::vector<std::string> head = {"place", "", "gloss", "token", "recording", "at ms", "cost", "join"};
  for (std::size_t i = 0; i < kJoinTerms; ++i) head.emplace_back(name_of(static_cast<JoinTerm>(i)));
  head.emplace_back("unknown");
  head.emplace_back("target");
  for (std::size_t i = 0; i < kTargetTerms; ++i) head.emplace_back(name_of(static_cast<TargetTerm>(i)));
  return head;
}

std::vector<std::string> row_of(const Synthesized& made, std::size_t place, std::size_t index) {
  const Candidate& candidate = made.choices[place].candidates[index];
  const CandidateCosts& costs = made.selection.explained[place][index];
  const RecordingInfo& info = made.contents->recordings[candidate.recording];
  std::vector<std::string> row = {std::to_string(place + 1),
                                  made.selection.chosen[place] == index ? "*" : "",
                                  label_of(candidate),
                                  candidate.token > 0 ? std::to_string(candidate.token) : "",
                                  info.name,
                                  std::to_string(span_of(candidate.whole, info.clock).begin.count()),
                                  fmt::format("{:.3f}", costs.cost)};
  if (place == 0) {
    row.insert(row.end(), 2 + kJoinTerms, "-");
  } else if (costs.kept) {
    row.emplace_back("kept");
    row.insert(row.end(), kJoinTerms + 1, "-");
  } else {
    row.push_back(fmt::format("{:.3f}", costs.join_cost));
    for (const float term : costs.join) row.push_back(cost_text(term));
    row.push_back(cost_text(costs.join_unknown));
  }
  row.push_back(fmt::format("{:.3f}", costs.target_cost));
  for (const float term : costs.target) row.push_back(cost_text(term));
  return row;
}

/// Removes the columns of terms that are zero everywhere.
void drop_empty_columns(std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t kFirstTerm = 8;
  for (std::size_t column = rows.front().size(); column-- > kFirstTerm;) {
    const bool used = std::any_of(rows.begin() + 1, rows.end(), [&](const std::vector<std::string>& row) {
      return row.size() > column && row[column] != "." && row[column] != "-";
    });
    if (used || rows.front()[column] == "target") continue;
    for (std::vector<std::string>& row : rows) {
      if (row.size() > column) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
    }
  }
}

}  // namespace

void print_selection(const Synthesized& made, Io& io) {
  const Selection& selection = made.selection;
  std::vector<std::vector<std::string>> rows = {head_of()};
  for (std::size_t place = 0; place < made.choices.size(); ++place) {
    const std::vector<std::size_t> order = cheapest_first(selection.explained[place], selection.chosen[place]);
    const std::size_t shown = order.size() > kMostOfPlace + 1 ? kMostOfPlace : order.size();
    for (std::size_t i = 0; i < shown; ++i) rows.push_back(row_of(made, place, order[i]));
    if (shown == order.size()) continue;
    std::vector<std::string> rest = {std::to_string(place + 1), "", fmt::format("and {} more", order.size() - shown)};
    rest.resize(rows.front().size());
    rows.push_back(std::move(rest));
  }
  drop_empty_columns(rows);
  io.out << format_table(rows);
  std::vector<std::string> head = {"weight of"};
  std::vector<std::string> weights = {""};
  for (std::size_t i = 0; i < kJoinTerms; ++i) {
    head.emplace_back(name_of(static_cast<JoinTerm>(i)));
    weights.push_back(fmt::format("{:.3f}", selection.weights.weights[i]));
  }
  for (std::size_t i = 0; i < kTargetTerms; ++i) {
    head.emplace_back(name_of(static_cast<TargetTerm>(i)));
    weights.push_back(fmt::format("{:.3f}", kTargetWeights[i]));
  }
  io.out << '\n' << format_table({head, weights});
  io.out << fmt::format("weights of joins: {}\n", describe(selection.weights));
}

}  // namespace signweave::cli
