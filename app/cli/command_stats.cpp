#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/validators.h"
#include "app/wire/text.h"
#include "signweave/calls/stats_call.h"
#include "signweave/calls/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/database/database.h"
#include "signweave/formats/write_file.h"

namespace signweave::cli {
namespace {

constexpr std::size_t kMostTableRows =
    40;  ///< rows shown of a table of pairs, glosses or n-grams: the rest is only counted

struct StatsArguments {
  std::string folder;
  std::string format = "table";
  std::string plot;
  calls::StatsCall call;
};

void print_some(Rows rows, const std::string& noun, Io& io) {
  const std::size_t count = rows.size() - 1;
  if (count == 0) {
    io.out << "no " << noun << '\n';
    return;
  }
  rows.resize(std::min(rows.size(), kMostTableRows + 1));
  io.out << format_table(rows);
  if (count > kMostTableRows) {
    io.out << fmt::format("and {} more, see --format csv\n", calls::counted(count - kMostTableRows, noun));
  }
}

void print_tables(const calls::StatsCall& options, const calls::Counted& counted, Io& io) {
  if (options.pairs) print_some(pair_rows(by_pair(counted.all)), "pair", io);
  if (options.glosses) print_some(gloss_rows(glosses_of(all_signs(counted))), "gloss", io);
  if (options.ngrams > 0) print_some(ngram_rows(all_ngrams(counted, options.ngrams)), "n-gram", io);
  if (options.loci) print_some(loci_rows(counted.loci), "gloss", io);
  if (options.pairs || options.glosses || options.ngrams > 0 || options.loci) return;
  if (counted.all.empty()) {
    io.out << "no transition recorded\n";
    return;
  }
  const std::vector<NamedSummary> summaries = summaries_of(counted);
  io.out << format_table(transition_rows(summaries));
  const Rows hands = hand_rows(summaries);
  if (hands.size() > 1) io.out << '\n' << format_table(hands);
  for (const NamedSummary& one : summaries) {
    if (!one.summary.inferred) continue;
    io.out << fmt::format("{}: gaps between signs, because no phases are annotated\n",
                          one.recording.empty() ? "(all)" : one.recording);
  }
}

void run_stats(const StatsArguments& options, Io& io) {
  const bool csv = options.format == "csv" && !io.json;
  if (const std::string fault = csv ? calls::csv_fault(options.call) : ""; !fault.empty()) {
    throw CLI::ValidationError("--format", fault);
  }
  const Database database(options.folder, kv::Access::read_only);
  report_damage(database, io);
  const calls::Counted counted = calls::run(database, options.call, listener_of(io));
  if (!options.plot.empty()) {
    const std::string plot = calls::plot_of(options.call, counted, options.plot);
    AtomicFile file(options.plot);
    file.write(plot);
    file.commit();
  }
  if (io.json || options.format == "json") {
    io.out << text_of(answer_json<nlohmann::json>(answer_of(options.call, counted)));
  } else if (csv) {
    io.out << format_csv(csv_of(options.call, counted));
  } else {
    print_tables(options.call, counted, io);
  }
}

}  // namespace

Run stats(CLI::App& verb) {
  auto options = std::make_shared<StatsArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call);
  verb.add_option(
          "--plot", options->plot,
          "draw the transitions, split into retraction and preparation; with --loci, the ends of strokes (.svg)")
      ->check([](const std::string& path) { return check_extension(path, {".svg"}); });
  verb.add_option("--format", options->format, "format of the answer")
      ->check(one_of({"table", "json", "csv"}))
      ->capture_default_str();
  return [options](Io& io) { run_stats(*options, io); };
}

}  // namespace signweave::cli
