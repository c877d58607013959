#include "signweave/notation/score_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "signweave/core/error.h"
#include "signweave/notation/answer_json.h"
#include "signweave/notation/score_fields.h"

namespace signweave {
namespace {

using Json = nlohmann::ordered_json;

/// Puts each list of numbers on one line, for readability.
std::string with_short_lists(const std::string& json) {
  std::string text;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') in_string = !in_string;
    if (in_string && c == '\\') {  // including the escaped character
      text += json.substr(i++, 2);
      continue;
    }
    text += c;
    if (in_string || c != '[') continue;
    const std::size_t end = json.find_first_not_of("0123456789+-.eE, \n", i + 1);
    if (end == std::string::npos || json[end] != ']') continue;
    for (std::size_t k = i + 1; k < end; ++k) {
      if (json[k] != ' ' && json[k] != '\n') text += json[k];
      if (json[k] == ',') text += ' ';
    }
    i = end - 1;
  }
  return text;
}

/// A value and its path in the document.
class Value {
 public:
  Value(const std::string& file, const Json& json, std::string place)
      : file_(file), json_(json), place_(std::move(place)) {}

  [[noreturn]] void fail(std::string_view wanted) const {
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: {}: it must be {}", file_, place_.empty() ? "the whole" : place_, wanted));
  }
  Value operator[](const char* key) const {
    if (!json_.is_object()) fail("an object");
    const auto found = json_.find(key);
    if (found == json_.end()) fail(fmt::format("an object with a member '{}'", key));
    return {file_, *found, place_.empty() ? key : fmt::format("{}.{}", place_, key)};
  }
  Value at(std::size_t index) const { return {file_, json_[index], fmt::format("{}[{}]", place_, index)}; }
  bool has(const char* key) const { return json_.is_object() && json_.contains(key); }
  bool is_null() const { return json_.is_null(); }
  std::size_t size() const {
    if (!json_.is_array()) fail("a list");
    return json_.size();
  }
  std::int64_t whole() const {
    if (!json_.is_number_integer() || (json_.is_number_unsigned() && json_.get<std::uint64_t>() > INT64_MAX)) {
      fail("a whole number");
    }
    return json_.get<std::int64_t>();
  }
  template <class Count>
  Count count() const {
    const std::int64_t number = whole();
    if (number < 0 || static_cast<std::uint64_t>(number) > std::uint64_t{UINT32_MAX})
      fail("a whole number of 0 or more");
    return static_cast<Count>(number);
  }
  double number() const {
    if (!json_.is_number()) fail("a number");
    const auto number = json_.get<double>();
    if (!std::isfinite(number)) fail("a finite number");
    return number;
  }
  std::string text() const {
    if (!json_.is_string()) fail("a text");
    return json_.get<std::string>();
  }
  bool flag() const {
    if (!json_.is_boolean()) fail("true or false");
    return json_.get<bool>();
  }
  FrameRange frames() const {
    if (size() != 2) fail("a list of two frames");
    return {at(0).whole(), at(1).whole()};
  }
  TimeSpan span() const {
    if (size() != 2) fail("a list of two moments, in milliseconds");
    return {Milliseconds(at(0).whole()), Milliseconds(at(1).whole())};
  }
  template <class Kind, std::size_t Count>
  Kind one_of(const std::array<Kind, Count>& kinds) const {
    const std::string name = text();
    std::string all;
    for (const Kind kind : kinds) {
      if (name == name_of(kind)) return kind;
      all += (all.empty() ? "" : ", ") + std::string(name_of(kind));
    }
    fail("one of " + all);
  }

 private:
  const std::string& file_;
  const Json& json_;
  std::string place_;
};

SourceRef source_from(const Value& value) {
  constexpr std::array kKinds = {SourceRef::Kind::recording, SourceRef::Kind::rest, SourceRef::Kind::shown};
  SourceRef source{.recording = value["recording"].text()};
  if (value.has("kind")) source.kind = value["kind"].one_of(kKinds);
  const Value print = value["fingerprint"];
  const std::string digits = print.text();
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), source.fingerprint, 16);
  if (error != std::errc() || end != digits.data() + digits.size()) print.fail("a hexadecimal number");
  return source;
}

Sign sign_from(const Value& value) {
  constexpr std::array kKinds = {PhaseKind::preparation, PhaseKind::stroke, PhaseKind::retraction, PhaseKind::hold,
                                 PhaseKind::other};
  constexpr std::array kHands = {Hand::both, Hand::right, Hand::left};
  Sign sign{.gloss = value["gloss"].text(),
            .span = value["ms"].span(),
            .phases = {},
            .hand = value["hand"].one_of(kHands),
            .signer = value["signer"].text(),
            .tier = value["tier"].text(),
            .annotation = value["annotation"].text(),
            .inferred = value["inferred"].flag()};
  const Value phases = value["phases"];
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const Value phase = phases.at(i);
    sign.phases.push_back(
        {phase["kind"].one_of(kKinds), phase["ms"].span(), phase["label"].text(), phase["annotation"].text()});
  }
  return sign;
}

void fill_numbers(const Value& from, auto& numbers) {
  if (from.size() != static_cast<std::size_t>(numbers.size())) {
    from.fail(fmt::format("a list of {} numbers", numbers.size()));
  }
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    numbers[i] = static_cast<float>(from.at(static_cast<std::size_t>(i)).number());
  }
}

GroundTransform standing_from(const Value& value) {
  GroundTransform standing;
  fill_numbers(value["turn"], standing.turn.coeffs());
  fill_numbers(value["shift"], standing.shift);
  return standing;
}

HandPlace hand_place_from(const Value& value) {
  HandPlace place{.anchor = value["anchor"].one_of(kAnchors),
                  .kept_in = value["kept_in"].one_of(kAnchors),
                  .out = {},
                  .moved_mm = static_cast<float>(value["moved_mm"].number()),
                  .turned_degrees = static_cast<float>(value["turned_degrees"].number())};
  fill_numbers(value["out"], place.out);
  return place;
}

float float_from(const Value& value) {
  return static_cast<float>(value.number());
}

ArmChange arm_change_from(const Value& value) {
  ArmChange arm;
  const Value columns = value["linear"];
  if (columns.size() != 3) columns.fail("a list of three columns");
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::Vector3f column;
    fill_numbers(columns.at(static_cast<std::size_t>(i)), column);
    arm.linear.col(i) = column;
  }
  fill_numbers(value["from"], arm.from);
  fill_numbers(value["to"], arm.to);
  fill_numbers(value["turn"], arm.turn.coeffs());
  fill_numbers(value["carry"], arm.carry.coeffs());
  arm.swivel = float_from(value["swivel"]);
  const Value path = value["path"];
  if (path.size() > kMostPathPoints) path.fail(fmt::format("a list of at most {} points", kMostPathPoints));
  for (std::size_t i = 0; i < path.size(); ++i) {
    PathPoint& point = arm.path.emplace_back();
    fill_numbers(path.at(i)["shift"], point.shift);
    fill_numbers(path.at(i)["turn"], point.turn);
    point.swivel = float_from(path.at(i)["swivel"]);
  }
  return arm;
}

ClipChange change_from(const Value& value) {
  ClipChange change{.asked = value["asked"].text(),
                    .basis = value["basis"].one_of(kChangeBases),
                    .moved_mm = float_from(value["moved_mm"]),
                    .turned_degrees = float_from(value["turned_degrees"]),
                    .share = float_from(value["share"]),
                    .missed_mm = float_from(value["missed_mm"]),
                    .aim_degrees = float_from(value["aim_degrees"])};
  if (value.has("because")) change.because = value["because"].text();
  if (value.has("limit")) change.limit = value["limit"].text();
  const Value arms = value["arms"];
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Side side = arms.at(i)["hand"].one_of(kSides);
    change.stroke.arms[static_cast<std::size_t>(side)] = arm_change_from(arms.at(i));
  }
  change.stroke.together = value["together"].flag();
  change.stroke.trunk_yaw = float_from(value["trunk_yaw"]);
  change.stroke.before = value["before"].whole();
  change.stroke.after = value["after"].whole();
  return change;
}

Clip clip_from(const Value& value) {
  Clip clip{.id = value["id"].count<ClipId>(),
            .place = value["place"].count<std::size_t>(),
            .source = source_from(value["source"]),
            .whole = value["whole"].frames(),
            .core = value["core"].frames(),
            .step = value["step"].number(),
            .at = value["at"].frames(),
            .standing = {},
            .clock = {Seconds(value["clock"]["frame_time"].number()), Seconds(value["clock"]["origin"].number())},
            .signs = {},
            .sign_places = {}};
  if (!value["standing"].is_null()) clip.standing = standing_from(value["standing"]);
  if (value.has("mirrored")) clip.mirrored = value["mirrored"].flag();
  if (value.has("at_rest")) clip.at_rest = value["at_rest"].flag();
  if (value.has("changes")) {
    const Value changes = value["changes"];
    for (std::size_t i = 0; i < changes.size(); ++i) clip.changes.push_back(change_from(changes.at(i)));
  }
  const Value signs = value["signs"];
  for (std::size_t i = 0; i < signs.size(); ++i) {
    clip.signs.push_back(sign_from(signs.at(i)));
    clip.sign_places.push_back(signs.at(i)["place"].count<std::size_t>());
  }
  return clip;
}

Milliseconds time_from(const Value& value) {
  const std::int64_t ms = value.whole();
  if (ms < -86'400'000 || ms > 86'400'000) value.fail("a time of at most a day, in milliseconds");
  return Milliseconds(ms);
}

HeadAngles angles_from(const Value& value) {
  return {static_cast<float>(value["pitch"].number()), static_cast<float>(value["yaw"].number()),
          static_cast<float>(value["roll"].number())};
}

AuthoredCurve curve_from(const Value& value) {
  constexpr std::array kMerges = {Merge::usual, Merge::maximum, Merge::sum, Merge::replace};
  const Value places = value["places"];
  if (places.size() != 2) places.fail("a list of two places");
  AuthoredCurve one{.curve = {},
                    .at = value["at"].frames(),
                    .first = places.at(0).count<std::size_t>(),
                    .last = places.at(1).count<std::size_t>()};
  Curve& curve = one.curve;
  curve.name = value["name"].text();
  curve.onset = time_from(value["onset_ms"]);
  curve.offset = time_from(value["offset_ms"]);
  curve.amount = static_cast<float>(value["amount"].number());
  curve.merge = value["merge"].one_of(kMerges);
  const Value weights = value["weights"];
  for (std::size_t i = 0; i < weights.size(); ++i) {
    curve.weights.push_back({weights.at(i)["track"].text(), static_cast<float>(weights.at(i)["weight"].number())});
  }
  if (value.has("head")) {
    const Value head = value["head"];
    curve.head = {.turn = angles_from(head["turn"]),
                  .swing = angles_from(head["swing"]),
                  .hertz = static_cast<float>(head["hertz"].number()),
                  .delay = time_from(head["delay_ms"]),
                  .onset = time_from(head["onset_ms"]),
                  .offset = time_from(head["offset_ms"])};
  }
  if (value.has("mouth")) {
    const Value mouth = value["mouth"];
    for (std::size_t i = 0; i < mouth.size(); ++i) {
      const Value key = mouth.at(i);
      const std::optional<Viseme> viseme = viseme_named(key["viseme"].text());
      if (!viseme) key["viseme"].fail("a viseme, such as PP or aa");
      curve.mouth.push_back({.viseme = *viseme,
                             .at = time_from(key["at_ms"]),
                             .held = time_from(key["held_ms"]),
                             .strength = static_cast<float>(key["strength"].number())});
    }
  }
  if (value.has("gaze")) {
    curve.gaze = GazeDirection{static_cast<float>(value["gaze"]["yaw"].number()),
                               static_cast<float>(value["gaze"]["pitch"].number())};
  }
  return one;
}

Item item_from(const Value& value) {
  Item item{.what = {}, .at = value["at"].frames()};
  if (value.has("clip")) {
    ClipUse use{.clip = value["clip"].count<ClipId>()};
    if (value.has("hand")) use.place = hand_place_from(value["hand"]);
    item.what = use;
    return item;
  }
  if (value.has("hold")) {
    item.what = Hold{value["hold"].count<ClipId>()};
    return item;
  }
  const Value made = value["transition"];
  item.what = Transition{.from = made["from"].count<ClipId>(),
                         .to = made["to"].count<ClipId>(),
                         .cut = {.length = made["length"].whole(),
                                 .retraction_frames = made["retraction"].whole(),
                                 .preparation_frames = made["preparation"].whole(),
                                 .blend_frames = made["blend"].whole(),
                                 .pause_frames = made["pause"].whole(),
                                 .waits = made["waits"].flag()}};
  return item;
}

}  // namespace

int version_of(const Score& score) noexcept {
  const auto is_changed = [](const Clip& clip) { return !clip.changes.empty(); };
  if (std::ranges::any_of(score.clips, is_changed)) return 3;
  const bool has_parts = score.lanes.size() > kChannels.size() || body_clips(score) != score.clips.size();
  const bool has_holds = std::ranges::any_of(score.lanes, [](const Lane& lane) {
    return std::ranges::any_of(lane.items, [](const Item& item) { return std::holds_alternative<Hold>(item.what); });
  });
  return has_parts || has_holds || !score.curves.empty() ? 2 : 1;
}

std::string text_of_fingerprint(std::uint64_t fingerprint) {
  return fmt::format("{:016x}", fingerprint);
}

std::vector<ScoreSign> signs_of(const Clip& clip) {
  std::vector<ScoreSign> signs;
  for (std::size_t i = 0; i < clip.signs.size(); ++i) signs.push_back({clip.sign_places[i], clip.signs[i]});
  return signs;
}

std::vector<ScoreArmChange> arms_of(const StrokeChange& change) {
  std::vector<ScoreArmChange> arms;
  for (const Side side : kSides) {
    if (const auto& arm = change.arms[static_cast<std::size_t>(side)]) arms.push_back({side, *arm});
  }
  return arms;
}

std::vector<ScoreChange> changes_of(const Clip& clip) {
  std::vector<ScoreChange> changes;
  for (const ClipChange& change : clip.changes) changes.push_back({change});
  return changes;
}

std::string json_of(const Score& score) {
  return with_short_lists(answer_json(score).dump(1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

std::string json_line_of(const Score& score) {
  return answer_json(score).dump(-1, ' ', false, Json::error_handler_t::replace);
}

Score score_from_json(std::string_view text, const std::string& file) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t byte = std::min<std::size_t>(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
    throw Error(ErrorCode::bad_input,
                fmt::format("{}:{}: this is not JSON; scores are written by signing or editing", file, line));
  } catch (const Json::exception&) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: a number that is too large for any member of a score", file));
  }
  const Value all(file, json, "");
  if (!all.has("signweave_score")) all.fail("a score, with its version as 'signweave_score'");
  const std::int64_t version = all["signweave_score"].whole();
  if (version < 1) all["signweave_score"].fail("a version, from 1");
  if (version > kScoreVersion) {
    throw Error(ErrorCode::unsupported,
                fmt::format("{}: a score of version {}; this program reads up to {}", file, version, kScoreVersion));
  }
  Score score{.skeleton = source_from(all["skeleton"]),
              .rate = {},
              .frames = all["frames"].whole(),
              .clips = {},
              .junctions = {},
              .lanes = {},
              .curves = {}};
  if (all["rate"].size() != 2) all["rate"].fail("a list of two numbers, frames and seconds");
  score.rate = {all["rate"].at(0).whole(), all["rate"].at(1).whole()};
  const Value clips = all["clips"];
  for (std::size_t i = 0; i < clips.size(); ++i) score.clips.push_back(clip_from(clips.at(i)));
  const Value junctions = all["junctions"];
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    score.junctions.push_back({junctions.at(i)["number"].count<std::size_t>(), junctions.at(i)["method"].text(),
                               junctions.at(i)["chosen"].text()});
  }
  const Value lanes = all["lanes"];
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    Lane lane{.channel = lanes.at(i)["channel"].one_of(kAllChannels), .items = {}};
    const Value items = lanes.at(i)["items"];
    for (std::size_t k = 0; k < items.size(); ++k) lane.items.push_back(item_from(items.at(k)));
    score.lanes.push_back(std::move(lane));
  }
  if (all.has("curves")) {
    const Value curves = all["curves"];
    for (std::size_t i = 0; i < curves.size(); ++i) score.curves.push_back(curve_from(curves.at(i)));
  }
  check(score, file);
  return score;
}

}  // namespace signweave
