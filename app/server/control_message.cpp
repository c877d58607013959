#include "app/server/control_message.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "signweave/core/text.h"

namespace signweave::server {
namespace {

[[noreturn]] void fail(const std::string& text) {
  throw Error(ErrorCode::bad_input, text);
}

std::string text_of(const std::string& name, const nlohmann::json& value) {
  if (!value.is_string()) fail(fmt::format("'{}' must be a string", name));
  return value.get<std::string>();
}

double number_of(const std::string& name, const nlohmann::json& value, double least, double most) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= least && number <= most)) fail(fmt::format("'{}' must be a number, {} to {}", name, least, most));
  return number;
}

std::size_t count_of(const std::string& name, const nlohmann::json& value, std::size_t least, std::size_t most) {
  if (!value.is_number_integer() || value.get<double>() < static_cast<double>(least) ||
      value.get<double>() > static_cast<double>(most)) {
    fail(fmt::format("'{}' must be a whole number, {} to {}", name, least, most));
  }
  return value.get<std::size_t>();
}

bool truth_of(const std::string& name, const nlohmann::json& value) {
  if (!value.is_boolean()) fail(fmt::format("'{}' must be true or false", name));
  return value.get<bool>();
}

/// The index of a word among the allowed ones.
template <std::size_t N>
std::size_t one_of(const std::string& name, const nlohmann::json& value, const std::array<std::string_view, N>& words) {
  if (value.is_string()) {
    for (std::size_t i = 0; i < N; ++i) {
      if (value.get_ref<const std::string&>() == words[i]) return i;
    }
  }
  fail(fmt::format("'{}' must be one of {}", name, fmt::join(words, ", ")));
}

FrameRate rate_of(const std::string& name, const nlohmann::json& value) {
  std::optional<FrameRate> rate;
  if (value.is_string()) rate = parse_frame_rate(value.get_ref<const std::string&>());
  if (value.is_number()) rate = parse_frame_rate(value.dump());
  if (!rate || rate->hertz() < 1 || rate->hertz() > 2'000) {
    fail(fmt::format("'{}' must be 1 to 2000 frames per second, such as 60 or \"30000/1001\"", name));
  }
  return *rate;
}

DurationModel duration_of(const std::string& name, const nlohmann::json& value) {
  if (value.is_number()) {
    return {.fixed = Milliseconds(std::llround(number_of(name, value, 0, 60'000))), .fitted = false};
  }
  if (value != "fitted" && value != "corpus") fail(fmt::format("'{}' must be fitted, corpus or 0 to 60000 ms", name));
  return {.fixed = {}, .fitted = value == "fitted"};
}

const TransitionMethod* method_of(const std::string& name, const nlohmann::json& value) {
  const std::string wanted = text_of(name, value);
  std::vector<std::string> known;
  for (const TransitionMethod& method : transition_methods()) {
    if (method.name == wanted) return find_transition_method(wanted);
    known.emplace_back(method.name);
  }
  fail(fmt::format("no transition '{}'; available: {}", printable(wanted), fmt::join(known, ", ")));
}

using Read = void (*)(ControlMessage&, const std::string& name, const nlohmann::json&);

void read_missing(ControlMessage& message, const std::string& name, const nlohmann::json& value) {
  message.folds = one_of<2>(name, value, {"explain", "fold"}) == 1;
}

struct Field {
  Control control;
  std::string_view name;
  bool required;
  Read read;
};
constexpr Field kFields[] = {
    {Control::open, "rate", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.player.synthesis.rate = rate_of(n, v);
     }},
    {Control::open, "batch", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.open.batch = count_of(n, v, 1, 600); }},
    {Control::open, "pace", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.pace = one_of<2>(n, v, {"live", "fast"}) == 0 ? Pace::live : Pace::fast;
     }},
    {Control::open, "idle", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.player.idle = one_of<2>(n, v, {"rest", "end"}) == 0 ? Idle::living_rest : Idle::end;
     }},
    {Control::open, "look_ahead", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.player.look_ahead = count_of(n, v, 1, 16);
     }},
    {Control::open, "loop", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.open.player.loop = truth_of(n, v); }},
    {Control::open, "recording", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.open.player.recording = text_of(n, v); }},
    {Control::open, "face", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.open.player.face = truth_of(n, v); }},
    {Control::open, "handedness", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.player.synthesis.handedness = one_of<2>(n, v, {"left", "right"}) == 0 ? Side::left : Side::right;
     }},
    {Control::open, "strict", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.player.synthesis.strict = truth_of(n, v);
     }},
    {Control::open, "character", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.open.character = text_of(n, v); }},
    {Control::open, "transition", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.player.synthesis.method = method_of(n, v);
     }},
    {Control::open, "duration", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.player.synthesis.duration = duration_of(n, v);
     }},
    {Control::open, "tempo", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.open.player.synthesis.tempo = number_of(n, v, 0.25, 4);
     }},
    {Control::open, "align", false,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       constexpr std::array kAlignments = {Alignment::automatic, Alignment::ground, Alignment::none};
       m.open.player.synthesis.alignment = kAlignments[one_of<3>(n, v, {"auto", "ground", "none"})];
     }},
    {Control::sign, "utterance", true,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.utterance_text = text_of(n, v); }},
    {Control::sign, "missing", false, read_missing},
    {Control::append, "missing", false, read_missing},
    {Control::append, "utterance", true,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.utterance_text = text_of(n, v); }},
    {Control::seek, "ms", true,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) {
       m.at = Milliseconds(std::llround(number_of(n, v, 0, 1e9)));
     }},
    {Control::tempo, "value", true,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.tempo = number_of(n, v, 0.25, 2); }},
    {Control::loop, "value", true,
     [](ControlMessage& m, const std::string& n, const nlohmann::json& v) { m.loop = truth_of(n, v); }},
};

constexpr std::array<std::string_view, 11> kTypes = {"open",  "sign", "append", "pause", "resume", "seek",
                                                     "tempo", "loop", "stop",   "score", "ping"};

Control control_of(const nlohmann::json& object) {
  const auto type = object.find("type");
  if (type == object.end() || !type->is_string()) fail("a control message needs a \"type\"");
  const std::string& wanted = type->get_ref<const std::string&>();
  for (std::size_t i = 0; i < kTypes.size(); ++i) {
    if (wanted == kTypes[i]) return static_cast<Control>(i);
  }
  const std::vector<std::string> known(kTypes.begin(), kTypes.end());
  fail(fmt::format("no control message '{}'{}", printable(wanted), did_you_mean(wanted, known)));
}

void read_fields(ControlMessage& message, const nlohmann::json& object) {
  for (const auto& [name, value] : object.items()) {
    if (name == "type" || name == "id") continue;
    const auto* field = std::ranges::find_if(
        kFields, [&, &key = name](const Field& f) { return f.control == message.control && f.name == key; });
    if (field == std::end(kFields)) {
      std::vector<std::string> known = {"id"};
      for (const Field& f : kFields) {
        if (f.control == message.control) known.emplace_back(f.name);
      }
      fail(fmt::format("'{}' has no field '{}'{}", kTypes[static_cast<std::size_t>(message.control)], printable(name),
                       did_you_mean(name, known)));
    }
    field->read(message, name, value);
  }
  for (const Field& field : kFields) {
    if (field.control == message.control && field.required && !object.contains(field.name)) {
      fail(fmt::format("'{}' needs a field '{}'", kTypes[static_cast<std::size_t>(message.control)], field.name));
    }
  }
}

}  // namespace

ControlMessage parse_control(std::string_view text, const UtteranceWords& words) {
  ControlMessage message;
  try {
    const nlohmann::json object = nlohmann::json::parse(text);
    if (!object.is_object()) fail("a control message is a JSON object");
    if (const auto id = object.find("id"); id != object.end()) {
      if (!id->is_string() && !id->is_number()) fail("'id' must be a string or a number");
      std::string written = id->dump();
      if (written.size() > 256) fail("'id' must not be longer than 256 bytes");
      message.id = std::move(written);
    }
    message.control = control_of(object);
    read_fields(message, object);
    if (message.control == Control::sign || message.control == Control::append) {
      UtteranceWords known = words;
      known.follows = message.control == Control::append;
      message.utterance = parse_utterance(message.utterance_text, known);
    }
  } catch (const nlohmann::json::exception& error) {
    const std::string_view what = error.what();  // "[json.exception.parse_error.101] parse error at …"
    const std::size_t mark = what.find("] ");
    throw ControlError(ErrorCode::bad_input,
                       fmt::format("not JSON: {}", printable(what.substr(mark == what.npos ? 0 : mark + 2))),
                       message.id);
  } catch (const Error& error) {
    throw ControlError(error.code(), error.what(), message.id);
  }
  return message;
}

}  // namespace signweave::server
