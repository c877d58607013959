#include "app/server/stream_text.h"

#include <nlohmann/json.hpp>

namespace signweave::server {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void add_id(Json& json, std::string_view id) {
  if (!id.empty()) json["id"] = Json::parse(id);
}

Json list_of(const Eigen::Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}

std::string_view name_of(PlayerEvent::Kind kind) noexcept {
  switch (kind) {
    case PlayerEvent::Kind::place:
      return "place";
    case PlayerEvent::Kind::rest:
      return "rest";
    case PlayerEvent::Kind::end:
      return "end";
    case PlayerEvent::Kind::seek:
      return "seek";
    case PlayerEvent::Kind::notice:
      return "notice";
  }
  return "notice";
}

}  // namespace

std::string header_text(const StreamHeader& header, std::string_view database, Pace pace, std::size_t batch) {
  Json joints = Json::array();
  const Skeleton& skeleton = *header.skeleton;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const Joint& joint = skeleton.joint(static_cast<JointIndex>(j));
    joints.push_back({{"name", joint.name},
                      {"parent", static_cast<std::int64_t>(joint.parent)},
                      {"offset", list_of(joint.offset)},
                      {"translated", joint.translated}});
  }
  Json tips = Json::array();
  for (const Tip& tip : skeleton.tips()) {
    tips.push_back({{"joint", static_cast<std::int64_t>(tip.joint)}, {"offset", list_of(tip.offset)}});
  }
  Json translated = Json::array();
  for (const JointIndex joint : skeleton.translated_joints()) translated.push_back(static_cast<std::int64_t>(joint));
  Json declarations = Json::array();
  for (const auto& [name, value] : header.declarations) declarations.push_back({{"name", name}, {"value", value}});
  return line_of({{"type", "header"},
                  {"database", database},
                  {"recording", header.layout_from},
                  {"declarations", std::move(declarations)},
                  {"rate", header.rate.hertz()},
                  {"rate_fraction", {header.rate.numerator, header.rate.denominator}},
                  {"pace", pace == Pace::live ? "live" : "fast"},
                  {"batch", batch},
                  {"layout", 1},
                  {"message_header_bytes", kMessageHeaderBytes},
                  {"frame_bytes", bytes_of(header.shape())},
                  {"joints", std::move(joints)},
                  {"translated", std::move(translated)},
                  {"tips", std::move(tips)},
                  {"tracks", header.tracks}});
}

std::string ok_text(std::string_view id, std::uint64_t frame) {
  Json json = {{"type", "ok"}, {"frame", frame}};
  add_id(json, id);
  return line_of(json);
}

std::string error_text(ErrorCode code, std::string_view message, std::string_view id) {
  Json json = {{"type", "error"}, {"code", name_of(code)}, {"message", message}};
  add_id(json, id);
  return line_of(json);
}

std::string event_text(const PlayerEvent& event) {
  Json json = {{"type", name_of(event.kind)}, {"frame", event.frame}};
  if (event.kind == PlayerEvent::Kind::place) {
    json["place"] = event.place;
    json["gloss"] = event.gloss;
    json["token"] = event.token;
    json["recording"] = event.recording;
  }
  json["ms"] = event.at.count();
  if (!event.text.empty()) json["text"] = event.text;
  return line_of(json);
}

}  // namespace signweave::server
