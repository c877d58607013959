#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/core/answer.h"
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

/// The proposed phases, and the length of the motion.
struct Segmented {
  ProposedPhases proposed;
  Seconds length{0};  ///< of the motion
};

/// Proposes phases for a motion; `where` prefixes error texts and appears in notices. Throws Error{bad_input} for a
/// motion without frames, Error{not_found} if a hand, the head or the trunk is not found.
Segmented propose(const Motion& motion, const RigMap& rig, const std::string& where);

/// Proposes phases for a stored recording.
Segmented run(const Database& database, const SegmentCall& call);

struct ProposedPhaseAnswer {
  std::string_view phase;
  std::int64_t begin_ms = 0;
  std::int64_t end_ms = 0;
  double confidence = 0;
};
template <class Visit>
void fields(Visit& visit, const ProposedPhaseAnswer& one) {
  visit.type("ProposedPhase");
  visit(AnswerField{.name = "phase"}, one.phase);
  visit(AnswerField{.name = "begin_ms"}, one.begin_ms);
  visit(AnswerField{.name = "end_ms"}, one.end_ms);
  visit(AnswerField{.name = "confidence", .help = "from 0 to 1"}, one.confidence);
}
struct ProposedHands {
  std::array<std::vector<ProposedPhaseAnswer>, 2> sides;  ///< [Side]
};
template <class Visit>
void fields(Visit& visit, const ProposedHands& hands) {
  visit(AnswerField{.name = "left"}, hands.sides[static_cast<std::size_t>(Side::left)]);
  visit(AnswerField{.name = "right"}, hands.sides[static_cast<std::size_t>(Side::right)]);
}
struct ProposalsAnswer {
  std::optional<std::string> recording;  ///< the source: a stored recording, or
  std::optional<std::string> file;       ///< a file
  std::string_view proposed;
  ProposedHands hands;
};
template <class Visit>
void fields(Visit& visit, const ProposalsAnswer& answer) {
  visit.type("Proposals");
  visit(AnswerField{.name = "recording"}, answer.recording);
  visit(AnswerField{.name = "file"}, answer.file);
  visit(AnswerField{.name = "proposed", .help = "that a person must check them: show it"}, answer.proposed);
  visit(AnswerField{.name = "hands"}, answer.hands);
}

/// The caller adds the name of the recording or of the file.
ProposalsAnswer answer_of(const Segmented& segmented);

}  // namespace signweave::calls
