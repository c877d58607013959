#include "app/server/routes.h"
#include "signweave/calls/xpath_call.h"
#include "signweave/notation/answer_json.h"

namespace signweave::server {

wire::SchemaWriter xpath_fields() {
  return wire::schema_of_call<calls::XPathCall>();
}

ApiResponse find_nodes(Call& call) {
  auto wanted = read_parameters<calls::XPathCall>(call);
  const ApiLimits& limits = call.state.limits;
  const std::int64_t most_ms = limits.query_time.count();
  if (wanted.timeout_ms == 0 || wanted.timeout_ms > most_ms) wanted.timeout_ms = most_ms;
  const bool bounded = wanted.limit == 0 || wanted.limit > limits.answers;
  if (bounded) wanted.limit = limits.answers;
  const Database& database = call.database().database();
  calls::report_damage(database, call.listener());
  const std::vector<XPathAnswer> answers = calls::run(database, wanted);
  if (bounded && answers.size() == limits.answers) {
    call.notices.push_back({"", "there may be more answers than the server returns: these are the first"});
  }
  const std::shared_ptr<const Contents> contents = database.contents();
  std::string last;
  for (const XPathAnswer& answer : answers) {  // ordered by recording
    if (answer.recording == last) continue;
    last = answer.recording;
    if (const RecordingInfo* info = contents->find(last)) call.declare(info->declarations);
  }
  return json_answer(answer_json<nlohmann::json>(calls::node_answers(answers)));
}

}  // namespace signweave::server
