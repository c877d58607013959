#include "signweave/calls/handedness_field.h"

#include <fmt/format.h>

#include "signweave/features/dominance.h"
#include "signweave/retarget/mirroring.h"

namespace signweave::calls {

std::optional<Side> side_of(const std::string& handedness) {
  if (handedness.empty()) return std::nullopt;
  return handedness == "left" ? Side::left : Side::right;
}

Motion with_handedness(Motion motion, Side hand, const std::string& recording, const RigNames& rig,
                       std::vector<Notice>& notices) {
  if (motion.frame_count() == 0) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: no frames, so its dominant hand is unknown", recording));
  }
  const BorrowedSource source(motion);
  const RecordedBody body = recorded_body(recording, source, rig);
  const Dominance found = dominance_of(paths_in(trace_hands(motion, body.signer)));
  if (!found.hand) notices.push_back(notice_unknown_hand(recording, found));
  const Side captured = found.hand.value_or(Side::right);
  if (captured == hand) return motion;
  const Mirroring mirroring = mirroring_of(body);
  notices.push_back({recording, fmt::format("mirrored: the signer's dominant hand is the {} one (score {:.2f})",
                                            captured == Side::left ? "left" : "right", found.score)});
  notices.insert(notices.end(), mirroring.notices.begin(), mirroring.notices.end());
  return mirrored(motion, mirroring);
}

}  // namespace signweave::calls
