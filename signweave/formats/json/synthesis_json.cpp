#include "signweave/formats/json/synthesis_json.h"

#include "signweave/score/junction_choice.h"

namespace signweave {
namespace {

using nlohmann::json;

json span_json(TimeSpan span) {
  return {{"begin_ms", span.begin.count()}, {"end_ms", span.end.count()}};
}

json range_json(FrameRange frames) {
  return {{"begin", frames.begin}, {"end", frames.end}};
}

json object_of(const std::vector<std::pair<std::string, std::string>>& declarations) {
  json object = json::object();
  for (const auto& [name, value] : declarations) object[name] = value;
  return object;
}

std::string line_of(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace) + '\n';
}

json motion_json(const Motion& motion) {
  json joints = json::array();
  for (const Joint& joint : motion.skeleton().joints()) {
    joints.push_back({{"name", joint.name},
                      {"parent", joint.parent},
                      {"offset", {joint.offset.x(), joint.offset.y(), joint.offset.z()}},
                      {"translated", joint.translated}});
  }
  json rotations = json::array();
  json translations = json::array();
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const PoseView pose = motion.pose(frame);
    json row = json::array();
    for (const Eigen::Quaternionf& q : pose.rotations) row.insert(row.end(), {q.x(), q.y(), q.z(), q.w()});
    rotations.push_back(std::move(row));
    row = json::array();
    for (const Eigen::Vector3f& t : pose.translations) row.insert(row.end(), {t.x(), t.y(), t.z()});
    translations.push_back(std::move(row));
  }
  json tracks = json::object();
  for (const ScalarTrack& track : motion.tracks()) tracks[track.name] = track.values;
  return {{"frames_per_second", motion.rate().hertz()},
          {"frames", motion.frame_count()},
          {"joints", std::move(joints)},
          {"rotations_xyzw", std::move(rotations)},
          {"translations_m", std::move(translations)},
          {"tracks", std::move(tracks)}};
}

/// What the request said of this junction alone.
json chosen_json(const JunctionChoice& chosen) {
  json asked = json::object();
  if (chosen.method != nullptr) asked["method"] = chosen.method->name;
  if (chosen.duration) asked["duration_ms"] = chosen.duration->count();
  if (chosen.tempo) asked["tempo"] = *chosen.tempo;
  return asked;
}

}  // namespace

json report_json(const Synthesis& synthesis) {
  json signs = json::array();
  for (const PlacedSign& placed : synthesis.signs) {
    json phases = json::array();
    for (const Phase& phase : placed.sign.phases) {
      json one = span_json(phase.span);
      one["kind"] = name_of(phase.kind);
      phases.push_back(std::move(one));
    }
    json sign = span_json(placed.sign.span);
    sign["gloss"] = placed.sign.gloss;
    sign["place"] = placed.place;
    sign["clip"] = placed.clip;
    sign["recording"] = synthesis.clips[placed.clip].recording;
    sign["recorded"] = span_json(placed.recorded);
    sign["phases"] = std::move(phases);
    signs.push_back(std::move(sign));
  }
  json clips = json::array();
  for (std::size_t i = 0; i < synthesis.clips.size(); ++i) {
    const ShownClip& placed = synthesis.clips[i];
    clips.push_back({{"clip", i},
                     {"place", synthesis.score.clips[i].place},
                     {"recording", placed.recording},
                     {"frames", range_json(placed.output)},
                     {"kept_frames", range_json(placed.core)},
                     {"kept_from_recorded_frame", placed.first_frame},
                     {"recorded_frames_per_frame", placed.step}});
  }
  json junctions = json::array();
  for (std::size_t i = 0; i < synthesis.junctions.size(); ++i) {
    const Junction& junction = synthesis.junctions[i];
    json parts = json::object();
    for (const Timed part : kAllTimed) {
      const TransitionCut& cut = junction.cuts[static_cast<std::size_t>(part)];
      parts[std::string(name_of(part))] = {{"retraction_frames", cut.retraction_frames},
                                           {"preparation_frames", cut.preparation_frames},
                                           {"waits", cut.waits}};
    }
    junctions.push_back({{"number", junction.number},
                         {"place", synthesis.score.clips[i + 1].place},
                         {"from_clip", i},
                         {"to_clip", i + 1},
                         {"from", junction.from},
                         {"to", junction.to},
                         {"method", junction.method},
                         {"frames", range_json(junction.frames)},
                         {"retraction_frames", junction.cut.retraction_frames},
                         {"preparation_frames", junction.cut.preparation_frames},
                         {"blend_frames", junction.cut.blend_frames},
                         {"parts", std::move(parts)}});
    if (!junction.chosen.empty()) junctions.back()["chosen"] = chosen_json(junction.chosen);
  }
  return {{"frames", synthesis.motion.frame_count()},
          {"frames_per_second", synthesis.motion.rate().hertz()},
          {"signs", std::move(signs)},
          {"stretches", std::move(clips)},
          {"junctions", std::move(junctions)}};
}

std::string motion_json_text(const Motion& motion,
                             const std::vector<std::pair<std::string, std::string>>& declarations) {
  json document = motion_json(motion);
  document["declarations"] = object_of(declarations);
  return line_of(document);
}

std::string synthesis_json_text(const Synthesis& synthesis) {
  json document = report_json(synthesis);
  json sources = json::array();
  for (const FrameSource& source : synthesis.sources) {
    // Of each output frame: its recording's clip and frame, or the junction that it was made for.
    if (source.clip != FrameSource::kNone) {
      sources.push_back({{"stretch", source.clip}, {"frame", source.frame}});
    } else {
      sources.push_back({{"junction", source.junction}});
    }
  }
  document["sources"] = std::move(sources);
  document["declarations"] = object_of(synthesis.declarations);
  document["motion"] = motion_json(synthesis.motion);
  return line_of(document);
}

}  // namespace signweave
