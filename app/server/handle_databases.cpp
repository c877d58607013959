#include "app/server/answers.h"
#include "app/server/routes.h"
#include "signweave/annotation/declarations.h"
#include "signweave/calls/info_call.h"
#include "signweave/calls/lists_call.h"
#include "signweave/calls/vocabulary_call.h"
#include "signweave/database/check.h"

namespace signweave::server {

using nlohmann::json;

wire::SchemaWriter label_fields() {
  return wire::schema_of_call<calls::LabelsCall>();
}

ApiResponse list_databases(Call& call) {
  DatabasesAnswer answer;
  for (const auto& one : call.state.databases.all()) {
    const std::shared_ptr<const Contents> contents = one->database().contents();
    call.declare_all(*contents);
    Declarations declarations;
    for (const RecordingInfo& info : contents->recordings) merge_declarations(info.declarations, declarations);
    answer.databases.push_back({.name = one->name(),
                                .writable = one->writable(),
                                .recordings = contents->recordings.size(),
                                .declarations = std::move(declarations)});
  }
  return json_answer(answer_json<json>(answer));
}

ApiResponse show_database(Call& call) {
  const Database& database = call.database().database();
  calls::report_damage(database, call.listener());
  const calls::DatabaseInfo info = calls::run_info(
      database, [&] { return database.usage(); }, call.listener());
  call.declare_all(*info.contents);
  return json_answer(answer_json<json>(info));
}

ApiResponse show_recording(Call& call) {
  const auto details = calls::run(call.database().database(), read_parameters<calls::RecordingCall>(call));
  call.declare(details.info.declarations);
  return json_answer(answer_json(details));
}

ApiResponse list_vocabulary(Call& call) {
  const Database& database = call.database().database();
  call.declare_all(*database.contents());
  return json_answer(answer_json(calls::vocabulary_of(database)));
}

ApiResponse list_labels(Call& call) {
  const auto wanted = read_parameters<calls::LabelsCall>(call);
  const Database& database = call.database().database();
  call.declare_all(*database.contents());
  return json_answer(answer_json(calls::run(database, wanted)));
}

ApiResponse check_database(Call& call) {
  return json_answer(answer_json<json>(check(call.database().database(), call.listener().progress)));
}

ApiResponse list_formats(Call&) {
  return json_answer(answer_json<json>(calls::formats_answer()));
}

ApiResponse list_methods(Call&) {
  return json_answer(answer_json(calls::method_rows()));
}

ApiResponse list_phases(Call&) {
  return json_answer(answer_json(calls::phase_rows()));
}

ApiResponse list_units(Call&) {
  return json_answer(answer_json(calls::unit_rows()));
}

ApiResponse show_openapi(Call&) {
  return {.status = 200, .content_type = "application/json", .headers = {}, .body = Api::openapi()};
}

}  // namespace signweave::server
