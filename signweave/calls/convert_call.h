#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/export_call.h"
#include "signweave/calls/handedness_field.h"
#include "signweave/calls/import_call.h"
#include "signweave/calls/motion_reading.h"
#include "signweave/calls/motion_writing.h"

namespace signweave::calls {

/// Writes the files of one recording as files of other formats, without a database.
struct ConvertCall {
  MotionReading reading;
  FacePlacing face;
  std::string rig;
  std::string character;
  std::string handedness;
  bool signing_space = false;
  RateWriting rate;
  BvhWriting bvh;
};

template <class Visit>
void fields(Visit& visit, ConvertCall& call) {
  fields(visit, call.reading);
  fields(visit, call.face);
  visit(Field{.name = "rig",
              .help = "mapping file: lines 'part = joint' for what joint names do not show",
              .is_file = true,
              .type_name = "FILE"},
        call.rig);
  visit(handedness_field(), call.handedness);
  visit(Field{.name = "signing_space", .help = kSigningSpaceHelp}, call.signing_space);
  visit(Field{.name = "character", .help = kCharacterHelp}, call.character);
  fields(visit, call.rate);
  fields(visit, call.bvh);
}

/// Reads a motion with its face capture (named, or found next to it), or an annotation, depending on the extensions of
/// `outputs`. The declarations of an annotation with the same name (such as that its signs are placeholders) are
/// carried over. Throws Error{bad_input} if the inputs are not one recording, and what the readers throw.
Exported run(const std::vector<std::filesystem::path>& inputs, const ConvertCall& call,
             const std::vector<std::string>& outputs, const std::function<void(double)>& progress);

/// The stance of the signer of a motion, for show_on.
SignerStance stance_of(const Motion& motion, const RigNames& rig);

}  // namespace signweave::calls
