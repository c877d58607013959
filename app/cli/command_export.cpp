#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/delivery.h"
#include "app/cli/progress.h"
#include "app/wire/text.h"
#include "signweave/calls/export_call.h"
#include "signweave/calls/export_folder.h"
#include "signweave/calls/table.h"
#include "signweave/formats/file_format.h"

namespace signweave::cli {
namespace {

struct ExportArguments {
  std::string database;
  std::vector<std::string> recordings;
  bool all = false;
  std::vector<std::string> outputs;
  std::vector<std::string> extensions;
  calls::ExportCall call;
};

/// Accepts "bvh" for ".bvh".
std::string with_dot(const std::string& extension) {
  return extension.starts_with('.') ? extension : "." + extension;
}

void export_one(const ExportArguments& options, Io& io) {
  for (const std::string& path : options.outputs) {
    if (const std::string fault = check_extension(path, writable_extensions()); !fault.empty()) {
      const bool folder = extension_of(path).empty();
      throw CLI::ValidationError("--output",
                                 fault + (folder ? "; for a folder give --as, --all or several recordings" : ""));
    }
  }
  check_signing_space(options.call.signing_space, options.outputs);
  check_signing_space(!options.call.loci.empty(), options.outputs, "locus");
  check_signing_space(options.call.from_above, options.outputs, "from_above");
  const Database database(options.database, kv::Access::read_only);
  report_damage(database, io);
  const calls::SharedCharacter character = character_of(options.call.character);
  calls::Exported made = calls::run(database, options.call, options.outputs);
  if (character) show_on(made, stance_of(database, made.info), character);
  deliver(made, options.outputs, io);
}

void export_many(const ExportArguments& options, Io& io) {
  if (options.outputs.size() != 1) {
    throw CLI::ValidationError("-o",
                               "several recordings are written to one folder: give it once, and the files with --as");
  }
  if (!options.call.character.empty()) {
    throw CLI::ValidationError("--character", "is for one recording and one file");
  }
  calls::FolderExport wanted{.recordings = options.recordings, .folder = options.outputs[0], .call = options.call};
  for (const std::string& extension : options.extensions) wanted.extensions.push_back(with_dot(extension));
  const Database database(options.database, kv::Access::read_only);
  report_damage(database, io);
  calls::FolderExported done;
  {
    Progress progress(io, "exporting", "stopped; the files written before are complete");
    calls::Listener listener = listener_of(io);
    listener.progress = [&](double fraction) { progress.show(fraction); };
    done = calls::run(database, wanted, listener);
  }
  for (const auto& [name, value] : done.declarations) io.err << "signweave: " << one_line(value) << '\n';
  if (io.json) {
    io.out << text_of(answer_json<nlohmann::json>(done));
    return;
  }
  io.out << fmt::format("{}: {} of {}, and pairs.csv for import\n", options.outputs[0],
                        counted(done.files.size(), "file"), counted(done.recordings, "recording"));
}

}  // namespace

Run export_recording(CLI::App& verb) {
  auto options = std::make_shared<ExportArguments>();
  verb.add_option("DB", options->database, "the database")->required();
  verb.add_option("RECORDING", options->recordings, "name of the recording; several are written to a folder");
  Binder binder(verb, [&verb, options](std::string_view next) {
    if (next != "from") return;
    verb.add_flag("--all", options->all, "every recording, written to the folder of -o");
    verb.add_option("-o,--output", options->outputs,
                    fmt::format("file to write: {}; may be given several times; with --all, several recordings or --as "
                                "a folder",
                                fmt::join(writable_extensions(), " ")))
        ->required()
        ->allow_extra_args(false);
    verb.add_option("--as", options->extensions,
                    "extensions of the files of each recording in a folder; .bvh .face.csv .eaf if not given")
        ->type_name("EXTENSION");
  });
  const auto bind_rest = [&binder](const calls::Field& field, auto& member) {
    if (field.name != "recording") binder(field, member);
  };
  fields(bind_rest, options->call);
  return [options](Io& io) {
    if (options->all == !options->recordings.empty()) {
      throw CLI::ValidationError(options->all ? "--all selects every recording: do not name any in addition"
                                              : "give one or several RECORDINGs, or --all");
    }
    if (options->all || options->recordings.size() > 1 || !options->extensions.empty()) {
      export_many(*options, io);
      return;
    }
    options->call.recording = options->recordings[0];
    export_one(*options, io);
  };
}

}  // namespace signweave::cli
