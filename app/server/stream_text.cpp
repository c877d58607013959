#include "app/server/stream_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "signweave/notation/score_json.h"

namespace signweave::server {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string line_of(const OrderedJson& object) {
  return object.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

void add_id(OrderedJson& object, std::string_view id) {
  if (!id.empty()) object["id"] = OrderedJson::parse(id);
}

OrderedJson list_of(const Eigen::Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}

/// Appends a text as a JSON string.
void add_quoted(std::string& line, std::string_view text) {
  const auto plain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
  if (!std::ranges::all_of(text, plain)) {
    line += line_of(OrderedJson(text));
    return;
  }
  line.append(1, '"').append(text).append(1, '"');
}

std::string_view event_name(PlayerEvent::Kind kind) noexcept {
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

std::string header_text(const StreamHeader& header, const HeaderContext& context) {
  OrderedJson joints = OrderedJson::array();
  const Skeleton& skeleton = *header.skeleton;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const Joint& joint = skeleton.joint(static_cast<JointIndex>(j));
    joints.push_back({{"name", joint.name},
                      {"parent", static_cast<std::int64_t>(joint.parent)},
                      {"offset", list_of(joint.offset)},
                      {"translated", joint.translated}});
  }
  OrderedJson tips = OrderedJson::array();
  for (const Tip& tip : skeleton.tips()) {
    tips.push_back({{"joint", static_cast<std::int64_t>(tip.joint)}, {"offset", list_of(tip.offset)}});
  }
  OrderedJson translated = OrderedJson::array();
  for (const JointIndex joint : skeleton.translated_joints()) translated.push_back(static_cast<std::int64_t>(joint));
  OrderedJson declarations = OrderedJson::array();
  for (const auto& [name, value] : header.declarations) declarations.push_back({{"name", name}, {"value", value}});
  OrderedJson object = {{"type", "header"}, {"database", context.database}, {"recording", header.layout_from}};
  if (!context.character.empty()) object["character"] = context.character;
  object["declarations"] = std::move(declarations);
  object["rate"] = header.rate.hertz();
  object["rate_fraction"] = {header.rate.numerator, header.rate.denominator};
  if (context.pace) {
    object["pace"] = *context.pace == Pace::live ? "live" : "fast";
    object["batch"] = context.batch;
  }
  object["layout"] = 1;
  object["message_header_bytes"] = kMessageHeaderBytes;
  object["frame_bytes"] = bytes_of(header.shape());
  object["joints"] = std::move(joints);
  object["translated"] = std::move(translated);
  object["tips"] = std::move(tips);
  object["tracks"] = header.tracks;
  return line_of(object);
}

std::string ok_text(std::string_view id, std::uint64_t frame) {
  OrderedJson object = {{"type", "ok"}, {"frame", frame}};
  add_id(object, id);
  return line_of(object);
}

std::string score_text(std::string_view id, const std::optional<ShownScore>& live, std::uint64_t frame) {
  std::string line = fmt::format(R"({{"type":"score","frame":{})", frame);
  if (live) {
    line += fmt::format(R"(,"score_frame":{},"first_clip":{},"score":{})", live->next, live->first_clip,
                        json_line_of(live->score));
  } else {
    line += R"(,"score":null)";
  }
  if (!id.empty()) line += fmt::format(R"(,"id":{})", id);
  return line += '}';
}

std::string error_text(ErrorCode code, std::string_view message, std::string_view id) {
  OrderedJson object = {{"type", "error"}, {"code", name_of(code)}, {"message", message}};
  add_id(object, id);
  return line_of(object);
}

std::string error_text(const Error& error, std::string_view id) {
  OrderedJson object = {{"type", "error"}, {"code", name_of(error.code())}, {"message", error.what()}};
  const nlohmann::json fault = wire::fault_json(error, name_of(error.code()), error.what());
  for (const char* field : {"missing", "suggestion", "remedies"}) {
    if (const auto at = fault.find(field); at != fault.end()) object[field] = *at;
  }
  add_id(object, id);
  return line_of(object);
}

// Streams report so many events that building each with a JSON library, whose nodes are spread over memory, would cost
// as much as the frames themselves.
std::string event_text(const PlayerEvent& event) {
  std::string line = fmt::format(R"({{"type":"{}","frame":{})", event_name(event.kind), event.frame);
  const auto to = std::back_inserter(line);
  if (event.kind == PlayerEvent::Kind::place) {
    fmt::format_to(to, R"(,"place":{},"clip":{},"gloss":)", event.place, event.clip);
    add_quoted(line, event.gloss);
    fmt::format_to(to, R"(,"token":{},"recording":)", event.token);
    add_quoted(line, event.recording);
  }
  fmt::format_to(to, R"(,"ms":{})", event.at.count());
  if (!event.text.empty()) {
    line += R"(,"text":)";
    add_quoted(line, event.text);
  }
  if (!event.code.empty()) {
    line += R"(,"code":)";
    add_quoted(line, event.code);
  }
  return line += '}';
}

}  // namespace signweave::server
