#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/characters.h"
#include "signweave/calls/field.h"
#include "signweave/calls/motion_writing.h"
#include "signweave/calls/regenerate.h"
#include "signweave/calls/signing_space.h"
#include "signweave/calls/synthesis_call.h"
#include "signweave/database/database.h"
#include "signweave/formats/write_file.h"

namespace signweave::calls {

/// Exports a recording, or a part of it.
struct ExportCall {
  std::string recording;
  std::optional<std::int64_t> from;
  std::optional<std::int64_t> to;
  std::vector<std::string> tiers;
  std::vector<std::string> regenerate;
  std::string transition;
  std::string joints;
  bool signing_space = false;
  std::vector<std::string> loci;
  bool from_above = false;
  std::string character;
  BvhWriting bvh;
  RateWriting rate;
};

inline Field tiers_field() {
  return {.name = "tiers",
          .help = "only these tiers of the annotation, and their parents",
          .several_words = true,
          .type_name = "TIER"};
}

template <class Visit>
void fields(Visit& visit, ExportCall& call) {
  visit(Field{.name = "recording", .help = "name of the recording", .words = "RECORDING", .required = true},
        call.recording);
  visit(Field{.name = "from", .help = "annotation time in ms to begin at"}, call.from);
  visit(Field{.name = "to", .help = "annotation time in ms to end at"}, call.to);
  visit(tiers_field(), call.tiers);
  visit(Field{.name = "regenerate",
              .help = "FROM..TO in ms of annotation time: captured frames to cut out and generate again, as 'evaluate' "
                      "does; may be given several times",
              .former = "remake",
              .check = check_span},
        call.regenerate);
  visit(Field{.name = "transition",
              .help = fmt::format("for regenerate, {} if not given; {}", transition_methods().front().name,
                                  transition_help()),
              .one_of = transition_names()},
        call.transition);
  visit(Field{.name = "joints", .help = "joint names, separated by commas; the others are left at rest"}, call.joints);
  visit(Field{.name = "signing_space", .help = kSigningSpaceHelp}, call.signing_space);
  visit(Field{.name = "locus", .help = kLocusHelp, .check = check_marked_locus, .type_name = "LOCUS"}, call.loci);
  visit(Field{.name = "from_above", .help = kFromAboveHelp}, call.from_above);
  visit(Field{.name = "character", .help = kCharacterHelp}, call.character);
  fields(visit, call.rate);
  fields(visit, call.bvh);
}

/// The content of an export.
struct Exported {
  RecordingInfo info;
  FrameRange frames;  ///< of the recording's motion
  std::optional<Motion> motion;
  std::optional<AnnotationDocument> document;
  bool signing_space = false;
  std::vector<MarkedLocus> loci;  ///< to mark on a contact sheet
  bool from_above = false;
  bvh::LayoutChanges layout_changes;
  SharedCharacter character;                         ///< its joints are the motion's; null: the recording's
  std::vector<FrameRange> regenerated;               ///< the recording's frames that were cut out and generated again
  const TransitionMethod* regenerated_by = nullptr;  ///< null if none were
  std::vector<Notice> notices;

  /// The content to write; borrows from this object.
  FileContent content() const;
};

/// Reads what the files named in `outputs` need, which depends on their extensions. The annotation is cut where the
/// frames are, so that both begin together. Throws Error{not_found} for an unknown recording, joint or tier (with near
/// matches), Error{bad_input}.
Exported run(const Database& database, const ExportCall& call, const std::vector<std::string>& outputs);

/// Retargets what is to be written to a character.
void show_on(Exported& made, const SignerStance& stance, SharedCharacter character);

/// A span that was generated again.
struct RegeneratedAnswer {
  TimeSpan span;
  FrameRange recorded_frames;
  std::string_view method;
};
template <class Visit>
void fields(Visit& visit, const RegeneratedAnswer& one) {
  visit.type("RegeneratedSpan");
  span_fields(visit, one.span);
  visit(AnswerField{.name = "recorded_frames"}, one.recorded_frames);
  visit(AnswerField{.name = "method"}, one.method);
}
std::vector<RegeneratedAnswer> regenerated_of(const Exported& exported);

/// The recording, the number of frames, and the spans that were generated again.
template <class Visit>
void fields(Visit& visit, const Exported& exported) {
  visit.type("Exported");
  visit(AnswerField{.name = "recording"}, exported.info.name);
  visit(AnswerField{.name = "frames"}, exported.motion ? exported.motion->frame_count() : exported.frames.size());
  visit(AnswerField{.name = "regenerated"}, given_if(!exported.regenerated.empty(), regenerated_of(exported)));
  visit(AnswerField{.name = "remade", .help = "the former name of regenerated"},
        given_if(!exported.regenerated.empty(), regenerated_of(exported)));
}

}  // namespace signweave::calls
