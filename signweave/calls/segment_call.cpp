#include "signweave/calls/segment_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace signweave::calls {

Segmented propose(const Motion& motion, const RigMap& rig, const std::string& where) {
  if (motion.frame_count() == 0) {
    throw Error(ErrorCode::bad_input, where + ": no frames, so no phases can be proposed");
  }
  Segmented made{.proposed = {}, .length = motion.duration()};
  try {
    made.proposed = propose_phases(upper_body_of(motion, rig));
  } catch (const Error& error) {  // the library's message names parts of the body, the user needs the file
    throw Error(error.code(), fmt::format("{}: {}", where, error.what()), error.remedies());
  }
  // The segmenter's frames are longer than those of most motions, so the last one may extend past the end.
  for (std::vector<ProposedPhase>& hand : made.proposed.hands) {
    for (ProposedPhase& one : hand) one.end = std::min(one.end, made.length);
  }
  for (Notice& notice : made.proposed.notices) notice.where = where;
  return made;
}

Segmented run(const Database& database, const SegmentCall& call) {
  const std::shared_ptr<const Contents> contents = database.contents();
  const RecordingInfo& info = contents->at(call.recording);
  const Motion motion = database.read(info.name);
  return propose(motion, map_rig(motion, info.rig), info.name);
}

ProposalsAnswer answer_of(const Segmented& segmented) {
  ProposalsAnswer answer{.recording = {}, .file = {}, .proposed = kProposalWarning, .hands = {}};
  for (const Side side : kSides) {
    const auto at = static_cast<std::size_t>(side);
    for (const ProposedPhase& one : segmented.proposed.hands[at]) {
      answer.hands.sides[at].push_back({.phase = name_of(one.phase),
                                        .begin_ms = std::llround(1000 * one.begin.count()),
                                        .end_ms = std::llround(1000 * one.end.count()),
                                        .confidence = std::round(1000.0 * one.confidence) / 1000.0});
    }
  }
  return answer;
}

}  // namespace signweave::calls
