#include "signweave/nonmanual/channel.h"

namespace signweave {
namespace {

struct Prefix {
  std::string_view text;
  NonManualChannel channel;
};
constexpr Prefix kPrefixes[] = {
    {"headYaw", NonManualChannel::head},    {"headPitch", NonManualChannel::head},
    {"headRoll", NonManualChannel::head},   {"eyeLook", NonManualChannel::gaze},
    {"leftEye", NonManualChannel::gaze},    {"rightEye", NonManualChannel::gaze},
    {"brow", NonManualChannel::brows},      {"eyeWide", NonManualChannel::brows},
    {"eyeSquint", NonManualChannel::brows}, {"noseSneer", NonManualChannel::brows},
    {"eyeBlink", NonManualChannel::lids},   {"jaw", NonManualChannel::mouth},
    {"mouth", NonManualChannel::mouth},     {"cheek", NonManualChannel::mouth},
    {"tongueOut", NonManualChannel::mouth},
};

}  // namespace

std::string_view name_of(NonManualChannel channel) noexcept {
  switch (channel) {
    case NonManualChannel::head:
      return "head";
    case NonManualChannel::gaze:
      return "gaze";
    case NonManualChannel::brows:
      return "brows";
    case NonManualChannel::lids:
      return "lids";
    case NonManualChannel::mouth:
      return "mouth";
  }
  return "head";
}

std::optional<NonManualChannel> channel_of_track(std::string_view track) noexcept {
  for (const Prefix& prefix : kPrefixes) {
    if (track.starts_with(prefix.text)) return prefix.channel;
  }
  return std::nullopt;
}

}  // namespace signweave
