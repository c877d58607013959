#include "signweave/calls/query_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/query/explain.h"
#include "signweave/query/find.h"
#include "signweave/query/parse.h"

namespace signweave::calls {

namespace {

/// Rounds to 0.0001: further digits of a float are noise.
double rounded(float distance) {
  return std::round(static_cast<double>(distance) * 1e4) / 1e4;
}

QueryReport found_words(const Database& database, const QueryCall& call, const std::vector<std::string>& words,
                        const FindLimits& limits) {
  const std::shared_ptr<const Segments> segments = database.segments();
  QueryReport report;
  for (WordAnswer& one : find_words(words, *segments, limits)) {
    report.answers.push_back(std::move(one.segment));
    report.matches.push_back(one.match);
  }
  if (call.explain) {
    report.plan = fmt::format(
        "Words, not a query: {}.\nFinds signs of that gloss, then of other spellings, sequences of one sign per word, "
        "glosses that\ncontain the words, and annotations of other tiers; if there are none, signs of any of the "
        "words.\n"
        "In fact: {} answers.\n",
        fmt::join(words, ", "), report.answers.size());
    return report;
  }
  if (report.answers.empty()) report.hints = word_hints(words, *segments);
  return report;
}

}  // namespace

QueryReport run(const Database& database, const QueryCall& call) {
  FindLimits limits;
  if (call.limit > 0) limits.limit = call.limit;
  if (call.timeout_ms > 0) {
    limits.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(call.timeout_ms);
  }
  std::optional<PhaseQuery> query;
  try {
    query = parse(call.text);
  } catch (const SyntaxError&) {
    auto words = bare_words(call.text);
    if (!words && is_loosely_a_gloss(call.text, *database.segments())) words = {call.text};
    if (!words) throw;
    return found_words(database, call, *words, limits);
  }
  QueryReport report;
  if (call.explain) {
    report.plan = explain(*query, *database.segments());
  }
  FindCounts counts;
  report.answers = database.find(*query, limits, &counts);
  if (report.plan) {
    *report.plan += fmt::format("In fact: {} rows looked at, {} kept, {} answers.\n", counts.looked_at, counts.kept,
                                report.answers.size());
    return report;
  }
  if (report.answers.empty()) report.hints = hints(*query, *database.segments());
  return report;
}

QueryAnswer answer_of(const QueryReport& report) {
  if (report.plan) return PlanAnswer{*report.plan};
  std::vector<FoundSegment> list;
  for (std::size_t i = 0; i < report.answers.size(); ++i) {
    const Segment& segment = report.answers[i];
    FoundSegment& one = list.emplace_back(FoundSegment{.segment = segment, .match = {}, .distance = {}});
    if (!report.matches.empty()) one.match = word_of(report.matches[i]);
    if (segment.distance) one.distance = rounded(*segment.distance);
  }
  return list;
}

std::vector<std::vector<std::string>> rows_of(const QueryReport& report) {
  std::vector<std::vector<std::string>> rows = {{"recording", "tier", "name", "begin ms", "end ms"}};
  const bool ranked = !report.answers.empty() && report.answers.front().distance.has_value();
  if (ranked) rows.front().emplace_back("distance");
  if (!report.matches.empty()) rows.front().emplace_back("match");
  std::vector<std::string> variables;
  for (const Segment& segment : report.answers) {
    for (const auto& [variable, value] : segment.bindings) {
      if (std::ranges::find(variables, variable) == variables.end()) variables.push_back(variable);
    }
  }
  for (const std::string& variable : variables) rows.front().push_back("$" + variable);
  for (std::size_t i = 0; i < report.answers.size(); ++i) {
    const Segment& segment = report.answers[i];
    rows.push_back({segment.recording, segment.tier, segment.name, std::to_string(segment.span.begin.count()),
                    std::to_string(segment.span.end.count())});
    if (ranked) rows.back().push_back(fmt::format("{:.3f}", segment.distance.value_or(0)));
    if (!report.matches.empty()) rows.back().emplace_back(word_of(report.matches[i]));
    for (const std::string& variable : variables) {
      const auto at = std::ranges::find(segment.bindings, variable, &std::pair<std::string, std::string>::first);
      rows.back().push_back(at == segment.bindings.end() ? std::string() : at->second);
    }
  }
  return rows;
}

}  // namespace signweave::calls
