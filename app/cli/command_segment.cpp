#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/wire/text.h"
#include "signweave/calls/motion_reading.h"
#include "signweave/calls/segment_call.h"
#include "signweave/calls/table.h"
#include "signweave/database/database.h"
#include "signweave/features/phase_proposals.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/formats/file_format.h"
#include "signweave/formats/write_file.h"

namespace signweave::cli {
namespace {

struct SegmentArguments {
  std::string motion;
  std::string recording;
  std::string output;
  std::string rig;
  bool overwrite = false;
  calls::MotionReading reading;
};

std::string_view name_of_hand(Side side) {
  return side == Side::left ? "left" : "right";
}

void print_table(const ProposedPhases& proposed, Io& io) {
  std::vector<std::vector<std::string>> rows = {{"hand", "phase", "spans", "seconds", "confidence"}};
  for (const Side side : {Side::right, Side::left}) {
    for (std::size_t phase = 0; phase < kMotionPhases; ++phase) {
      std::size_t count = 0;
      double seconds = 0;
      double sure = 0;
      for (const ProposedPhase& one : proposed.hands[static_cast<std::size_t>(side)]) {
        if (static_cast<std::size_t>(one.phase) != phase) continue;
        const double length = (one.end - one.begin).count();
        ++count;
        seconds += length;
        sure += length * static_cast<double>(one.confidence);
      }
      if (count == 0) continue;
      rows.push_back({std::string(name_of_hand(side)), std::string(name_of(static_cast<MotionPhase>(phase))),
                      std::to_string(count), fmt::format("{:.2f}", seconds), fmt::format("{:.2f}", sure / seconds)});
    }
  }
  io.out << format_table(rows);
}

/// A person's annotation must not be overwritten by proposals.
void require_new(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return;
  throw Error(ErrorCode::already_exists,
              path + ": exists already, and may hold a person's annotation; give another name, or --overwrite");
}

/// The proposed phases, and the name of the motion file they belong to.
struct Proposals {
  calls::Segmented made;
  std::string motion;
};

Proposals of_recording(const SegmentArguments& options, Io& io) {
  if (!options.rig.empty()) {
    throw Error(ErrorCode::bad_input, "--rig is for a motion file; a recording uses the mapping it was imported with");
  }
  const Database database(options.motion, kv::Access::read_only);
  report_damage(database, io);
  return {calls::run(database, calls::SegmentCall{options.recording}),
          database.contents()->at(options.recording).motion_facts.file};
}

Proposals of_file(const SegmentArguments& options, Io& io) {
  motion_file::ReadOptions reading = read_options(options.reading);
  Progress progress(io, "reading");
  reading.progress = [&](double fraction) { progress.show(fraction); };
  const motion_file::File file = motion_file::read(options.motion, reading);
  print_notices(io, file.notices);
  const RigMap rig = file.motion.frame_count() == 0
                         ? RigMap{}
                         : map_rig(file.motion, options.rig.empty() ? RigNames{} : read_rig_names(options.rig));
  return {calls::propose(file.motion, rig, options.motion), std::filesystem::path(options.motion).filename().string()};
}

void run_segment(const SegmentArguments& options, Io& io) {
  if (!options.output.empty() && !options.overwrite) require_new(options.output);
  const bool stored = !options.recording.empty();
  const auto [made, motion] = stored ? of_recording(options, io) : of_file(options, io);
  print_notices(io, made.proposed.notices);
  if (!options.output.empty()) {
    eaf::write(options.output, proposals_document(made.proposed, made.length, motion));
  }
  if (io.json) {
    calls::ProposalsAnswer answer = answer_of(made);
    (stored ? answer.recording : answer.file) = stored ? options.recording : options.motion;
    io.out << text_of(answer_json(answer));
  } else {
    print_table(made.proposed, io);
  }
  io.err << "signweave: " << kProposalWarning << '\n';
}

}  // namespace

Run segment(CLI::App& verb) {
  auto options = std::make_shared<SegmentArguments>();
  verb.add_option("MOTION", options->motion,
                  "a motion file " + readable_extensions(FileKind::motion) + ", or a database and")
      ->required();
  verb.add_option("RECORDING", options->recording, "the name of a recording in it");
  verb.add_option("-o,--output", options->output, "annotation file to write (.eaf); without it phases are only counted")
      ->check([](const std::string& path) { return check_extension(path, {".eaf"}); });
  verb.add_flag("--overwrite", options->overwrite, "replace an existing annotation file");
  verb.add_option("--rig", options->rig,
                  "mapping file: a line 'part = joint' for each part that is not recognized correctly")
      ->type_name("FILE");
  bind(verb, options->reading);
  return [options](Io& io) { run_segment(*options, io); };
}

}  // namespace signweave::cli
