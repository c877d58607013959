#include "app/server/answers.h"
#include "app/server/openapi.h"
#include "app/wire/answer_schema.h"
#include "app/wire/tier_changes.h"
#include "signweave/calls/info_call.h"
#include "signweave/calls/lists_call.h"
#include "signweave/calls/query_call.h"
#include "signweave/calls/segment_call.h"
#include "signweave/calls/stats_answer.h"
#include "signweave/calls/utterance_call.h"
#include "signweave/calls/vocabulary_call.h"
#include "signweave/calls/xpath_call.h"
#include "signweave/notation/score_fields.h"

namespace signweave::server {

nlohmann::ordered_json answer_schemas() {
  wire::Schemas schemas = wire::Schemas::object();
  const auto add = [&]<class... Answers>() { (wire::answer_schema<Answers>(schemas), ...); };
  add.template operator()<DatabasesAnswer, calls::DatabaseInfo, calls::RecordingDetails, calls::VocabularyAnswer,
                          calls::LabelsAnswer, CharactersAnswer, MediaAnswer, RenderedFile, CheckResult>();
  add.template operator()<calls::StatisticsAnswer, calls::ProposalsAnswer, EvaluationReply, SynthesisReply, Score>();
  add.template operator()<calls::UtteranceAnswer, calls::Removed, UploadAnswer, UploadedFile, Discarded, JobBegun,
                          JobAnswer, JobsAnswer>();
  add.template operator()<wire::FailedAnswer>();
  // Lists, and what has its own writer.
  schemas["Answers"] = wire::answer_schema<calls::QueryAnswer>(schemas);
  schemas["Nodes"] = wire::answer_schema<std::vector<calls::NodeAnswer>>(schemas);
  schemas["FileFormats"] = wire::answer_schema<std::vector<FileFormat>>(schemas);
  schemas["Methods"] = wire::answer_schema<std::vector<calls::MethodRow>>(schemas);
  schemas["Phases"] = wire::answer_schema<std::vector<calls::PhaseRow>>(schemas);
  schemas["Units"] = wire::answer_schema<std::vector<calls::UnitRow>>(schemas);
  schemas["TierChanges"] = wire::tier_changes_schema();
  const nlohmann::ordered_json object = {{"type", "object"}};
  const nlohmann::ordered_json list = {{"type", "array"}};
  schemas["OpenApi"] = {{"type", "object"},
                        {"required", {"openapi", "info", "paths"}},
                        {"properties",
                         {{"openapi", {{"type", "string"}}},
                          {"info", object},
                          {"paths", object},
                          {"components", object},
                          {"servers", list},
                          {"security", list}}}};
  return schemas;
}

}  // namespace signweave::server
