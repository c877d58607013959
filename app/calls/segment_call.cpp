#include "app/calls/segment_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace signweave::calls {

Segmented propose(const Motion& motion, const RigMap& rig, const std::string& where) {
  if (motion.frame_count() == 0) {
    throw Error(ErrorCode::bad_input, where + ": no frames, so there is nothing to tell phases from");
  }
  Segmented made{.proposed = {}, .length = motion.duration()};
  try {
    made.proposed = propose_phases(upper_body_of(motion, rig));
  } catch (const Error& error) {  // the library knows parts of the body, the user a file
    throw Error(error.code(), fmt::format("{}: {}", where, error.what()), error.remedies());
  }
  // The segmenter's frames are longer than most motions' own, so the last one may reach past the end.
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

nlohmann::ordered_json json_of(const Segmented& segmented, const std::string& key, const std::string& source) {
  nlohmann::ordered_json hands = nlohmann::ordered_json::object();
  for (const Side side : kSides) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ProposedPhase& one : segmented.proposed.hands[static_cast<std::size_t>(side)]) {
      list.push_back({{"phase", name_of(one.phase)},
                      {"begin_ms", std::llround(1000 * one.begin.count())},
                      {"end_ms", std::llround(1000 * one.end.count())},
                      {"confidence", std::round(1000.0 * one.confidence) / 1000.0}});
    }
    hands[side == Side::left ? "left" : "right"] = std::move(list);
  }
  return {{key, source}, {"proposed", kProposalWarning}, {"hands", std::move(hands)}};
}

}  // namespace signweave::calls
