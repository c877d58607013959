#include "signweave/formats/gltf/tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "signweave/core/text.h"

namespace signweave::gltf {
namespace {

/// Collects tracks, each name once.
class TrackList {
 public:
  /// `other` is the name to use if the track's own is taken by one with other values.
  void add(ScalarTrack track, const std::string& other) {
    const auto known = by_name_.find(track.name);
    if (known == by_name_.end()) return insert(std::move(track));
    if (tracks_[known->second].values == track.values) return;
    track.name = other;
    for (int number = 2; by_name_.contains(track.name); ++number) track.name = fmt::format("{} {}", other, number);
    insert(std::move(track));
  }
  std::vector<ScalarTrack> take() { return std::move(tracks_); }

 private:
  void insert(ScalarTrack track) {
    by_name_.emplace(track.name, tracks_.size());
    tracks_.push_back(std::move(track));
  }
  std::vector<ScalarTrack> tracks_;
  std::unordered_map<std::string, std::size_t> by_name_;
};

void add_weight_tracks(const std::string& file, const Curve& curve, const MorphMesh& mesh, const Timing& timing,
                       TrackList& list) {
  const auto frames = static_cast<std::size_t>(timing.frames);
  std::vector<ScalarTrack> tracks(curve.parts);
  for (ScalarTrack& track : tracks) track.values.resize(frames);
  CurveReader reader(curve, timing.rate.frame_time().count());
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const std::span<const double> values = reader.at(static_cast<double>(frame));
    for (std::size_t i = 0; i < tracks.size(); ++i) tracks[i].values[frame] = static_cast<float>(values[i]);
  }
  for (const ScalarTrack& track : tracks) {
    if (std::ranges::all_of(track.values, [](float value) { return std::isfinite(value); })) continue;
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}: weights too large for a float", file, curve.place));
  }
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const bool named = i < mesh.target_names.size();
    tracks[i].name = named ? mesh.target_names[i] : fmt::format("{}.weight.{}", mesh.name, i);
    const std::string other = fmt::format("{}.{}", mesh.name, tracks[i].name);
    list.add(std::move(tracks[i]), other);
  }
}

/// A track of the extras as written by our writer; nullopt if it has another form.
struct ExtrasTrack {
  const std::string* name = nullptr;
  double hertz = 0;
  const nlohmann::json* values = nullptr;
};

std::optional<ExtrasTrack> extras_track(const nlohmann::json& json) {
  if (!json.is_object()) return std::nullopt;
  const auto name = json.find("name");
  const auto rate = json.find("rate");
  const auto values = json.find("values");
  if (name == json.end() || !name->is_string() || rate == json.end() || !rate->is_number()) return std::nullopt;
  if (values == json.end() || !values->is_array() || values->empty()) return std::nullopt;
  const double hertz = rate->get<double>();
  if (!(hertz >= 1e-4 && hertz <= 1e6)) return std::nullopt;
  const auto is_float = [](const nlohmann::json& value) {
    return value.is_number() && std::abs(value.get<double>()) <= std::numeric_limits<float>::max();
  };
  if (!std::ranges::all_of(*values, is_float)) return std::nullopt;
  return ExtrasTrack{&name->get_ref<const std::string&>(), hertz, &*values};
}

/// Its values at the frames, the first one at frame 0: linear between, the last one held.
std::vector<float> extras_values(const ExtrasTrack& extra, const Timing& timing) {
  const nlohmann::json& values = *extra.values;
  const double step = extra.hertz / timing.rate.hertz();
  const bool same = std::abs(step - 1) < 1e-9;
  std::vector<float> result;
  result.reserve(static_cast<std::size_t>(timing.frames));
  for (std::int64_t frame = 0; frame < timing.frames; ++frame) {
    const double at = static_cast<double>(frame) * (same ? 1.0 : step);
    const std::size_t last = values.size() - 1;
    const std::size_t before = at >= static_cast<double>(last) ? last : static_cast<std::size_t>(at);
    const double part = before == last ? 0 : at - static_cast<double>(before);
    double value = values[before].get<double>();
    if (part > 0) value += part * (values[before + 1].get<double>() - value);
    result.push_back(static_cast<float>(value));
  }
  return result;
}

}  // namespace

std::vector<ScalarTrack> tracks_of(const Content& content, const Take& take, const Timing& timing, Budget& budget,
                                   std::vector<Notice>& notices) {
  TrackList list;
  for (std::size_t node = 0; node < take.nodes.size(); ++node) {
    const Curve* const curve = take.nodes[node].weights;
    if (curve == nullptr) continue;
    budget.spend(static_cast<std::uint64_t>(timing.frames), curve->parts * sizeof(float), "its morph weights");
    add_weight_tracks(content.name, *curve, content.meshes[static_cast<std::size_t>(content.model.nodes[node].mesh)],
                      timing, list);
  }
  const nlohmann::json& extras = content.tracks[take.animation];
  if (extras.is_null()) return list.take();
  std::size_t odd = 0;
  for (const nlohmann::json& json : extras) {
    const std::optional<ExtrasTrack> extra = extras_track(json);
    if (!extra) {
      ++odd;
      continue;
    }
    budget.spend(static_cast<std::uint64_t>(timing.frames), sizeof(float), "its tracks");
    list.add({.name = *extra->name, .values = extras_values(*extra, timing)}, "tracks." + *extra->name);
  }
  if (odd > 0) {
    notices.push_back({content.name, fmt::format("animation {}: {} 'tracks' in its extras that are not name, rate and "
                                                 "numbers were left out",
                                                 take.animation, odd)});
  }
  return list.take();
}

}  // namespace signweave::gltf
