#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/calls/query_call.h"
#include "app/calls/table.h"
#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "signweave/query/parse.h"

namespace signweave::cli {
namespace {

struct QueryArguments {
  std::string folder;
  std::string format = "table";
  calls::QueryCall call;
};

void run_query(const QueryArguments& options, Io& io) {
  parse(options.call.text);  // what is wrong with the query is told before anything is opened
  const Database database(options.folder, kv::Access::read_only);
  report_damage(database, io);
  const calls::QueryReport report = calls::run(database, options.call);
  print_notices(io, report.hints);
  if (report.plan && !io.json) {
    io.out << *report.plan;
  } else if (io.json || options.format == "json") {
    io.out << text_of(json_of(report));
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
    verb.add_option("--format", options->format, "of the answer")
        ->check(CLI::IsMember({"table", "json", "csv"}))
        ->capture_default_str();
  });
  return [options](Io& io) { run_query(*options, io); };
}

}  // namespace signweave::cli
