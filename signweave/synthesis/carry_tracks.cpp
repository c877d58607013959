#include "signweave/synthesis/carry_tracks.h"

#include <algorithm>
#include <string>

#include "signweave/synthesis/transition.h"

namespace signweave {
namespace {

/// Reads and joins the tracks of all stretches. `values_` is [track of the result][output frame].
class TrackCarrier {
 public:
  TrackCarrier(std::vector<std::string> names, std::int64_t frames)
      : names_(std::move(names)),
        values_(names_.size(), std::vector<float>(static_cast<std::size_t>(frames), 0.0f)),
        faded_(names_.size()) {}

  /// A stretch, and the transition from the one before, which ends at output frame `last_end`.
  void carry(const Laid& laid, std::int64_t last_end, bool first) {
    const std::int64_t shared = std::max<std::int64_t>(0, last_end - laid.begin());
    const FrameRange own{laid.begin() + shared, laid.end()};
    for (std::vector<float>& values : faded_) values.assign(static_cast<std::size_t>(shared), 0.0f);
    read(laid, {laid.begin(), own.begin}, [&](std::size_t track) { return std::span(faded_[track]); });
    read(laid, own, [&](std::size_t track) {
      return std::span(values_[track])
          .subspan(static_cast<std::size_t>(own.begin), static_cast<std::size_t>(own.size()));
    });
    if (first) return;
    for (std::size_t track = 0; track < values_.size(); ++track) {
      std::vector<float>& values = values_[track];
      for (std::int64_t k = 0; k < shared; ++k) {
        float& value = values[static_cast<std::size_t>(laid.begin() + k)];
        value += crossfade_weight(k, shared) * (faded_[track][static_cast<std::size_t>(k)] - value);
      }
      const std::int64_t gap = laid.begin() - last_end;
      if (gap <= 0) continue;
      const float left = values[static_cast<std::size_t>(last_end - 1)];
      const float right = values[static_cast<std::size_t>(laid.begin())];
      for (std::int64_t k = 0; k < gap; ++k) {
        values[static_cast<std::size_t>(last_end + k)] = left + crossfade_weight(k, gap) * (right - left);
      }
    }
  }

  void hand_over(Motion& motion) {
    for (std::size_t track = 0; track < names_.size(); ++track) {
      motion.add_track({std::move(names_[track]), std::move(values_[track])});
    }
  }

 private:
  /// Reads all tracks of a stretch at once, each to where it belongs among the result's.
  template <typename Place>
  void read(const Laid& laid, FrameRange output, Place place) {
    if (output.empty()) return;
    spans_.clear();
    for (const std::string& name : laid.stretch->source->tracks()) {
      spans_.push_back(place(static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin())));
    }
    read_tracks(laid, output, spans_);
  }

  std::vector<std::string> names_;
  std::vector<std::vector<float>> values_;
  std::vector<std::vector<float>> faded_;
  std::vector<std::span<float>> spans_;
};

}  // namespace

void carry_tracks(const std::vector<Laid>& laid, Synthesis& out) {
  std::vector<std::string> names;
  const MotionSource* seen = nullptr;
  for (const Laid& one : laid) {
    if (one.stretch->source.get() == seen) continue;
    seen = one.stretch->source.get();
    for (const std::string& name : seen->tracks()) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  if (names.empty()) return;
  TrackCarrier carrier(std::move(names), out.motion.frame_count());
  for (std::size_t i = 0; i < laid.size(); ++i) {
    carrier.carry(laid[i], i == 0 ? laid[i].begin() : laid[i - 1].end(), i == 0);
  }
  carrier.hand_over(out.motion);
}

}  // namespace signweave
