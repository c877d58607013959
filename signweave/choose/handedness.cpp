#include "signweave/choose/handedness.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>

#include "signweave/database/signer_dominance.h"
#include "signweave/retarget/mirrored_source.h"

namespace signweave {

void mark_mirrored(std::span<MotionClip> clips, std::span<const std::optional<Side>> hands, const Snapshot& snapshot,
                   std::vector<Notice>& notices) {
  const Contents& contents = snapshot.contents();
  std::map<std::string, Side> dominant;  // by recording
  for (std::size_t i = 0; i < clips.size(); ++i) {
    MotionClip& clip = clips[i];
    if (!hands[i]) continue;
    const auto [at, is_new] = dominant.try_emplace(clip.recording, Side::right);
    if (is_new) {
      const RecordingInfo& info = contents.at(clip.recording);
      const Dominance found = dominance_of(snapshot, static_cast<std::size_t>(&info - contents.recordings.data()));
      at->second = found.hand.value_or(Side::right);
      if (!found.hand) notices.push_back(notice_unknown_hand(clip.recording, found));
    }
    clip.mirrored = at->second != *hands[i];
  }
}

void mirror_marked(std::span<MotionClip> clips, const Snapshot& snapshot, std::vector<Notice>& notices) {
  std::map<std::string, std::shared_ptr<const MotionSource>> sources;  // by recording
  for (MotionClip& clip : clips) {
    if (!clip.mirrored) continue;
    std::shared_ptr<const MotionSource>& source = sources[clip.recording];
    if (!source) {
      const auto mirroring = snapshot.mirroring(snapshot.contents().at(clip.recording));
      notices.insert(notices.end(), mirroring->notices.begin(), mirroring->notices.end());
      source = std::make_shared<MirroredSource>(clip.source, mirroring);
    }
    clip.source = source;
    clip.noise = nullptr;
  }
}

}  // namespace signweave
