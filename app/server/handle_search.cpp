#include <algorithm>
#include <mutex>
#include <set>

#include "app/server/answers.h"
#include "app/server/routes.h"
#include "signweave/calls/evaluate_call.h"
#include "signweave/calls/query_call.h"
#include "signweave/calls/segment_call.h"
#include "signweave/calls/stats_call.h"
#include "signweave/calls/table.h"
#include "signweave/formats/eaf/eaf.h"

namespace signweave::server {

template <>
struct Formats<calls::QueryCall> {
  static std::vector<std::string> names() { return {"json", "csv"}; }
  static std::string help() { return "of the answer; json if not given"; }
};
template <>
struct Formats<calls::StatsCall> {
  static std::vector<std::string> names() { return {"json", "csv", "svg"}; }
  static std::string help() {
    return "of the answer: json if not given; svg draws the transitions, or with loci the ends of strokes";
  }
};
template <>
struct Formats<calls::EvaluateCall> {
  static std::vector<std::string> names() { return {"json", "svg"}; }
  static std::string help() { return "of the answer: json if not given; svg draws the summary"; }
};
template <>
struct Formats<calls::SegmentCall> {
  static std::vector<std::string> names() { return {"json", "eaf"}; }
  static std::string help() { return "of the answer: json if not given; eaf is an annotation file for a person"; }
};

wire::SchemaWriter query_fields() {
  return wire::schema_of_call<WithFormat<calls::QueryCall>>();
}
wire::SchemaWriter stats_fields() {
  return wire::schema_of_call<WithFormat<calls::StatsCall>>();
}
wire::SchemaWriter evaluate_fields() {
  return wire::schema_of_call<calls::EvaluateCall>();
}
wire::SchemaWriter segment_fields() {
  return wire::schema_of_call<WithFormat<calls::SegmentCall>>();
}

ApiResponse find_segments(Call& call) {
  auto [query, format] = read_parameters<WithFormat<calls::QueryCall>>(call);
  const ApiLimits& limits = call.state.limits;
  const std::int64_t most_ms = limits.query_time.count();
  if (query.timeout_ms == 0 || query.timeout_ms > most_ms) query.timeout_ms = most_ms;
  const bool bounded = query.limit == 0 || query.limit > limits.answers;
  if (bounded) query.limit = limits.answers;
  const Database& database = call.database().database();
  calls::report_damage(database, call.listener());
  const calls::QueryReport report = calls::run(database, query);
  call.notices.insert(call.notices.end(), report.hints.begin(), report.hints.end());
  if (bounded && report.answers.size() == limits.answers) {
    call.notices.push_back({"", "there may be more answers than the server returns: these are the first"});
  }
  const std::shared_ptr<const Contents> contents = database.contents();
  std::set<std::string_view> recordings;
  for (const Segment& segment : report.answers) {
    if (!recordings.insert(segment.recording).second) continue;
    if (const RecordingInfo* info = contents->find(segment.recording)) call.declare(info->declarations);
  }
  if (format == "csv" && !report.plan)
    return file_answer(answer_format("csv"), "answers", calls::format_csv(rows_of(report)));
  return json_answer(answer_json<nlohmann::json>(answer_of(report)));
}

ApiResponse count_transitions(Call& call) {
  const auto [parameters, format] = read_parameters<WithFormat<calls::StatsCall>>(call);
  if (const std::string fault = format == "csv" ? calls::csv_fault(parameters) : ""; !fault.empty()) {
    throw Error(ErrorCode::bad_input, fault);
  }
  const Database& database = call.database().database();
  calls::report_damage(database, call.listener());
  const calls::Counted counted = calls::run(database, parameters, call.listener());
  const std::shared_ptr<const Contents> contents = database.contents();
  for (const std::string& name : counted.names) {
    if (const RecordingInfo* info = contents->find(name)) call.declare(info->declarations);
  }
  if (format == "svg")
    return file_answer(answer_format("svg"), parameters.loci ? "loci" : "transitions",
                       calls::plot_of(parameters, counted, "svg"));
  if (format == "csv")
    return file_answer(answer_format("csv"), "statistics", calls::format_csv(csv_of(parameters, counted)));
  return json_answer(answer_json<nlohmann::json>(answer_of(parameters, counted)));
}

ApiResponse propose_segments(Call& call) {
  const auto [parameters, format] = read_parameters<WithFormat<calls::SegmentCall>>(call);
  const Database& database = call.database().database();
  const std::shared_ptr<const Contents> contents = database.contents();
  const RecordingInfo& info = contents->at(parameters.recording);
  const calls::Segmented made = calls::run(database, parameters);
  call.declare(info.declarations);
  call.notices = made.proposed.notices;
  if (format == "eaf") {
    return file_answer(answer_format("eaf"), info.name + ".phases",
                       eaf::write_text(proposals_document(made.proposed, made.length, info.motion_facts.file)));
  }
  calls::ProposalsAnswer answer = answer_of(made);
  answer.recording = info.name;
  return json_answer(answer_json(answer));
}

ApiResponse evaluate_methods(Call& call) {
  const auto parameters = read_parameters<calls::EvaluateCall>(call);
  ServedDatabase& served = call.database();
  call.declare_all(*served.database().contents());
  const auto evaluate = [&served, parameters, declarations = call.declarations](JobContext& job) {
    std::vector<Notice> notices;
    const calls::Listener listener{.notice = [&](const Notice& notice) { notices.push_back(notice); },
                                   .fault =
                                       [&](const std::string& line, const Remedies& remedies) {
                                         notices.push_back({"", line, remedies});
                                       },
                                   .stage = {},
                                   .progress = [&](double fraction) { job.advance(fraction); }};
    const calls::Evaluated made = calls::run(served.database(), parameters, listener);
    Bootstrap bootstrap(parameters.seed);
    EvaluationReply reply{.answer = answer_of(made, parameters, bootstrap),
                          .plot = {},
                          .declarations = declarations,
                          .notices = std::move(notices)};
    reply.plot = plot_of(made.tasks, bootstrap);
    return answer_json<nlohmann::json>(reply);
  };
  const std::string id =
      call.state.jobs.start({.name = "evaluate", .changes = false, .alone = true}, served.name(), evaluate);
  return json_answer(answer_json(JobBegun{id}), 202);
}

}  // namespace signweave::server
