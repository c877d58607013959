#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/validators.h"
#include "app/wire/text.h"
#include "signweave/calls/export_folder.h"
#include "signweave/calls/query_call.h"
#include "signweave/calls/query_documents.h"
#include "signweave/calls/table.h"
#include "signweave/formats/eaf/eaf.h"

namespace signweave::cli {
namespace {

struct QueryArguments {
  std::string folder;
  std::string format = "table";
  std::filesystem::path folder_of_files;
  calls::QueryCall call;
};

/// Writes one file per recording.
void write_files(const QueryArguments& options, const Database& database, const calls::QueryReport& report, Io& io) {
  std::filesystem::create_directories(options.folder_of_files);
  for (const calls::QueryDocument& one : calls::documents_of(database, report.answers)) {
    const std::filesystem::path file = options.folder_of_files / (calls::file_name_of(one.recording) + ".eaf");
    eaf::write(file, one.document);
    io.out << file.string() << '\n';
  }
}

void run_query(const QueryArguments& options, Io& io) {
  if ((options.format == "eaf") != !options.folder_of_files.empty()) {
    throw CLI::ValidationError("--format",
                               "eaf writes one file per recording: give --format eaf and -o FOLDER together");
  }
  const Database database(options.folder, kv::Access::read_only);
  report_damage(database, io);
  const calls::QueryReport report = calls::run(database, options.call);
  print_notices(io, report.hints);
  if (report.plan && !io.json && options.format != "json") {
    io.out << *report.plan;
  } else if (options.format == "eaf") {
    write_files(options, database, report, io);
  } else if (io.json || options.format == "json") {
    io.out << text_of(answer_json<nlohmann::json>(answer_of(report)));
  } else if (options.format == "csv") {
    io.out << format_csv(rows_of(report));
  } else {
    io.out << format_table(rows_of(report)) << counted(report.answers.size(), "answer") << '\n';
  }
}

}  // namespace

Run query(CLI::App& verb) {
  auto options = std::make_shared<QueryArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call, [&verb, options](std::string_view next) {
    if (next != "limit") return;
    verb.add_option("--format", options->format, "format of the answer")
        ->check(one_of({"table", "json", "csv", "eaf"}))
        ->capture_default_str();
    verb.add_option("-o,--output", options->folder_of_files, "the folder for --format eaf");
  });
  return [options](Io& io) { run_query(*options, io); };
}

}  // namespace signweave::cli
