// Texts that the server reads and writes for its clients: utterances and annotation files. Nothing is stored.
#include <fmt/format.h>

#include "app/server/routes.h"
#include "app/wire/tier_changes.h"
#include "signweave/calls/annotate_call.h"
#include "signweave/calls/utterance_call.h"
#include "signweave/formats/eaf/eaf.h"

namespace signweave::server {

wire::SchemaWriter annotate_fields() {
  return wire::schema_of_call<calls::AnnotateCall>();
}
wire::SchemaWriter utterance_fields() {
  return wire::schema_of_call<calls::UtteranceCall>();
}

ApiResponse annotate_recording(Call& call) {
  const auto parameters = read_parameters<calls::AnnotateCall>(call);
  const Database& database = call.database().database();
  const std::shared_ptr<const Contents> contents = database.contents();
  call.declare(contents->at(parameters.recording).declarations);
  const calls::TierChanges changes = wire::tier_changes_from_json(call.request.body);
  return file_answer(answer_format("eaf"), parameters.recording,
                     eaf::write_text(calls::run(database, parameters, changes)));
}

ApiResponse read_text_of_utterance(Call& call) {
  const calls::UtteranceAnswer answer = calls::run(read_parameters<calls::UtteranceCall>(call));
  if (answer.places.size() > call.state.limits.glosses) {
    throw too_large(
        fmt::format("the utterance has {} places; the limit is {}", answer.places.size(), call.state.limits.glosses));
  }
  return json_answer(answer_json(answer));
}

}  // namespace signweave::server
