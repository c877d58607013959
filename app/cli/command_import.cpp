#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/wire/text.h"
#include "signweave/calls/import_call.h"
#include "signweave/calls/table.h"
#include "signweave/formats/file_format.h"

namespace signweave::cli {
namespace {

struct ImportArguments {
  std::string folder;
  std::vector<std::string> inputs;
  calls::ImportCall call;
};

/// The outcome as shown to people: JSON keeps an older spelling of one outcome, because programs compare it.
std::string_view outcome_text(ImportOutcome outcome) {
  return outcome == ImportOutcome::measured ? "measured again" : name_of(outcome);
}

/// Prints one recording on `out`, or its error on `err`.
void print(const calls::Imported& imported, Io& io) {
  if (imported.error) {
    // Errors caused by a file begin with its name; errors of the disk do not say which recording was being imported.
    io.err << "signweave: " << (imported.error->code() == ErrorCode::io ? imported.name + ": " : "")
           << one_line(imported.error->what()) << one_line(advice_of(imported.error->remedies())) << '\n';
    io.status = 1;
    return;
  }
  const ImportReport& report = *imported.report;
  print_notices(io, report.notices);
  if (!report.not_measured.empty()) {
    print_notices(io, {{report.name, "its phases are not measured: " + report.not_measured}});
  }
  if (io.json) return;
  std::string line = fmt::format("{}: {}", report.name, outcome_text(report.outcome));
  if (report.outcome != ImportOutcome::unchanged) {
    line += ", " + counted(static_cast<std::size_t>(report.frames), "frame");
    if (report.tracks > 0) line += ", " + counted(report.tracks, "scalar track");
    line += ", " + counted(report.signs, "sign");
    if (report.defects > 0) line += ", " + counted(report.defects, "defect");
  }
  io.out << line << std::endl;  // flushed: it is stored, so a pipe or log shows it now
}

void run_import(const ImportArguments& options, Io& io) {
  const ImportOptions import_options = options_of(options.call);
  Database database(options.folder, kv::Access::read_write);
  database.announce("signweave import");
  const std::vector<std::filesystem::path> inputs(options.inputs.begin(), options.inputs.end());
  const Pairing pairing = pairing_of(options.call, inputs);
  print_notices(io, pairing.notices);
  if (pairing.jobs.empty()) {
    throw Error(ErrorCode::not_found,
                fmt::format("no motion or annotation file in {}; signweave formats lists their extensions",
                            fmt::join(options.inputs, ", ")));
  }

  nlohmann::json recordings = nlohmann::json::array();
  {
    Progress progress(io, "importing");  // one bar for all; it must be erased before a line is printed
    std::size_t finished = 0;
    try {
      calls::run(database, pairing, import_options, {.progress = [&](double fraction) { progress.show(fraction); }},
                 [&](const calls::Imported& imported) {
                   ++finished;
                   progress.hide();
                   print(imported, io);
                   if (io.json) recordings.push_back(answer_json<nlohmann::json>(imported));
                 });
    } catch (const Error& error) {
      if (error.code() != ErrorCode::cancelled) throw;
      throw Error(
          ErrorCode::cancelled,
          fmt::format("stopped after {} of {}, which are completely stored; the same command continues with the others",
                      finished, counted(pairing.jobs.size(), "recording")));
    }
  }
  learn(database, listener_of(io));
  if (io.json) io.out << text_of(nlohmann::json{{"recordings", std::move(recordings)}});
}

}  // namespace

Run import(CLI::App& verb) {
  auto options = std::make_shared<ImportArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  verb.add_option("FILE", options->inputs,
                  "motion files " + readable_extensions(FileKind::motion) + ", annotation files " +
                      readable_extensions(FileKind::annotation) + ", face captures (.face.csv), folders of them");
  bind(verb, options->call);
  return [options](Io& io) {
    if (options->inputs.empty() && options->call.pairs.empty()) throw CLI::RequiredError("FILE or --pairs");
    run_import(*options, io);
  };
}

}  // namespace signweave::cli
