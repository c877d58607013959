#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/export_call.h"
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
  bool signing_space = false;
  RateWriting rate;
  BvhWriting bvh;
};

template <class Visit>
void fields(Visit& visit, ConvertCall& call) {
  fields(visit, call.reading);
  fields(visit, call.face);
  visit(Field{.name = "rig",
              .help = "mapping file: lines 'part = joint' for what the joints' names do not tell",
              .is_file = true,
              .type_name = "FILE"},
        call.rig);
  visit(Field{.name = "signing_space", .help = kSigningSpaceHelp}, call.signing_space);
  visit(Field{.name = "character", .help = kCharacterHelp}, call.character);
  fields(visit, call.rate);
  fields(visit, call.bvh);
}

/// Reads a motion with the face that lies beside it or is named, or an annotation, as `outputs` ask by their endings.
/// What an annotation of the same name declares of the recording (such as that its signs are placeholders) goes along.
/// Throws Error{bad_input} where the inputs are not one recording, and as the readers do.
Exported run(const std::vector<std::filesystem::path>& inputs, const ConvertCall& call,
             const std::vector<std::string>& outputs, const std::function<void(double)>& progress);

/// How the signer of a motion stands, for show_on.
SignerStance stance_of(const Motion& motion, const RigNames& rig);

}  // namespace signweave::calls
