#include "signweave/render/carry_tracks.h"

#include <algorithm>
#include <string>

#include "signweave/score/transition.h"

namespace signweave {
namespace {

/// Reads and joins the tracks of all stretches. `tracks_` are the result's, in the frames of a window.
class TrackCarrier {
 public:
  TrackCarrier(std::vector<ScalarTrack>& tracks, FrameRange window)
      : tracks_(tracks), window_(window), faded_(tracks.size()) {}

  /// A stretch, and the transition from the one before, which ends at output frame `last_end`.
  void carry(const Laid& laid, std::int64_t last_end, bool first) {
    const std::int64_t shared = std::max<std::int64_t>(0, last_end - laid.begin());
    const FrameRange own{std::max(laid.begin() + shared, window_.begin), std::min(laid.end(), window_.end)};
    for (std::vector<float>& values : faded_) values.resize(static_cast<std::size_t>(shared));
    read(laid, {laid.begin(), laid.begin() + shared}, [&](std::size_t track) { return std::span(faded_[track]); });
    read(laid, own, [&](std::size_t track) {
      return std::span(tracks_[track].values)
          .subspan(static_cast<std::size_t>(own.begin - window_.begin), static_cast<std::size_t>(own.size()));
    });
    if (first) return;
    fade(laid.begin(), shared);
    fill_gap(last_end, laid.begin() - last_end);
  }

 private:
  /// Reads all tracks of a stretch at once, each to where it belongs among the result's; those that it lacks are 0.
  template <typename Place>
  void read(const Laid& laid, FrameRange output, Place place) {
    if (output.empty()) return;
    const std::span<const std::string> names = laid.stretch->source->tracks();
    spans_.clear();
    for (const std::string& name : names) {
      const std::size_t index = index_of(name);
      spans_.push_back(index < tracks_.size() ? place(index) : std::span<float>());
    }
    read_tracks(laid, output, spans_);
    for (std::size_t track = 0; track < tracks_.size(); ++track) {
      if (std::ranges::find(names, tracks_[track].name) == names.end()) std::ranges::fill(place(track), 0.0f);
    }
  }

  std::size_t index_of(const std::string& name) const {
    const auto at = std::ranges::find(tracks_, name, &ScalarTrack::name);
    return static_cast<std::size_t>(at - tracks_.begin());
  }

  void fade(std::int64_t begin, std::int64_t count) {
    weigh(count);
    for (std::size_t track = 0; track < tracks_.size(); ++track) {
      float* const values = tracks_[track].values.data() + (begin - window_.begin);
      const float* const other = faded_[track].data();
      for (std::size_t k = 0; k < weights_.size(); ++k) values[k] += weights_[k] * (other[k] - values[k]);
    }
  }

  void fill_gap(std::int64_t begin, std::int64_t count) {
    if (count <= 0) return;
    for (ScalarTrack& track : tracks_) {
      const std::span<float> values(track.values);
      const auto at = static_cast<std::size_t>(begin - window_.begin);
      const auto frames = static_cast<std::size_t>(count);
      go_over(values[at - 1], values[at + frames], values.subspan(at, frames));
    }
  }

  void weigh(std::int64_t count) {
    weights_.resize(static_cast<std::size_t>(count));
    for (std::int64_t k = 0; k < count; ++k) weights_[static_cast<std::size_t>(k)] = crossfade_weight(k, count);
  }

  std::vector<ScalarTrack>& tracks_;
  FrameRange window_;
  std::vector<std::vector<float>> faded_;
  std::vector<std::span<float>> spans_;
  std::vector<float> weights_;  ///< of the frames of one transition
};

}  // namespace

void carry_tracks(std::span<const Laid> laid, FrameRange window, std::vector<ScalarTrack>& tracks) {
  TrackCarrier carrier(tracks, window);
  for (ScalarTrack& track : tracks) track.values.resize(static_cast<std::size_t>(window.size()));
  for (std::size_t i = 0; i < laid.size() && !tracks.empty(); ++i) {
    carrier.carry(laid[i], i == 0 ? laid[i].begin() : laid[i - 1].end(), i == 0);
  }
}

std::vector<std::string> tracks_of(std::span<const Laid> laid) {
  std::vector<std::string> names;
  const MotionSource* seen = nullptr;
  for (const Laid& one : laid) {
    if (one.stretch->source.get() == seen) continue;
    seen = one.stretch->source.get();
    for (const std::string& name : seen->tracks()) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

}  // namespace signweave
