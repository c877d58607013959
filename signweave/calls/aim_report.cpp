#include "signweave/calls/aim_report.h"

#include <fmt/format.h>

#include <functional>
#include <numbers>
#include <vector>

#include "signweave/calls/table.h"

namespace signweave::calls {
namespace {

using PicksScore = std::function<bool(const AimScore&)>;

/// Adds a mean row of the scores of one method, if there are any.
void add_aim_row(const AimEvaluation& evaluation, AimMethod method, bool near, const PicksScore& picks,
                 std::vector<AimRowAnswer>& rows) {
  AimRowAnswer row{.method = name_of(method), .near = near};
  double expected = 0;
  for (const AimScore& score : evaluation.scores) {
    if (score.method != method || score.near != near || !picks(score)) continue;
    ++row.predictions;
    if (score.share < 1) ++row.unreached;
    row.end_mm += score.errors.end_mm;
    row.path_mm += score.errors.path_mm;
    row.aim_degrees += score.errors.aim_degrees;
    row.turn_degrees += score.errors.turn_degrees;
    row.shape_mm += score.errors.shape_mm;
    expected += score.expected_mm;
  }
  if (row.predictions == 0) return;
  const auto count = static_cast<double>(row.predictions);
  for (double* const sum : {&row.end_mm, &row.path_mm, &row.aim_degrees, &row.turn_degrees, &row.shape_mm}) {
    *sum /= count;
  }
  row.expected_mm = null_unless(expected > 0, expected / count);
  rows.push_back(row);
}

std::vector<AimRowAnswer> aim_rows(const AimEvaluation& evaluation, const PicksScore& picks) {
  std::vector<AimRowAnswer> rows;
  for (std::size_t i = 0; i < kAimMethods; ++i) {
    for (const bool near : {true, false}) add_aim_row(evaluation, static_cast<AimMethod>(i), near, picks, rows);
  }
  if (rows.empty() || rows.back().method != name_of(AimMethod::floor)) return rows;
  // Two repetitions differ by the square root of two more than one from their mean.
  const double floor = rows.back().path_mm;
  for (AimRowAnswer& row : rows) {
    row.path_over_floor = null_unless(floor > 0, row.path_mm / floor);
    row.path_over_noise = null_unless(floor > 0, std::numbers::sqrt2 * row.path_mm / floor);
  }
  return rows;
}

std::string text_of(const OrNull<double>& value, int decimals) {
  return value.value ? fmt::format("{:.{}f}", *value.value, decimals) : std::string("-");
}

std::string aim_table(const std::string& title, const std::vector<AimRowAnswer>& rows) {
  std::vector<std::vector<std::string>> cells = {{title, "loci", "n", "end mm", "path mm", "/ floor", "/ noise",
                                                  "aim °", "turn °", "shape mm", "expected mm", "unreached"}};
  for (const AimRowAnswer& row : rows) {
    cells.push_back({std::string(row.method), row.near ? "near" : "far", std::to_string(row.predictions),
                     fmt::format("{:.1f}", row.end_mm), fmt::format("{:.1f}", row.path_mm),
                     text_of(row.path_over_floor, 2), text_of(row.path_over_noise, 2),
                     fmt::format("{:.1f}", row.aim_degrees), fmt::format("{:.1f}", row.turn_degrees),
                     fmt::format("{:.1f}", row.shape_mm), text_of(row.expected_mm, 1), std::to_string(row.unreached)});
  }
  return format_table(cells);
}

}  // namespace

AimAnswer aim_answer(const AimEvaluation& evaluation) {
  AimAnswer answer{.all = aim_rows(evaluation, [](const AimScore&) { return true; }),
                   .glosses = {},
                   .tokens_left_out = evaluation.left_out};
  for (std::size_t i = 0; i < evaluation.glosses.size(); ++i) {
    const AimEvaluation::Gloss& gloss = evaluation.glosses[i];
    const PicksScore of_gloss = [&](const AimScore& score) { return evaluation.tokens[score.token].gloss == i; };
    answer.glosses.push_back({.gloss = gloss.name,
                              .role = name_of(gloss.role),
                              .tokens = gloss.tokens,
                              .with_loci = gloss.with_loci,
                              .why_not_learned = given_if(!gloss.why_not_learned.empty(), gloss.why_not_learned),
                              .rows = aim_rows(evaluation, of_gloss)});
  }
  return answer;
}

std::string aim_text(const AimAnswer& answer) {
  if (answer.all.empty()) {
    return "no gloss has two tokens at different places, or with loci in tiers From, To or At\n";
  }
  std::string text = "\n" + aim_table("all", answer.all);
  for (const AimGlossAnswer& gloss : answer.glosses) {
    if (gloss.rows.empty()) continue;
    text += fmt::format("\n{}, {}, {}, {} with loci\n{}", gloss.gloss, gloss.role, counted(gloss.tokens, "token"),
                        gloss.with_loci, aim_table("", gloss.rows));
    if (gloss.why_not_learned) text += fmt::format("not learned: {}\n", *gloss.why_not_learned);
  }
  return text;
}

}  // namespace signweave::calls
