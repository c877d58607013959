#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/table.h"
#include "signweave/database/database.h"
#include "signweave/query/find.h"
#include "signweave/query/parse.h"
#include "signweave/query/plan.h"

namespace signweave::cli {
namespace {

struct Options {
  std::string folder;
  std::string text;
  std::string format = "table";
  std::size_t limit = 0;
  std::int64_t timeout_ms = 0;
  bool explain = false;
};

std::vector<std::vector<std::string>> rows_of(const std::vector<Segment>& answers) {
  std::vector<std::vector<std::string>> rows = {{"recording", "name", "begin ms", "end ms"}};
  for (const Segment& segment : answers) {
    rows.push_back({segment.recording, segment.name, std::to_string(segment.span.begin.count()),
                    std::to_string(segment.span.end.count())});
  }
  return rows;
}

void run_query(const Options& options, Io& io) {
  const PhaseQuery query = parse(options.text);
  const Database database(options.folder, kv::Access::read_only);
  report_damage(database, io);
  const std::shared_ptr<const Contents> contents = database.contents();
  if (options.explain) {
    const std::string plan = explain(query, contents->segments);
    if (io.json) {
      io.out << nlohmann::json{{"plan", plan}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    } else {
      io.out << plan;
    }
    return;
  }
  FindLimits limits;
  if (options.limit > 0) limits.limit = options.limit;
  if (options.timeout_ms > 0) {
    limits.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(options.timeout_ms);
  }
  const std::vector<Segment> answers = database.find(query, limits);
  if (answers.empty()) print_notices(io, hints(query, contents->segments));
  if (io.json || options.format == "json") {
    nlohmann::json list = nlohmann::json::array();
    for (const Segment& segment : answers) {
      nlohmann::json parts = nlohmann::json::array();
      for (const auto& part : segment.parts) {
        parts.push_back(
            {{"name", part.name}, {"begin_ms", part.span.begin.count()}, {"end_ms", part.span.end.count()}});
      }
      list.push_back({{"recording", segment.recording},
                      {"name", segment.name},
                      {"begin_ms", segment.span.begin.count()},
                      {"end_ms", segment.span.end.count()},
                      {"parts", std::move(parts)}});
    }
    io.out << list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  } else if (options.format == "csv") {
    io.out << format_csv(rows_of(answers));
  } else {
    io.out << format_table(rows_of(answers)) << counted(answers.size(), "answer") << '\n';
  }
}

}  // namespace

Run query(CLI::App& verb) {
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->folder, "the database")->required();
  verb.add_option("TEXT", options->text, "the query; docs/query.md tells the language")->required();
  verb.add_option("--format", options->format, "of the answer")
      ->check(CLI::IsMember({"table", "json", "csv"}))
      ->capture_default_str();
  verb.add_option("--limit", options->limit, "at most so many answers")->check(CLI::Range(1, 1'000'000'000));
  verb.add_option("--timeout", options->timeout_ms, "give up after so many ms")->check(CLI::Range(1, 1'000'000'000));
  verb.add_flag("--explain", options->explain, "show how the query would be answered");
  return [options](Io& io) { run_query(*options, io); };
}

}  // namespace signweave::cli
