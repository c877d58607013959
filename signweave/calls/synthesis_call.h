#pragma once

#include <string>
#include <vector>

#include "signweave/calls/characters.h"
#include "signweave/calls/field.h"
#include "signweave/calls/handedness_field.h"
#include "signweave/calls/motion_writing.h"
#include "signweave/calls/selection_report.h"
#include "signweave/calls/signing_space.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/answer.h"
#include "signweave/formats/write_file.h"
#include "signweave/score/report.h"

namespace signweave {

template <class Visit>
void fields(Visit& visit, const Timings& timings) {
  const auto ms = [](Seconds seconds) { return seconds.count() * 1000.0; };
  visit.type("Timings");
  visit(AnswerField{.name = "semantic_query_ms"}, ms(timings.semantic_query));
  visit(AnswerField{.name = "selection_ms"}, ms(timings.selection));
  visit(AnswerField{.name = "retrieval_ms"}, ms(timings.retrieval));
  visit(AnswerField{.name = "concatenation_ms"}, ms(timings.concatenation));
  visit(AnswerField{.name = "total_ms"}, ms(timings.total));
}

}  // namespace signweave

namespace signweave::calls {

/// How signing is generated: the parameters that `sign` and `edit` share.
struct SynthesisChoices {
  std::string transition = std::string(transition_methods().front().name);
  std::string duration = "fitted";
  double tempo = 1;
  std::vector<std::string> junctions;
  std::string rate;
  std::string handedness;
  std::string align = "auto";
  bool signing_space = false;
  std::string character;
  BvhWriting bvh;
  bool strict = false;
  bool explain = false;
};

/// The names of the transition methods, and all of them as a help text.
std::vector<std::string> transition_names();
std::string transition_help();
/// Each returns what is wrong with the value; empty if it is valid.
std::string check_duration(const std::string& text);
std::string check_junction(const std::string& text);

/// The fields that determine the signing, except its frame rate.
template <class Visit>
void signing_fields(Visit& visit, SynthesisChoices& choices) {
  visit(Field{.name = "transition", .help = transition_help(), .shows_default = true, .one_of = transition_names()},
        choices.transition);
  visit(Field{.name = "duration",
              .help = "of each transition: fitted (predicted from what the hands have to do, if that beats the mean), "
                      "corpus (its mean), or milliseconds",
              .shows_default = true,
              .or_number = true,
              .check = check_duration},
        choices.duration);
  visit(
      Field{.name = "tempo", .help = "0.25 to 4; above 1 is faster", .shows_default = true, .range = Range{0.25, 4.0}},
      choices.tempo);
  visit(Field{.name = "align",
              .help = "bring signers to one place: auto (other recordings than the first or the edited one), ground "
                      "(all), none",
              .shows_default = true,
              .one_of = {"auto", "ground", "none"}},
        choices.align);
  visit(handedness_field(), choices.handedness);
  visit(Field{.name = "character", .help = kCharacterHelp}, choices.character);
  visit(
      Field{.name = "junctions",
            .help = "N=PART[,PART...]: how junction N is made, counted from 1 between the first two signs: a method, a "
                    "duration (450ms), a tempo of this transition alone (x1.5); made even between recorded "
                    "neighbours; may be given several times",
            .words = "junction",
            .check = check_junction},
      choices.junctions);
}

template <class Visit>
void fields(Visit& visit, SynthesisChoices& choices) {
  signing_fields(visit, choices);
  visit(Field{.name = "rate",
              .help = "frames a second of the result; the highest of its sources if not given",
              .or_number = true,
              .check = check_rate},
        choices.rate);
  visit(Field{.name = "strict",
              .help = "refuse what signers rarely do with two hands instead of reporting it (symmetry, dominance, "
                      "long_hold, collision, weak_drop)"},
        choices.strict);
  visit(Field{.name = "signing_space", .help = kSigningSpaceHelp}, choices.signing_space);
  fields(visit, choices.bvh);
  visit(Field{.name = "explain", .help = "show candidates, costs and junctions"}, choices.explain);
}

/// Generates new signing from glosses.
struct SignCall {
  std::string utterance;
  std::string missing = "explain";
  std::string mouthing = "letters";
  std::string language = "fr";
  std::string non_manuals = "asked";
  bool blinks = false;
  SynthesisChoices how;
  std::vector<std::string> role;
  Expressions expressions = built_in_expressions();  ///< not a parameter: the command line reads them from a file
  SpaceRoles roles;                                  ///< likewise; those of `role` are added
};

template <class Visit>
void fields(Visit& visit, SignCall& call) {
  visit(
      Field{.name = "utterance",
            .help =
                "glosses separated by blanks; \"LE MANS\" quoted, MATIN#3 one token, \"NAME\"@1200..3400 a piece "
                "of a recording, , and . pauses, [A | weak: B] two hands, A{mouth \"a\"} and {brows up: A B} the face",
            .words = "UTTERANCE",
            .required = true},
      call.utterance);
  visit(
      Field{.name = "missing",
            .help = "of glosses that are not there: explain and sign nothing, or fold (take the one gloss that differs "
                    "in case, accents or width only, and say so)",
            .shows_default = true,
            .one_of = {"explain", "fold"}},
      call.missing);
  visit(
      Field{.name = "mouthing",
            .help = "how the texts to be mouthed are pronounced: letters (rules of signweave's own, the same on every "
                    "machine), espeak (the program espeak-ng where it is installed), none (not mouthed)",
            .shows_default = true,
            .one_of = {"letters", "espeak", "none"}},
      call.mouthing);
  visit(Field{.name = "language",
              .help = "the language of those texts",
              .shows_default = true,
              .one_of = {"fr", "en", "de", "nl"}},
        call.language);
  visit(Field{.name = "role",
              .help = "GLOSS=ROLE: how a gloss refers to loci: forward (from its subject to its object), "
                      "backward, aim (it points), both (each hand has one) or none; otherwise it is guessed",
              .several_words = true},
        call.role);
  visit(Field{.name = "non_manuals",
              .help = "which movements of face, gaze and head are shown over the captured ones: asked (those of the "
                      "utterance), plan (also blinks, and looks at the addressee at pauses and at both ends)",
              .shows_default = true,
              .one_of = {"asked", "plan"}},
        call.non_manuals);
  visit(Field{.name = "blinks", .help = "blink at pauses and where expressions and gazes end, as signers mostly do"},
        call.blinks);
  fields(visit, call.how);
}

/// Replaces or swaps signs of a recording.
struct EditCall {
  std::string recording;
  std::vector<std::string> replace;
  std::string swap;
  std::vector<std::string> replace_hand;
  SynthesisChoices how;
};

template <class Visit>
void fields(Visit& visit, EditCall& call) {
  visit(Field{.name = "recording", .help = "the recording to start from", .words = "RECORDING", .required = true},
        call.recording);
  visit(Field{.name = "replace",
              .help = "GLOSS[#N]=GLOSS[#M]: the N-th of this recording by the M-th of the database (or the best); may "
                      "be given several times",
              .several_words = true},
        call.replace);
  visit(Field{.name = "swap", .help = "FROM..TO,FROM..TO: two runs of signs change places"}, call.swap);
  visit(
      Field{.name = "replace_hand",
            .help = "left:GLOSS[#N]=GLOSS[#M] or right:...: what that hand alone signs, by its share of another sign; "
                    "may be given several times",
            .several_words = true},
      call.replace_hand);
  fields(visit, call.how);
}

/// Renders a score, or some of its frames. Nothing is selected, so of SynthesisChoices it has only those for display
/// and writing.
struct ScoreCall {
  std::string frames;
  bool signing_space = false;
  std::string character;
  BvhWriting bvh;
};

/// Returns why `text` is not "FROM..TO" in frames; empty if it is.
std::string check_frames(const std::string& text);

inline Field frames_field() {
  return {.name = "frames",
          .help = "FROM..TO: these frames of the score alone, counted from 0, TO not among them",
          .check = check_frames};
}

template <class Visit>
void fields(Visit& visit, ScoreCall& call) {
  visit(frames_field(), call.frames);
  visit(Field{.name = "signing_space", .help = kSigningSpaceHelp}, call.signing_space);
  visit(Field{.name = "character", .help = kCharacterHelp}, call.character);
  fields(visit, call.bvh);
}

/// The choices for displaying and writing the result.
SynthesisChoices choices_of(const ScoreCall& call);
/// If only some frames are requested, the result has only motion: no signs, clips, junctions or sources. Throws what
/// `synthesize` of a score throws, and Error{bad_input} if the frames are not in the score, or if only some are
/// requested and one of `formats` ("eaf", "bvh", …) holds more than motion.
Synthesized run(const Database& database, const Score& score, const ScoreCall& call,
                const std::vector<std::string>& formats);

/// Requires checked fields. Throws Error{bad_input} if a junction is named twice.
SynthesisOptions options_of(const SynthesisChoices& choices);

/// A result that would have more than `most_frames` is refused. Both throw what `synthesize` and the parsers of
/// utterances and edits throw, and Error{bad_input} for an edit without a change.
Synthesized run(const Database& database, const SignCall& call, std::int64_t most_frames = kMostFrames);
Synthesized run(const Database& database, const EditCall& call, std::int64_t most_frames = kMostFrames);
/// Throws Error{bad_input} for an utterance that cannot be read.
std::string title_of(const Database& database, const SignCall& call);
std::string title_of(const EditCall& call);

/// The report of a synthesis: signs, clips and junctions, how long each step took and, if requested, the candidates.
struct SynthesisAnswer {
  SynthesisReport report;
  Timings timings;
  std::optional<std::vector<PlaceAnswer>> places;  ///< this and those below: of `explain`
  std::optional<JoinWeights> weights;
  std::optional<std::size_t> captured_transitions;
};
template <class Visit>
void answer_fields(Visit& visit, const SynthesisAnswer& answer) {
  report_fields(visit, answer.report);
  visit(AnswerField{.name = "timings"}, answer.timings);
  visit(AnswerField{.name = "places", .help = "of `explain`: what there was to choose from"}, answer.places);
  visit(AnswerField{.name = "weights", .help = "of `explain`"}, answer.weights);
  visit(AnswerField{.name = "captured_transitions", .help = "of `explain`"}, answer.captured_transitions);
}
template <class Visit>
void fields(Visit& visit, const SynthesisAnswer& answer) {
  visit.type("SynthesisResult");
  answer_fields(visit, answer);
}

SynthesisAnswer report_of(const Synthesized& made, const SynthesisChoices& choices);

/// The recording that the result takes its signer from, for stance_of.
const RecordingInfo& signer_of(const Synthesized& made);
/// Retargets the result to a character.
void show_on(Synthesized& made, const SignerStance& stance, const CharacterFile& character);

/// The content to write: the result, the layout of its source's file without that file's oddities, and the title of a
/// contact sheet. `character`: its joints are the result's; null: the source's.
FileContent content_of(const Synthesized& made, const SynthesisChoices& choices, const std::string& title,
                       const SharedCharacter& character);

}  // namespace signweave::calls
