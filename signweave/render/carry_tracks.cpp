#include "signweave/render/carry_tracks.h"

#include <algorithm>
#include <string>

#include "signweave/score/transition.h"

namespace signweave {
namespace {

/// Reads and joins the tracks of all clips. `tracks_` are the tracks of the result, in the frames of a window.
class TrackCarrier {
 public:
  TrackCarrier(std::vector<ScalarTrack>& tracks, FrameRange window)
      : tracks_(tracks), window_(window), faded_(tracks.size()) {}

  /// Adds a clip and the transition from the previous one, which ends at output frame `last_end`.
  void carry(const PlacedClip& placed, std::int64_t last_end, bool first) {
    const std::int64_t shared = std::max<std::int64_t>(0, last_end - placed.begin());
    const FrameRange own{std::max(placed.begin() + shared, window_.begin), std::min(placed.end(), window_.end)};
    for (std::vector<float>& values : faded_) values.resize(static_cast<std::size_t>(shared));
    read(placed, {placed.begin(), placed.begin() + shared},
         [&](std::size_t track) { return std::span(faded_[track]); });
    read(placed, own, [&](std::size_t track) {
      return std::span(tracks_[track].values)
          .subspan(static_cast<std::size_t>(own.begin - window_.begin), static_cast<std::size_t>(own.size()));
    });
    if (first) return;
    fade(placed.begin(), shared);
    fill_gap(last_end, placed.begin() - last_end);
  }

 private:
  /// Reads all tracks of a clip at once into the result's tracks; tracks that the clip lacks become 0.
  template <typename PositionOf>
  void read(const PlacedClip& placed, FrameRange output, PositionOf position_of) {
    if (output.empty()) return;
    const std::span<const std::string> names = placed.captured->source->tracks();
    spans_.clear();
    for (const std::string& name : names) {
      const std::size_t index = index_of(name);
      spans_.push_back(index < tracks_.size() ? position_of(index) : std::span<float>());
    }
    read_tracks(placed, output, spans_);
    for (std::size_t track = 0; track < tracks_.size(); ++track) {
      if (std::ranges::find(names, tracks_[track].name) == names.end()) std::ranges::fill(position_of(track), 0.0f);
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

void carry_tracks(std::span<const PlacedClip> placed, FrameRange window, std::vector<ScalarTrack>& tracks) {
  TrackCarrier carrier(tracks, window);
  for (ScalarTrack& track : tracks) track.values.resize(static_cast<std::size_t>(window.size()));
  for (std::size_t i = 0; i < placed.size() && !tracks.empty(); ++i) {
    carrier.carry(placed[i], i == 0 ? placed[i].begin() : placed[i - 1].end(), i == 0);
  }
}

std::vector<std::string> tracks_of(std::span<const PlacedClip> placed) {
  std::vector<std::string> names;
  const MotionSource* seen = nullptr;
  for (const PlacedClip& one : placed) {
    if (one.captured->source.get() == seen) continue;
    seen = one.captured->source.get();
    for (const std::string& name : seen->tracks()) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

}  // namespace signweave
