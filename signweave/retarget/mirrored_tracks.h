#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace signweave {

/// A scalar track of a mirrored signer.
struct MirroredTrack {
  std::string name;
  std::size_t from = 0;  ///< index of the captured track that it shows
  float sign = 1;        ///< factor of its values: -1 for rotations to a side, such as headYaw and leftEyeRoll
  friend bool operator==(const MirroredTrack&, const MirroredTrack&) = default;
};

/// Returns the tracks of the mirrored signer, in the order of the captured ones. Tracks whose names differ in left and
/// right are exchanged (browDownLeft, eyeLookInLeft, jawLeft, leftEyePitch, …); a track without the other one is
/// renamed. Others are kept.
std::vector<MirroredTrack> mirrored_tracks(std::span<const std::string> captured);

}  // namespace signweave
