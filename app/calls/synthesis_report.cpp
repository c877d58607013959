#include "app/calls/synthesis_report.h"

#include "app/calls/json.h"

namespace signweave::calls {

using nlohmann::json;

namespace {

/// What was told for one junction alone.
json chosen_json(const JunctionChoice& chosen) {
  json told = json::object();
  if (chosen.method != nullptr) told["method"] = chosen.method->name;
  if (chosen.duration) told["duration_ms"] = chosen.duration->count();
  if (chosen.tempo) told["tempo"] = *chosen.tempo;
  return told;
}

}  // namespace

json describe(const Synthesis& synthesis) {
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
                     {"frames", frames_json(placed.output)},
                     {"kept_frames", frames_json(placed.core)},
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
                         {"frames", frames_json(junction.frames)},
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

}  // namespace signweave::calls
