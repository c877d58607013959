#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/learning.h"
#include "app/cli/motion_options.h"
#include "app/cli/progress.h"
#include "app/cli/table.h"
#include "signweave/core/text.h"
#include "signweave/database/import.h"

namespace signweave::cli {
namespace {

/// "TIER", "TIER:right", "TIER:left:SIGNER". A tier whose name holds a colon is written with all three parts.
TierNames::SignTier parse_sign_tier(const std::string& text) {
  TierNames::SignTier tier;
  const auto hand_of = [](const std::string& word) -> std::optional<Hand> {
    for (const Hand hand : {Hand::both, Hand::right, Hand::left}) {
      if (name_of(hand) == word) return hand;
    }
    return std::nullopt;
  };
  const std::size_t last = text.rfind(':');
  if (last == std::string::npos) return {text, Hand::both, {}};
  if (const auto hand = hand_of(text.substr(last + 1))) return {text.substr(0, last), *hand, {}};
  const std::size_t middle = text.rfind(':', last == 0 ? 0 : last - 1);
  if (middle != std::string::npos && middle < last) {
    if (const auto hand = hand_of(text.substr(middle + 1, last - middle - 1))) {
      return {text.substr(0, middle), *hand, text.substr(last + 1)};
    }
  }
  return {text, Hand::both, {}};  // the colon belongs to the name
}

/// "120@4010.5": frame 120 is at 4010.5 ms.
std::optional<SyncPoint> parse_sync(const std::string& text) {
  const std::size_t at = text.find('@');
  double frame = 0;
  double ms = 0;
  const char* end = text.data() + text.size();
  if (at == std::string::npos || std::from_chars(text.data(), text.data() + at, frame).ptr != text.data() + at ||
      std::from_chars(text.data() + at + 1, end, ms).ptr != end || at == 0 || at + 1 == text.size() ||
      !std::isfinite(frame) || !std::isfinite(ms)) {
    return std::nullopt;
  }
  return SyncPoint{frame, Seconds(ms / 1000.0)};
}

std::string_view name_of(ImportOutcome outcome) {
  switch (outcome) {
    case ImportOutcome::added:
      return "added";
    case ImportOutcome::unchanged:
      return "unchanged";
    case ImportOutcome::clock_changed:
      return "clock, signer or rig changed";
    case ImportOutcome::measured:
      return "measured anew";
    case ImportOutcome::annotation_added:
      return "annotation added";
    case ImportOutcome::motion_added:
      return "motion added";
    case ImportOutcome::face_added:
      return "face added";
    case ImportOutcome::annotation_replaced:
      return "annotation replaced";
    case ImportOutcome::motion_replaced:
      return "motion replaced";
  }
  return "";
}

struct Options {
  std::string folder;
  std::vector<std::string> inputs;
  std::string pairs;
  std::vector<std::string> sign_tiers;
  std::vector<std::string> phase_tiers;
  std::string phase_labels;
  std::optional<double> offset_ms;
  std::vector<std::string> syncs;
  std::string rig;
  bool replace_motion = false;
  MotionOptions motion;
};

void run_import(const Options& given, Io& io) {
  ImportOptions options;
  options.motion = read_options(given.motion);
  for (const std::string& tier : given.sign_tiers) options.sign_tiers.push_back(parse_sign_tier(tier));
  options.phase_tiers = given.phase_tiers;
  if (!given.phase_labels.empty()) options.phase_labels = read_phase_labels(given.phase_labels);
  if (given.offset_ms) options.offset = Seconds(*given.offset_ms / 1000.0);
  for (const std::string& sync : given.syncs) options.sync.push_back(*parse_sync(sync));
  if (!given.rig.empty()) options.rig = read_rig_names(given.rig);
  options.replace_motion = given.replace_motion;

  Database database(given.folder, kv::Access::read_write);
  const std::vector<std::filesystem::path> inputs(given.inputs.begin(), given.inputs.end());
  const Pairing pairing =
      pair_files(inputs, given.pairs.empty() ? std::nullopt : std::optional<std::filesystem::path>(given.pairs));
  print_notices(io, pairing.notices);
  if (pairing.jobs.empty()) io.err << "signweave: no motion or annotation file there\n";

  nlohmann::json recordings = nlohmann::json::array();
  // One bar for all; it must be gone before a line is printed.
  auto progress = std::make_unique<Progress>(io, "importing");
  std::size_t done = 0;
  for (const ImportJob& job : pairing.jobs) {
    try {
      const auto jobs = static_cast<double>(pairing.jobs.size());
      const auto show = [&](double fraction) { progress->show((static_cast<double>(done) + fraction) / jobs); };
      show(0);
      const ImportReport report = import_recording(database, job, options, show);
      progress->hide();
      print_notices(io, report.notices);
      if (!report.not_measured.empty()) {
        print_notices(io, {{report.name, "its phases are not measured: " + report.not_measured}});
      }
      if (io.json) {
        nlohmann::json notices = nlohmann::json::array();
        for (const Notice& notice : report.notices) notices.push_back({{"where", notice.where}, {"text", notice.text}});
        recordings.push_back({{"name", report.name},
                              {"outcome", name_of(report.outcome)},
                              {"frames", report.frames},
                              {"tracks", report.tracks},
                              {"signs", report.signs},
                              {"defects", report.defects},
                              {"not_measured", report.not_measured},
                              {"notices", std::move(notices)}});
      } else {
        std::string line = fmt::format("{}: {}", report.name, name_of(report.outcome));
        if (report.outcome != ImportOutcome::unchanged) {
          line += ", " + counted(static_cast<std::size_t>(report.frames), "frame");
          if (report.tracks > 0) line += ", " + counted(report.tracks, "scalar track");
          line += ", " + counted(report.signs, "sign");
          if (report.defects > 0) line += ", " + counted(report.defects, "defect");
        }
        io.out << line << '\n';
      }
      ++done;
    } catch (const Error& error) {  // a bad recording changes nothing of its own; the others are imported
      progress->hide();
      // What a file is to blame for begins with the file; what the disk is, does not tell whose turn it was.
      io.err << "signweave: " << (error.code() == ErrorCode::io ? job.name + ": " : "") << one_line(error.what())
             << '\n';
      if (io.json) recordings.push_back({{"name", job.name}, {"outcome", "failed"}, {"error", error.what()}});
      io.status = 1;
      ++done;
    }
  }
  progress.reset();
  learn(database, io);
  if (io.json)
    io.out << nlohmann::json{{"recordings", std::move(recordings)}}.dump(2, ' ', false,
                                                                         nlohmann::json::error_handler_t::replace)
           << '\n';
}

}  // namespace

Run import(CLI::App& verb) {
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->folder, "the database")->required();
  verb.add_option("FILE", options->inputs,
                  "motion files (.bvh), annotation files (.eaf), face captures (.face.csv), folders of them");
  verb.add_option("--pairs", options->pairs, "CSV: motion, annotation, signer, offset in ms");
  verb.add_option("--sign-tier", options->sign_tiers,
                  "tier of glosses, TIER[:right|left|both[:SIGNER]]; guessed where not given")
      ->allow_extra_args(false);
  verb.add_option("--phase-tier", options->phase_tiers, "tier of phases; guessed where not given")
      ->allow_extra_args(false);
  verb.add_option("--phase-labels", options->phase_labels, "lines LABEL = preparation|stroke|retraction|hold");
  add_motion_options(verb, options->motion);
  verb.add_option("--offset-ms", options->offset_ms, "annotation time of frame 0");
  verb.add_option("--sync", options->syncs, "FRAME@MS, given twice: sets offset and drift")
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        return parse_sync(text) ? std::string() : "expected FRAME@MS, such as 120@4010";
      });
  verb.add_option("--rig", options->rig,
                  "mapping file: lines 'part = joint' for what the joints' names do not tell; remembered, an empty "
                  "file forgets")
      ->type_name("FILE");
  verb.add_flag("--replace-motion", options->replace_motion,
                "take motion and face files again, changed or not: instead of what was imported, or over damage");
  return [options](Io& io) {
    if (options->inputs.empty() && options->pairs.empty()) throw CLI::RequiredError("FILE or --pairs");
    run_import(*options, io);
  };
}

}  // namespace signweave::cli
