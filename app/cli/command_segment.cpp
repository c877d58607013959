#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/motion_options.h"
#include "app/cli/progress.h"
#include "app/cli/table.h"
#include "signweave/core/text.h"
#include "signweave/features/phase_proposals.h"
#include "signweave/formats/eaf.h"

namespace signweave::cli {
namespace {

struct Options {
  std::string motion;
  std::string output;
  std::string rig;
  bool overwrite = false;
  MotionOptions reading;
};

std::string_view name_of_hand(Side side) {
  return side == Side::left ? "left" : "right";
}

void print_json(const std::string& path, const ProposedPhases& proposed, Io& io) {
  nlohmann::ordered_json hands = nlohmann::ordered_json::object();
  for (const Side side : kSides) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ProposedPhase& one : proposed.hands[static_cast<std::size_t>(side)]) {
      list.push_back({{"phase", name_of(one.phase)},
                      {"begin_ms", std::llround(1000 * one.begin.count())},
                      {"end_ms", std::llround(1000 * one.end.count())},
                      {"confidence", std::round(1000.0 * one.confidence) / 1000.0}});
    }
    hands[std::string(name_of_hand(side))] = std::move(list);
  }
  io.out << nlohmann::ordered_json{{"file", path}, {"proposed", kProposalWarning}, {"hands", std::move(hands)}}.dump(
                2, ' ', false, nlohmann::json::error_handler_t::replace)
         << '\n';
}

void print_table(const ProposedPhases& proposed, Io& io) {
  std::vector<std::vector<std::string>> rows = {{"hand", "phase", "stretches", "seconds", "confidence"}};
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

/// A person's annotation must not be lost to proposals.
void require_new(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return;
  throw Error(ErrorCode::already_exists,
              path + ": is there already, and may hold a person's annotation; give another name, or --overwrite");
}

void run_segment(const Options& options, Io& io) {
  if (!options.output.empty() && !options.overwrite) require_new(options.output);
  bvh::ReadOptions reading = read_options(options.reading);
  Progress progress(io, "reading");
  reading.progress = [&](double fraction) { progress.show(fraction); };
  const bvh::File file = bvh::read(options.motion, reading);
  print_notices(io, file.notices);
  if (file.motion.frame_count() == 0) {
    throw Error(ErrorCode::bad_input, options.motion + ": no frames, so there is nothing to tell phases from");
  }
  const RigMap rig = map_rig(file.motion, options.rig.empty() ? RigNames{} : read_rig_names(options.rig));
  ProposedPhases proposed;
  try {
    proposed = propose_phases(upper_body_of(file.motion, rig));
  } catch (const Error& error) {  // the library knows parts of the body, the user a file
    throw Error(error.code(), fmt::format("{}: {}", options.motion, error.what()));
  }
  // The segmenter's frames are longer than most motions' own, so the last one may reach past the end.
  for (std::vector<ProposedPhase>& hand : proposed.hands) {
    for (ProposedPhase& one : hand) one.end = std::min(one.end, file.motion.duration());
  }
  for (Notice& notice : proposed.notices) notice.where = options.motion;
  print_notices(io, proposed.notices);
  if (!options.output.empty()) {
    const std::string name = std::filesystem::path(options.motion).filename().string();
    eaf::write(options.output, proposals_document(proposed, file.motion.duration(), name));
  }
  if (io.json) {
    print_json(options.motion, proposed, io);
  } else {
    print_table(proposed, io);
  }
  io.err << "signweave: " << kProposalWarning << '\n';
}

}  // namespace

Run segment(CLI::App& verb) {
  auto options = std::make_shared<Options>();
  verb.add_option("MOTION", options->motion, "a motion file (.bvh)")->required();
  verb.add_option("-o,--output", options->output, "annotation file to write (.eaf); without it phases are only counted")
      ->check([](const std::string& path) {
        return fold_case(path).ends_with(".eaf") ? std::string() : "'" + printable(path) + "' does not end in .eaf";
      });
  verb.add_flag("--overwrite", options->overwrite, "take the place of an annotation file that is there already");
  verb.add_option("--rig", options->rig, "mapping file: a line 'part = joint' for each part that is not told right")
      ->type_name("FILE");
  add_motion_options(verb, options->reading);
  return [options](Io& io) { run_segment(*options, io); };
}

}  // namespace signweave::cli
