#pragma once

#include <string>

#include "app/calls/field.h"
#include "app/calls/json.h"
#include "signweave/database/database.h"
#include "signweave/features/phase_proposals.h"

namespace signweave::calls {

/// Proposes phases of both hands of a stored recording, from motion alone.
struct SegmentCall {
  std::string recording;
};

template <class Visit>
void fields(Visit& visit, SegmentCall& call) {
  visit(Field{.name = "recording", .help = "name of the recording", .words = "RECORDING", .required = true},
        call.recording);
}

/// What is proposed, and for what.
struct Segmented {
  ProposedPhases proposed;
  Seconds length{0};  ///< of the motion
};

/// Proposals for a motion; `where` stands before the text of an error and in notices. Throws Error{bad_input} for a
/// motion without frames, Error{not_found} where a hand, the head or the trunk is not found.
Segmented propose(const Motion& motion, const RigMap& rig, const std::string& where);

/// The same for a stored recording.
Segmented run(const Database& database, const SegmentCall& call);

/// `source`: the name of a file or recording, which stands in `key`.
nlohmann::ordered_json json_of(const Segmented& segmented, const std::string& key, const std::string& source);

}  // namespace signweave::calls
