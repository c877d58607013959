#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/table.h"
#include "signweave/database/database.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave::cli {
namespace {

TransitionStats stats_of(const Contents& contents, const std::string& recording) {
  if (recording.empty()) return contents.transitions;
  const auto index = static_cast<std::uint32_t>(&contents.at(recording) - contents.recordings.data());
  return summarize(transitions_in(signs_of(contents.segments, index)));
}

}  // namespace

Run stats(CLI::App& verb) {
  struct Options {
    std::string folder;
    std::string recording;
  };
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->folder, "the database")->required();
  verb.add_option("--recording", options->recording, "of this recording alone");
  return [options](Io& io) {
    const Database database(options->folder, kv::Access::read_only);
    report_damage(database, io);
    const TransitionStats stats = stats_of(*database.contents(), options->recording);
    const auto ms = [](Milliseconds time) { return std::to_string(time.count()); };
    if (io.json) {
      io.out << nlohmann::json{{"transitions", stats.count},
                               {"inferred", stats.inferred},
                               {"mean_ms", stats.mean.count()},
                               {"deviation_ms", stats.deviation.count()},
                               {"median_ms", stats.median.count()},
                               {"percentile_10_ms", stats.percentile_10.count()},
                               {"percentile_90_ms", stats.percentile_90.count()},
                               {"mean_retraction_ms", stats.mean_retraction.count()},
                               {"mean_preparation_ms", stats.mean_preparation.count()}}
                    .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
             << '\n';
      return;
    }
    if (stats.count == 0) {
      io.out << "no transition recorded\n";
      return;
    }
    io.out << format_table(
        {{"transitions", "mean ms", "SD", "median", "10 %", "90 %", "retraction", "preparation"},
         {std::to_string(stats.count), ms(stats.mean), ms(stats.deviation), ms(stats.median), ms(stats.percentile_10),
          ms(stats.percentile_90), ms(stats.mean_retraction), ms(stats.mean_preparation)}});
    if (stats.inferred) io.out << "(gaps between signs: no phases are annotated)\n";
  };
}

}  // namespace signweave::cli
