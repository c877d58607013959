#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/calls/field.h"
#include "app/calls/json.h"
#include "app/calls/listener.h"
#include "signweave/database/check.h"
#include "signweave/database/database.h"
#include "signweave/features/hand_motion.h"

namespace signweave::calls {

/// What a database holds.
struct DatabaseInfo {
  std::shared_ptr<const Contents> contents;
  kv::EngineInfo engine;
  int layout = 0;
  std::vector<Usage> usage;  ///< empty where looking at every entry met damage
  AccessMode access_mode;
  float tolerance = 0;
  DocumentStorage documents = DocumentStorage::document;  ///< of those to come
  JoinWeights weights;
  ResidualModel residuals;  ///< what movements taught of transitions
};

/// `usage` looks at every entry: Database::usage, or usage_in_child. Its fault is told.
DatabaseInfo run_info(const Database& database, const std::function<std::vector<Usage>()>& usage,
                      const Listener& listener);
nlohmann::json json_of(const DatabaseInfo& info);

/// All that is known of one recording.
struct RecordingCall {
  std::string recording;
};

template <class Visit>
void fields(Visit& visit, RecordingCall& call) {
  visit(Field{.name = "recording", .help = "name of the recording", .words = "RECORDING", .required = true},
        call.recording);
}

struct RecordingDetails {
  RecordingInfo info;
  std::optional<SignerModel> model;  ///< none without motion
  std::shared_ptr<const Skeleton> skeleton;
  nlohmann::ordered_json figures;  ///< everything that is one number or text
};

/// Throws Error{not_found}.
RecordingDetails run(const Database& database, const RecordingCall& call);
nlohmann::ordered_json json_of(const RecordingDetails& details);

/// What `check` found.
nlohmann::json json_of(const CheckResult& result);

/// The file formats, and what each can hold: rows, the heading first.
std::vector<std::vector<std::string>> format_rows();
nlohmann::json formats_json();

}  // namespace signweave::calls
