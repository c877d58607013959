#include <fmt/format.h>

#include "app/server/answers.h"
#include "app/server/frames_answer.h"
#include "app/server/routes.h"
#include "signweave/calls/export_call.h"
#include "signweave/calls/rig_answer.h"
#include "signweave/calls/synthesis_call.h"
#include "signweave/choose/known_words.h"
#include "signweave/core/text.h"
#include "signweave/formats/file_format.h"
#include "signweave/notation/score_json.h"

namespace signweave::server {

namespace {

/// All file formats that are written, and those that only HTTP has.
std::vector<std::string> synthesis_formats() {
  std::vector<std::string> names;
  for (const std::string_view extension : writable_extensions()) names.emplace_back(extension.substr(1));
  names.emplace_back("frames");
  names.emplace_back("score");
  return names;
}
/// A score does not return the score itself.
std::vector<std::string> score_formats() {
  std::vector<std::string> names = synthesis_formats();
  std::erase(names, "score");
  return names;
}
/// The annotation of a recording has its own route.
std::vector<std::string> motion_formats() {
  std::vector<std::string> names = score_formats();
  std::erase(names, "eaf");
  return names;
}
constexpr const char* kScoreHelp =
    "the file itself instead of the report: json with every pose, eaf with the annotation, svg as a contact sheet, "
    "frames with every pose in the bytes of a stream";
const std::string kSynthesisHelp = std::string(kScoreHelp) + ", score with the input of renderScore";

}  // namespace

template <>
struct Formats<calls::SignCall> {
  static std::vector<std::string> names() { return synthesis_formats(); }
  static std::string help() { return kSynthesisHelp; }
};
template <>
struct Formats<calls::EditCall> : Formats<calls::SignCall> {};
template <>
struct Formats<calls::ScoreCall> {
  static std::vector<std::string> names() { return score_formats(); }
  static std::string help() { return kScoreHelp; }
};
template <>
struct Formats<calls::ExportCall> {
  static std::vector<std::string> names() { return motion_formats(); }
  static std::string help() { return "of the file; bvh if not given"; }
};

namespace {

/// Exports the annotation of a recording, or a range of it.
struct AnnotationCall {
  calls::ExportCall call;
};

template <class Visit>
void fields(Visit& visit, AnnotationCall& call) {
  visit(calls::Field{.name = "recording", .help = "name of the recording", .required = true}, call.call.recording);
  visit(calls::Field{.name = "from", .help = "annotation time in ms to begin at"}, call.call.from);
  visit(calls::Field{.name = "to", .help = "annotation time in ms to end at"}, call.call.to);
  visit(calls::tiers_field(), call.call.tiers);
}

/// The requested format: from its field, else from the first type in the Accept header; empty for the report. Only the
/// first type counts, because browsers accept nearly everything after their preferred one.
std::string wanted_format(const Call& call, const std::string& format, const std::vector<std::string>& known) {
  if (!format.empty()) return format;
  const std::string_view accept = call.request.accept;
  const std::string_view first = trimmed(accept.substr(0, accept.find_first_of(",;")));
  for (const std::string& name : known) {
    const std::string_view type = answer_format(name).media_type;
    if (name != "json" && type.substr(0, type.find(';')) == first) return name;
  }
  return {};
}

void require_sheet(bool wanted, const std::string& format, std::string_view parameter = "signing_space") {
  if (!wanted || format == "svg") return;
  throw Error(ErrorCode::bad_input, fmt::format("{}: is drawn on contact sheets only; request format svg", parameter));
}

/// Null if none is requested.
calls::SharedCharacter wanted_character(const Call& call, const std::string& name) {
  return name.empty() ? nullptr : call.state.databases.characters.at(name);
}

nlohmann::ordered_json rig_json(const Motion& motion, const RigNames& names, const calls::CharacterFile* character) {
  return answer_json(
      calls::rig_answer(motion.skeleton(), character != nullptr ? character->character.rig : map_rig(motion, names)));
}

ApiResponse deliver(Call& call, Synthesized made, const calls::SynthesisChoices& how, const std::string& title,
                    const std::string& format) {
  const calls::SharedCharacter character = wanted_character(call, how.character);
  if (character) {
    const RecordingInfo& signer = calls::signer_of(made);
    show_on(made, *call.database().stance(made.contents, signer.name), *character);
  }
  call.declare(made.result.declarations);
  call.notices.insert(call.notices.end(), made.result.notices.begin(), made.result.notices.end());
  const auto report_json = [&] {
    return answer_json<nlohmann::json>(SynthesisReply{
        .answer = calls::report_of(made, how), .declarations = call.declarations, .notices = call.notices});
  };
  if (format.empty()) return json_answer(report_json());
  const AnswerFormat& file = answer_format(format);
  if (format == "score") return file_answer(file, "signing", json_of(made.result.score));
  if (format == "frames") {
    return file_answer(file, "signing",
                       frames_text(made.result.motion,
                                   {.database = call.database().name(),
                                    .recording = made.layout_from,
                                    .declarations = made.result.declarations,
                                    .character = how.character,
                                    .rig = rig_json(made.result.motion, calls::signer_of(made).rig, character.get()),
                                    .report = report_json()}));
  }
  return file_answer(
      file, "signing",
      file_text(file.extension, calls::content_of(made, how, title, character), std::string(file.extension)));
}

}  // namespace

wire::SchemaWriter sign_fields() {
  return wire::schema_of_call<WithFormat<calls::SignCall>>();
}
wire::SchemaWriter score_fields() {
  return wire::schema_of_call<WithFormat<calls::ScoreCall>>();
}
wire::SchemaWriter edit_fields() {
  return wire::schema_of_call<WithFormat<calls::EditCall>>();
}
wire::SchemaWriter motion_fields() {
  return wire::schema_of_call<WithFormat<calls::ExportCall>>();
}
wire::SchemaWriter annotation_fields() {
  return wire::schema_of_call<AnnotationCall>();
}

ApiResponse sign_utterance(Call& call) {
  const auto [sign, asked] = read_parameters<WithFormat<calls::SignCall>>(call);
  const std::string format = wanted_format(call, asked, synthesis_formats());
  require_sheet(sign.how.signing_space, format);
  const Database& database = call.database().database();
  const std::size_t signs = count_signs(parse_utterance(sign.utterance, words_of(database)));
  if (signs > call.state.limits.glosses) {
    throw too_large(fmt::format("the utterance has {} signs; the limit is {}", signs, call.state.limits.glosses));
  }
  calls::report_damage(database, call.listener());
  return deliver(call, calls::run(database, sign, call.state.limits.frames), sign.how, calls::title_of(database, sign),
                 format);
}

ApiResponse render_score(Call& call) {
  const auto [how, asked] = read_parameters<WithFormat<calls::ScoreCall>>(call);
  const std::string format = wanted_format(call, asked, score_formats());
  require_sheet(how.signing_space, format);
  if (format.empty() && !how.frames.empty()) {
    throw Error(ErrorCode::bad_input, "frames: the report covers the whole score; also request a format of motion");
  }
  if (call.request.body.empty()) {
    throw Error(ErrorCode::bad_input, "the body must be a score, as returned by sign and edit in the format score");
  }
  const Score score = score_from_json(call.request.body, "score");
  if (score.clips.size() > call.state.limits.glosses) {
    throw too_large(
        fmt::format("the score has {} clips; the limit is {}", score.clips.size(), call.state.limits.glosses));
  }
  if (score.frames > call.state.limits.frames) {
    throw too_large(fmt::format("the score has {} frames; the limit is {}", score.frames, call.state.limits.frames));
  }
  const Database& database = call.database().database();
  calls::report_damage(database, call.listener());
  return deliver(call, calls::run(database, score, how, {format}), calls::choices_of(how), "score", format);
}

ApiResponse edit_recording(Call& call) {
  const auto [edit, asked] = read_parameters<WithFormat<calls::EditCall>>(call);
  const std::string format = wanted_format(call, asked, synthesis_formats());
  require_sheet(edit.how.signing_space, format);
  if (edit.replace.size() > call.state.limits.glosses) {
    throw too_large(
        fmt::format("there are {} replacements; the limit is {}", edit.replace.size(), call.state.limits.glosses));
  }
  const Database& database = call.database().database();
  calls::report_damage(database, call.listener());
  return deliver(call, calls::run(database, edit, call.state.limits.frames), edit.how, calls::title_of(edit), format);
}

ApiResponse export_motion(Call& call) {
  const auto [parameters, asked] = read_parameters<WithFormat<calls::ExportCall>>(call);
  std::string format = wanted_format(call, asked, motion_formats());
  if (format.empty()) format = "bvh";
  require_sheet(parameters.signing_space, format);
  require_sheet(!parameters.loci.empty(), format, "locus");
  require_sheet(parameters.from_above, format, "from_above");
  const AnswerFormat& file = answer_format(format);
  const calls::SharedCharacter character = wanted_character(call, parameters.character);
  const Database& database = call.database().database();
  calls::Exported made = calls::run(database, parameters, {parameters.recording + std::string(file.extension)});
  if (character) show_on(made, *call.database().stance(database.contents(), made.info.name), character);
  call.declare(made.info.declarations);
  call.notices.insert(call.notices.end(), made.notices.begin(), made.notices.end());
  if (format == "frames") {
    const double origin = 1e3 * made.info.clock.time_of(static_cast<double>(made.frames.begin)).count();
    nlohmann::json report;  // none for a captured recording
    if (!made.regenerated.empty()) {
      const auto spans = answer_json<nlohmann::json>(calls::regenerated_of(made));
      report = {{"regenerated", spans}, {"remade", spans}};  // the latter is the former name
    }
    return file_answer(file, made.info.name,
                       frames_text(*made.motion, {.database = call.database().name(),
                                                  .recording = made.info.name,
                                                  .declarations = made.info.declarations,
                                                  .character = parameters.character,
                                                  .origin_ms = origin,
                                                  .rig = rig_json(*made.motion, made.info.rig, character.get()),
                                                  .report = std::move(report)}));
  }
  return file_answer(file, made.info.name, file_text(file.extension, made.content(), made.info.name));
}

ApiResponse export_annotation(Call& call) {
  const auto parameters = read_parameters<AnnotationCall>(call);
  const calls::Exported made =
      calls::run(call.database().database(), parameters.call, {parameters.call.recording + ".eaf"});
  call.declare(made.info.declarations);
  return file_answer(answer_format("eaf"), made.info.name, file_text(".eaf", made.content(), made.info.name));
}

}  // namespace signweave::server
