#include "app/calls/info_call.h"
#include "app/calls/json.h"
#include "app/calls/vocabulary_call.h"
#include "app/server/routes.h"
#include "signweave/database/check.h"
#include "signweave/database/declarations.h"

namespace signweave::server {

using nlohmann::json;

calls::SchemaWriter label_fields() {
  return calls::schema_of_call<calls::LabelsCall>();
}

ApiResponse list_databases(Call& call) {
  json list = json::array();
  for (const auto& one : call.state.databases.all()) {
    const std::shared_ptr<const Contents> contents = one->database().contents();
    call.declare_all(*contents);
    Declarations declarations;
    for (const RecordingInfo& info : contents->recordings) add_new(info.declarations, declarations);
    list.push_back({{"name", one->name()},
                    {"writable", one->writable()},
                    {"recordings", contents->recordings.size()},
                    {"declarations", calls::declarations_json(declarations)}});
  }
  return json_answer(json{{"databases", std::move(list)}});
}

ApiResponse show_database(Call& call) {
  const Database& database = call.database().database();
  calls::tell_damage(database, call.listener());
  const calls::DatabaseInfo info = calls::run_info(
      database, [&] { return database.usage(); }, call.listener());
  call.declare_all(*info.contents);
  return json_answer(calls::json_of(info));
}

ApiResponse show_recording(Call& call) {
  const auto details = calls::run(call.database().database(), read_parameters<calls::RecordingCall>(call));
  call.declare(details.info.declarations);
  return json_answer(calls::json_of(details));
}

ApiResponse list_vocabulary(Call& call) {
  const Database& database = call.database().database();
  call.declare_all(*database.contents());
  return json_answer(calls::vocabulary_json(database));
}

ApiResponse list_labels(Call& call) {
  const auto wanted = read_parameters<calls::LabelsCall>(call);
  const Database& database = call.database().database();
  call.declare_all(*database.contents());
  return json_answer(calls::labels_json(database, wanted));
}

ApiResponse check_database(Call& call) {
  return json_answer(calls::json_of(check(call.database().database(), call.listener().progress)));
}

ApiResponse list_formats(Call&) {
  return json_answer(calls::formats_json());
}

ApiResponse show_openapi(Call&) {
  return {.status = 200, .content_type = "application/json", .headers = {}, .body = Api::openapi()};
}

}  // namespace signweave::server
