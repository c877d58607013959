#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace signweave {

/// A part of the face or head that moves on its own.
enum class NonManualChannel : std::uint8_t { head, gaze, brows, lids, mouth };
inline constexpr std::array kNonManualChannels = {NonManualChannel::head, NonManualChannel::gaze,
                                                  NonManualChannel::brows, NonManualChannel::lids,
                                                  NonManualChannel::mouth};
std::string_view name_of(NonManualChannel channel) noexcept;

/// The channel of a scalar track with a name of ARKit or of Live Link Face:
/// head   headYaw, headPitch, headRoll
/// gaze   eyeLook…, leftEye…, rightEye…
/// brows  brow…, eyeWide…, eyeSquint…, noseSneer…
/// lids   eyeBlink…
/// mouth  jaw…, mouth…, cheek…, tongueOut
/// nullopt for any other name.
std::optional<NonManualChannel> channel_of_track(std::string_view track) noexcept;

}  // namespace signweave
