#include "signweave/calls/synthesis_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "signweave/choose/known_words.h"
#include "signweave/choose/missing_glosses.h"
#include "signweave/core/text.h"

namespace signweave::calls {

namespace {

std::optional<Milliseconds> parse_duration(const std::string& text) {
  int ms = 0;
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, ms);
  if (error != std::errc{} || parsed != end || ms < 0 || ms > kLongestTransition.count()) return std::nullopt;
  return Milliseconds(ms);
}

}  // namespace

std::vector<std::string> transition_names() {
  std::vector<std::string> names;
  for (const TransitionMethod& method : transition_methods()) names.emplace_back(method.name);
  return names;
}

std::string transition_help() {
  std::string methods = "how transitions are made:";
  for (const TransitionMethod& method : transition_methods()) {
    methods += fmt::format("\n  {}: {}", method.name, method.description);
  }
  return methods;
}

std::string check_duration(const std::string& text) {
  if (text == "corpus" || text == "fitted" || parse_duration(text)) return {};
  return fmt::format("'{}' is neither corpus, nor fitted, nor 0 to 60000 ms", printable(text));
}

std::string check_junction(const std::string& text) {
  try {
    parse_junction(text);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

SynthesisOptions options_of(const SynthesisChoices& choices) {
  SynthesisOptions options;
  options.method = find_transition_method(choices.transition);
  options.duration = {.fixed = parse_duration(choices.duration), .fitted = choices.duration == "fitted"};
  options.tempo = choices.tempo;
  options.junctions = parse_junctions(choices.junctions);
  options.explain = choices.explain;
  options.strict = choices.strict;
  if (!choices.rate.empty()) options.rate = parse_frame_rate(choices.rate);
  options.handedness = side_of(choices.handedness);
  options.alignment = choices.align == "ground" ? Alignment::ground
                      : choices.align == "none" ? Alignment::none
                                                : Alignment::automatic;
  return options;
}

namespace {

/// Adds "GLOSS=ROLE", instead of another role of the gloss.
void add_role(const std::string& text, SpaceRoles& roles) {
  const std::size_t at = text.rfind('=');
  const std::string gloss = at == std::string::npos ? std::string() : match_form(text.substr(0, at));
  if (!gloss.empty()) {
    for (const SpaceRole role : kSpaceRoles) {
      if (name_of(role) != text.substr(at + 1)) continue;
      roles[gloss] = role;
      return;
    }
  }
  throw Error(ErrorCode::bad_input, fmt::format("role '{}' is not GLOSS=ROLE; a role is forward, backward, aim, both "
                                                "or none, such as INVITER=backward",
                                                printable(text)));
}

}  // namespace

Synthesized run(const Database& database, const SignCall& call, std::int64_t most_frames) {
  SynthesisOptions options = options_of(call.how);
  options.most_frames = most_frames;
  options.non_manuals.expressions = call.expressions;
  options.non_manuals.gaze = call.non_manuals == "plan";
  options.non_manuals.blinks = call.blinks || call.non_manuals == "plan";
  options.non_manuals.pronounce.source = *mouthing_source(call.mouthing);
  options.non_manuals.pronounce.language = *mouthing_language(call.language);
  options.space.roles = call.roles;
  for (const std::string& text : call.role) add_role(text, options.space.roles);
  UtteranceWords words = words_of(database);
  words.is_expression = [&](std::string_view name) {
    return std::ranges::find(call.expressions, name, [](const NamedExpression& one) -> std::string_view {
             return one.curve.name;
           }) != call.expressions.end();
  };
  words.near_expressions = [&](std::string_view name) {
    std::vector<std::string> names;
    for (const NamedExpression& one : call.expressions) names.push_back(one.curve.name);
    return near_matches(name, names);
  };
  Utterance utterance = parse_utterance(call.utterance, words);
  std::vector<Notice> folded;
  if (call.missing == "fold") utterance = with_folded_glosses(utterance, *database.segments(), folded);
  Synthesized made = synthesize(database, utterance, options);
  made.result.notices.insert(made.result.notices.begin(), folded.begin(), folded.end());
  return made;
}

Synthesized run(const Database& database, const EditCall& call, std::int64_t most_frames) {
  Edit edit;
  for (const std::string& text : call.replace) edit.replacements.push_back(parse_replacement(text));
  if (!call.swap.empty()) edit.swap = parse_swap(call.swap);
  for (const std::string& text : call.replace_hand) edit.hands.push_back(parse_hand_replacement(text));
  if (edit.replacements.empty() && !edit.swap && edit.hands.empty()) {
    throw Error(ErrorCode::bad_input, "what is to be changed? give replace, swap or replace_hand");
  }
  if (!edit.replacements.empty() && edit.swap) {
    throw Error(ErrorCode::bad_input, "replace and swap exclude each other: make two edits");
  }
  if (!edit.hands.empty() && (!edit.replacements.empty() || edit.swap)) {
    throw Error(ErrorCode::bad_input, "replace_hand excludes replace and swap: make two edits");
  }
  SynthesisOptions options = options_of(call.how);
  options.most_frames = most_frames;
  return synthesize(database, call.recording, edit, options);
}

namespace {

std::optional<FrameRange> parse_frames(const std::string& text) {
  FrameRange frames;
  const char* const end = text.data() + text.size();
  const auto [dots, wrong_begin] = std::from_chars(text.data(), end, frames.begin);
  if (wrong_begin != std::errc{} || !std::string_view(dots, end).starts_with("..")) return std::nullopt;
  const auto [last, wrong_end] = std::from_chars(dots + 2, end, frames.end);
  if (wrong_end != std::errc{} || last != end || frames.begin < 0 || frames.begin >= frames.end) return std::nullopt;
  return frames;
}

/// Renders part of a score: only motion.
Synthesized run_part(const Database& database, const Score& score, FrameRange frames) {
  OpenScore open(database, score);
  Synthesized made;
  made.contents = open.contents();
  open.render(frames, made.result.motion);
  made.result.notices = open.notices();
  made.result.declarations = open.declarations();
  made.result.score = score;
  made.layout_from = score.skeleton.recording;
  return made;
}

}  // namespace

std::string check_frames(const std::string& text) {
  if (text.empty() || parse_frames(text)) return {};
  return fmt::format("'{}': expected FROM..TO in frames, such as 120..240", printable(text));
}

SynthesisChoices choices_of(const ScoreCall& call) {
  SynthesisChoices choices;
  choices.signing_space = call.signing_space;
  choices.character = call.character;
  choices.bvh = call.bvh;
  return choices;
}

Synthesized run(const Database& database, const Score& score, const ScoreCall& call,
                const std::vector<std::string>& formats) {
  const std::optional<FrameRange> frames = parse_frames(call.frames);
  if (!frames) return synthesize(database, score);
  for (const std::string_view whole : {"eaf", "svg", "json"}) {
    if (std::ranges::find(formats, whole) == formats.end()) continue;
    throw Error(ErrorCode::bad_input,
                fmt::format("{} describes a whole score: omit frames, or request a motion format such as bvh", whole));
  }
  return run_part(database, score, *frames);
}

std::string title_of(const Database& database, const SignCall& call) {
  return to_string(parse_utterance(call.utterance, words_of(database)));
}

std::string title_of(const EditCall& call) {
  return call.recording + ", edited";
}

SynthesisAnswer report_of(const Synthesized& made, const SynthesisChoices& choices) {
  SynthesisAnswer answer{.report = signweave::report_of(made.result),
                         .timings = made.timings,
                         .places = {},
                         .weights = {},
                         .captured_transitions = {}};
  if (choices.explain) {
    answer.places = places_of(made);
    answer.weights = made.selection.weights;
    answer.captured_transitions = made.captured_transitions;
  }
  return answer;
}

const RecordingInfo& signer_of(const Synthesized& made) {
  return made.contents->at(made.layout_from);
}

void show_on(Synthesized& made, const SignerStance& stance, const CharacterFile& character) {
  made.result.motion = on_character(made.result.motion, stance, character.character, made.result.notices);
}

FileContent content_of(const Synthesized& made, const SynthesisChoices& choices, const std::string& title,
                       const SharedCharacter& character) {
  FileContent content = signweave::content_of(made.result);
  content.layout_changes = layout_changes_of(choices.bvh);
  content.title = title;
  content.signing_space = choices.signing_space;
  if (character) {
    content.character = character->plain;
    return content;
  }
  if (const RecordingInfo* source = made.contents->find(made.layout_from)) {
    content.layout = source->motion_facts.layout;
    content.rig = source->rig;
  }
  if (content.layout) {  // the axes, unit and orders of the source's file, but not its oddities
    content.layout->root_columns = bvh::RootColumns::declared;
    content.layout->root_unit = content.layout->unit;
    content.layout->frame_time.clear();
  }
  return content;
}

}  // namespace signweave::calls
