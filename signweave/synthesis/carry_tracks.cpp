#include "signweave/synthesis/carry_tracks.h"

#include <algorithm>
#include <optional>
#include <string>

#include "signweave/synthesis/transition.h"

namespace signweave {
namespace {

std::optional<std::size_t> track_of(const Laid& laid, const std::string& name) {
  const std::span<const std::string> tracks = laid.stretch->source->tracks();
  const auto at = std::ranges::find(tracks, name);
  if (at == tracks.end()) return std::nullopt;
  return static_cast<std::size_t>(at - tracks.begin());
}

std::vector<float> carry(const std::vector<Laid>& laid, const std::string& name, std::int64_t frames) {
  std::vector<float> values(static_cast<std::size_t>(frames), 0.0f);
  const auto part = [&](FrameRange range) {
    return std::span(values).subspan(static_cast<std::size_t>(range.begin), static_cast<std::size_t>(range.size()));
  };
  std::vector<float> faded;
  for (std::size_t i = 0; i < laid.size(); ++i) {
    const Laid& now = laid[i];
    const std::optional<std::size_t> track = track_of(now, name);
    const std::int64_t last_end = i == 0 ? now.begin() : laid[i - 1].end();
    const std::int64_t shared = std::max<std::int64_t>(0, last_end - now.begin());
    faded.assign(static_cast<std::size_t>(shared), 0.0f);
    if (track) {
      read_track(now, *track, {now.begin(), now.begin() + shared}, faded);
      read_track(now, *track, {now.begin() + shared, now.end()}, part({now.begin() + shared, now.end()}));
    }
    for (std::int64_t k = 0; k < shared; ++k) {
      float& value = values[static_cast<std::size_t>(now.begin() + k)];
      value += crossfade_weight(k, shared) * (faded[static_cast<std::size_t>(k)] - value);
    }
    const std::int64_t gap = now.begin() - last_end;
    if (i == 0 || gap <= 0) continue;
    const float left = values[static_cast<std::size_t>(last_end - 1)];
    const float right = values[static_cast<std::size_t>(now.begin())];
    for (std::int64_t k = 0; k < gap; ++k) {
      values[static_cast<std::size_t>(last_end + k)] = left + crossfade_weight(k, gap) * (right - left);
    }
  }
  return values;
}

}  // namespace

void carry_tracks(const std::vector<Laid>& laid, Synthesis& out) {
  std::vector<std::string> names;
  for (const Laid& one : laid) {
    for (const std::string& name : one.stretch->source->tracks()) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  for (const std::string& name : names) out.motion.add_track({name, carry(laid, name, out.motion.frame_count())});
}

}  // namespace signweave
