#include "signweave/retarget/mirrored_tracks.h"

#include <algorithm>
#include <string_view>

#include "signweave/retarget/side_names.h"

namespace signweave {
namespace {

/// Rotations of Live Link Face: yaw to the right and roll to a side change their signs in a mirror, pitch does not.
bool is_sideways(std::string_view name) {
  return name.ends_with("Yaw") || name.ends_with("Roll");
}

}  // namespace

std::vector<MirroredTrack> mirrored_tracks(std::span<const std::string> captured) {
  std::vector<MirroredTrack> tracks;
  for (std::size_t i = 0; i < captured.size(); ++i) {
    MirroredTrack& track = tracks.emplace_back(MirroredTrack{captured[i], i, is_sideways(captured[i]) ? -1.0f : 1.0f});
    const auto other = other_side(captured[i]);
    const bool again = std::ranges::find(captured.first(i), captured[i]) != captured.first(i).end();
    if (!other || again) continue;  // of several tracks with one name, the first is exchanged
    const auto found = std::ranges::find(captured, *other);
    if (found == captured.end()) {
      track.name = *other;
    } else {
      track.from = static_cast<std::size_t>(found - captured.begin());
    }
  }
  return tracks;
}

}  // namespace signweave
