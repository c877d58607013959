#include "signweave/formats/json/synthesis_json.h"

#include <nlohmann/json.hpp>

#include "signweave/notation/answer_json.h"
#include "signweave/score/report.h"

namespace signweave {
namespace {

using nlohmann::json;

json object_of(const Declarations& declarations) {
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

}  // namespace

std::string motion_json_text(const Motion& motion, const Declarations& declarations) {
  json document = motion_json(motion);
  document["declarations"] = object_of(declarations);
  return line_of(document);
}

std::string synthesis_json_text(const Synthesis& synthesis) {
  auto document = answer_json<json>(report_of(synthesis));
  json sources = json::array();
  for (const FrameSource& source : synthesis.sources) {
    // Of each output frame: its recording's clip and frame, or the junction that it was made for.
    if (source.clip != FrameSource::kNone) {
      sources.push_back({{"clip", source.clip}, {"stretch", source.clip}, {"frame", source.frame}});  // former: stretch
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
