#include "signweave/live/live_curves.h"

#include <algorithm>
#include <cmath>

#include "signweave/nonmanual/gaze.h"
#include "signweave/nonmanual/mouthing/viseme.h"

namespace signweave {
namespace {

/// Those that were shown before are dropped beyond this number.
constexpr std::size_t kMostCurves = 256;

}  // namespace

std::int64_t frames_of(Milliseconds time, FrameRate rate) noexcept {
  return std::max<std::int64_t>(1, std::llround(Seconds(time).count() * rate.hertz()));
}

void LiveCurves::add(AuthoredCurve curve) {
  if (curves_.size() >= kMostCurves) curves_.erase(curves_.begin());
  curves_.push_back(std::move(curve));
  renderer_.reset();
}

void LiveCurves::set(std::vector<AuthoredCurve> curves) {
  curves_ = std::move(curves);
  renderer_.reset();
}

void LiveCurves::cut(std::int64_t frame) {
  if (std::erase_if(curves_, [&](const AuthoredCurve& one) { return one.at.begin >= frame; }) > 0) renderer_.reset();
}

void LiveCurves::end_after(std::size_t place, std::int64_t frame, FrameRate rate) {
  for (AuthoredCurve& one : curves_) {
    const Milliseconds falls = std::max(one.curve.offset, one.curve.head.offset);
    if (one.last > place) one.at.end = std::min(one.at.end, frame + frames_of(falls, rate));
  }
  renderer_.reset();
}

bool LiveCurves::cover(FrameRange frames) const noexcept {
  return std::ranges::any_of(
      curves_, [&](const AuthoredCurve& one) { return one.at.begin < frames.end && frames.begin < one.at.end; });
}

void LiveCurves::show(OutputWindow window, const JunctionSettings& settings) {
  if (curves_.empty()) return;
  if (!renderer_) renderer_.emplace(curves_, settings);
  renderer_->apply(window);
}

void LiveCurves::show(FrameRing& ring, std::int64_t count, const std::vector<std::string>& tracks,
                      const JunctionSettings& settings) {
  const MutablePoses shown = ring.poses(count);
  std::vector<ScalarTrack> values = frames_.take_tracks();
  frames_.reset(settings.skeleton, settings.rate, count);
  const MutablePoses poses = frames_.poses({0, count});
  std::ranges::copy(shown.rotations, poses.rotations.begin());
  std::ranges::copy(shown.translations, poses.translations.begin());
  values.resize(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    values[i].name = tracks[i];
    values[i].values.resize(static_cast<std::size_t>(count));
    for (std::int64_t frame = 0; frame < count; ++frame) {
      values[i].values[static_cast<std::size_t>(frame)] = ring.tracks(frame)[i];
    }
  }
  for (ScalarTrack& track : values) frames_.add_track(std::move(track));
  show({frames_, ring.end()}, settings);
  std::ranges::copy(poses.rotations, shown.rotations.begin());
  std::ranges::copy(poses.translations, shown.translations.begin());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const std::vector<float>& of_track = frames_.tracks()[i].values;
    for (std::int64_t frame = 0; frame < count; ++frame) {
      ring.tracks(frame)[i] = of_track[static_cast<std::size_t>(frame)];
    }
  }
}

std::vector<std::string> authored_tracks(const Expressions& expressions) {
  std::vector<std::string> names;
  const auto add = [&](std::string name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  };
  for (const NamedExpression& one : expressions) {
    for (std::string& name : tracks_of(one.curve)) add(std::move(name));
  }
  for (const std::string_view name : viseme_tracks()) add(std::string(name));
  for (std::string& name : tracks_of(gaze_at({}, {}))) add(std::move(name));
  std::ranges::sort(names);
  return names;
}

}  // namespace signweave
