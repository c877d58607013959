#include "app/calls/query_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/query/explain.h"
#include "signweave/query/find.h"
#include "signweave/query/parse.h"

namespace signweave::calls {

using nlohmann::json;

namespace {

/// To a tenth of a thousandth: what a float has beyond that is noise.
double rounded(float distance) {
  return std::round(static_cast<double>(distance) * 1e4) / 1e4;
}

}  // namespace

QueryReport run(const Database& database, const QueryCall& call) {
  const PhaseQuery query = parse(call.text);
  QueryReport report;
  if (call.explain) {
    report.plan = explain(query, *database.segments());
  }
  FindLimits limits;
  if (call.limit > 0) limits.limit = call.limit;
  if (call.timeout_ms > 0) {
    limits.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(call.timeout_ms);
  }
  FindCounts counts;
  report.answers = database.find(query, limits, &counts);
  if (report.plan) {
    *report.plan += fmt::format("In fact: {} rows looked at, {} kept, {} answers.\n", counts.looked_at, counts.kept,
                                report.answers.size());
    return report;
  }
  if (report.answers.empty()) report.hints = hints(query, *database.segments());
  return report;
}

json json_of(const QueryReport& report) {
  if (report.plan) return {{"plan", *report.plan}};
  json list = json::array();
  for (const Segment& segment : report.answers) {
    json parts = json::array();
    for (const SegmentPart& part : segment.parts) {
      json one = span_json(part.span);
      one["name"] = part.name;
      parts.push_back(std::move(one));
    }
    json one = span_json(segment.span);
    one["recording"] = segment.recording;
    one["tier"] = segment.tier;
    one["name"] = segment.name;
    one["parts"] = std::move(parts);
    if (segment.distance) one["distance"] = rounded(*segment.distance);
    for (const auto& [variable, value] : segment.bindings) one["bindings"][variable] = value;
    list.push_back(std::move(one));
  }
  return list;
}

std::vector<std::vector<std::string>> rows_of(const QueryReport& report) {
  std::vector<std::vector<std::string>> rows = {{"recording", "tier", "name", "begin ms", "end ms"}};
  const bool ranked = !report.answers.empty() && report.answers.front().distance.has_value();
  if (ranked) rows.front().emplace_back("distance");
  std::vector<std::string> variables;
  for (const Segment& segment : report.answers) {
    for (const auto& [variable, value] : segment.bindings) {
      if (std::ranges::find(variables, variable) == variables.end()) variables.push_back(variable);
    }
  }
  for (const std::string& variable : variables) rows.front().push_back("$" + variable);
  for (const Segment& segment : report.answers) {
    rows.push_back({segment.recording, segment.tier, segment.name, std::to_string(segment.span.begin.count()),
                    std::to_string(segment.span.end.count())});
    if (ranked) rows.back().push_back(fmt::format("{:.3f}", segment.distance.value_or(0)));
    for (const std::string& variable : variables) {
      const auto at = std::ranges::find(segment.bindings, variable, &std::pair<std::string, std::string>::first);
      rows.back().push_back(at == segment.bindings.end() ? std::string() : at->second);
    }
  }
  return rows;
}

}  // namespace signweave::calls
