#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/stats_report.h"
#include "app/cli/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/database/database.h"
#include "signweave/formats/transition_plot.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave::cli {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestNgram = 8;
constexpr std::size_t kMostRows = 40;  ///< of a table of pairs, glosses or n-grams: the rest is counted

struct Options {
  std::string folder;
  std::string recording;
  std::string format = "table";
  std::string plot;
  std::size_t ngrams = 0;
  bool pairs = false;
  bool glosses = false;
};

/// What the annotation of some recordings holds.
struct Counted {
  std::vector<std::string> names;
  std::vector<std::vector<Sign>> signs;                      ///< [recording]
  std::vector<std::vector<RecordedTransition>> transitions;  ///< [recording]
  std::vector<RecordedTransition> all;
};

/// What tells how the hands move in the transitions of a recording; none where nothing was measured.
MotionOf motion_of(const Database& database, const Contents& contents, std::uint32_t recording,
                   const std::vector<Sign>& signs) {
  auto features = std::make_shared<const RecordingFeatures>(database.features(contents.recordings[recording].name));
  auto places =
      std::make_shared<const std::vector<std::vector<std::size_t>>>(phase_places_of(contents.segments, recording));
  if (!features->why_not.empty() || places->size() != signs.size()) return {};
  const auto phases_of = [features, places](std::size_t sign) {
    std::vector<PhaseFeatures> phases;
    for (const std::size_t place : (*places)[sign]) {
      if (place < features->phases.size()) phases.push_back(features->phases[place]);
    }
    return phases;
  };
  return [=](const Sign& from, const Sign& to, const Transition& transition) {
    return motion_between(from, phases_of(transition.from), to, phases_of(transition.to), features->shoulder_width);
  };
}

Counted count(const Database& database, const Contents& contents, const std::string& recording, Io& io) {
  if (!recording.empty()) contents.at(recording);  // throws where there is none
  Counted counted;
  for (std::size_t i = 0; i < contents.recordings.size(); ++i) {
    const std::string& name = contents.recordings[i].name;
    if (!recording.empty() && name != recording) continue;
    counted.names.push_back(name);
    counted.signs.push_back(signs_of(contents.segments, static_cast<std::uint32_t>(i)));
    MotionOf hands;
    try {
      hands = motion_of(database, contents, static_cast<std::uint32_t>(i), counted.signs.back());
    } catch (const Error& error) {  // durations can be told all the same
      io.err << "signweave: " << one_line(error.what()) << '\n';
      io.status = 1;
    }
    counted.transitions.push_back(recorded_transitions(name, counted.signs.back(), hands));
    counted.all.insert(counted.all.end(), counted.transitions.back().begin(), counted.transitions.back().end());
  }
  const bool none = std::all_of(counted.signs.begin(), counted.signs.end(), [](const auto& of) { return of.empty(); });
  if (!recording.empty() && none) {
    throw Error(ErrorCode::not_found,
                fmt::format("{}: no sign is annotated, so there is nothing to count; import its annotation with signs "
                            "on a sign tier",
                            recording));
  }
  return counted;
}

std::vector<NamedSummary> summaries_of(const Counted& counted) {
  std::vector<NamedSummary> summaries;
  for (std::size_t i = 0; i < counted.names.size(); ++i) {
    if (!counted.transitions[i].empty()) summaries.push_back({counted.names[i], describe(counted.transitions[i])});
  }
  if (summaries.size() != 1) summaries.push_back({"", describe(counted.all)});
  return summaries;
}

std::vector<Sign> all_signs(const Counted& counted) {
  std::vector<Sign> signs;
  for (const std::vector<Sign>& of : counted.signs) signs.insert(signs.end(), of.begin(), of.end());
  return signs;
}

std::vector<NgramStats> all_ngrams(const Counted& counted, std::size_t longest) {
  std::vector<NgramStats> ngrams;
  for (std::size_t length = 2; length <= longest; ++length) {
    std::vector<NgramStats> of = ngrams_of(counted.signs, length);
    std::move(of.begin(), of.end(), std::back_inserter(ngrams));
  }
  return ngrams;
}

void draw(const Counted& counted, const std::string& path) {
  std::vector<TransitionPanel> panels;
  for (std::size_t i = 0; i < counted.names.size(); ++i) {
    const std::vector<RecordedTransition> of = counted_transitions(counted.transitions[i]);
    if (of.empty()) continue;
    const TransitionSummary summary = describe(of);
    TransitionPanel panel{.title = counted.names[i],
                          .mean = summary.whole.duration.mean,
                          .deviation = summary.whole.duration.deviation,
                          .inferred = summary.inferred};
    for (const RecordedTransition& one : of) {
      const auto ms = [](Milliseconds time) { return static_cast<double>(time.count()); };
      const Transition& transition = one.transition;
      panel.bars.push_back({.from = one.from,
                            .to = one.to,
                            .begin = ms(transition.span.begin),
                            .retraction = summary.inferred ? 0 : ms(transition.retraction),
                            .preparation = summary.inferred ? 0 : ms(transition.preparation),
                            .whole = ms(transition.span.duration())});
    }
    panels.push_back(std::move(panel));
  }
  if (panels.empty()) {
    throw Error(ErrorCode::not_found, path +
                                          ": not written, for no transition is recorded: signs must follow each "
                                          "other, with phases or with gaps between them");
  }
  AtomicFile file(path);
  file.write(transition_plot(panels));
  file.commit();
}

template <typename Item>
json list_of(const std::vector<Item>& items) {
  json list = json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
}

void print_json(const Options& options, const Counted& counted, Io& io) {
  const TransitionSummary corpus = describe(counted.all);
  json recordings = json::array();
  for (std::size_t i = 0; i < counted.names.size(); ++i) {
    json one = json_of(describe(counted.transitions[i]));
    one["recording"] = counted.names[i];
    one["signs"] = counted.signs[i].size();
    one["transitions"] = list_of(counted.transitions[i]);
    recordings.push_back(std::move(one));
  }
  json out = {{"all", json_of(corpus)}, {"recordings", std::move(recordings)}};
  if (options.pairs) out["pairs"] = list_of(by_pair(counted.all));
  if (options.glosses) out["glosses"] = list_of(glosses_of(all_signs(counted)));
  if (options.ngrams > 0) out["ngrams"] = list_of(all_ngrams(counted, options.ngrams));
  io.out << out.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
}

void print_csv(const Options& options, const Counted& counted, Io& io) {
  if (options.pairs) {
    io.out << format_csv(pair_csv(by_pair(counted.all)));
  } else if (options.glosses) {
    io.out << format_csv(gloss_csv(glosses_of(all_signs(counted))));
  } else if (options.ngrams > 0) {
    io.out << format_csv(ngram_csv(all_ngrams(counted, options.ngrams)));
  } else {
    io.out << format_csv(transition_csv(summaries_of(counted)));
  }
}

void print_some(Rows rows, const std::string& noun, Io& io) {
  const std::size_t count = rows.size() - 1;
  if (count == 0) {
    io.out << "no " << noun << '\n';
    return;
  }
  rows.resize(std::min(rows.size(), kMostRows + 1));
  io.out << format_table(rows);
  if (count > kMostRows) {
    io.out << fmt::format("and {} more, see --format csv\n", cli::counted(count - kMostRows, noun));
  }
}

void print_tables(const Options& options, const Counted& counted, Io& io) {
  if (options.pairs) print_some(pair_rows(by_pair(counted.all)), "pair", io);
  if (options.glosses) print_some(gloss_rows(glosses_of(all_signs(counted))), "gloss", io);
  if (options.ngrams > 0) print_some(ngram_rows(all_ngrams(counted, options.ngrams)), "n-gram", io);
  if (options.pairs || options.glosses || options.ngrams > 0) return;
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
    io.out << fmt::format("{}: gaps between signs, for no phases are annotated\n",
                          one.recording.empty() ? "(all)" : one.recording);
  }
}

void run_stats(const Options& options, Io& io) {
  const bool csv = options.format == "csv" && !io.json;
  if (csv && (options.pairs ? 1 : 0) + (options.glosses ? 1 : 0) + (options.ngrams > 0 ? 1 : 0) > 1) {
    throw CLI::ValidationError("--format", "csv holds one table: give one of --pairs, --glosses and --ngrams");
  }
  const Database database(options.folder, kv::Access::read_only);
  report_damage(database, io);
  const std::shared_ptr<const Contents> contents = database.contents();
  const Counted counted = count(database, *contents, options.recording, io);
  if (!options.plot.empty()) draw(counted, options.plot);
  if (io.json || options.format == "json") {
    print_json(options, counted, io);
  } else if (csv) {
    print_csv(options, counted, io);
  } else {
    print_tables(options, counted, io);
  }
}

}  // namespace

Run stats(CLI::App& verb) {
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->folder, "the database")->required();
  verb.add_option("--recording", options->recording, "of this recording alone");
  verb.add_flag("--pairs", options->pairs, "the transitions of each pair of glosses");
  verb.add_flag("--glosses", options->glosses, "how often each gloss occurs, and how long sign and stroke last");
  verb.add_option("--ngrams", options->ngrams, "runs of 2 to N glosses, and the time between their strokes")
      ->check(CLI::Range(std::size_t{2}, kLongestNgram));
  verb.add_option("--plot", options->plot, "draw the transitions, split into retraction and preparation (.svg)")
      ->check([](const std::string& path) {
        return fold_case(path).ends_with(".svg") ? std::string()
                                                 : fmt::format("{}: a plot is written as .svg", printable(path));
      });
  verb.add_option("--format", options->format, "of the answer")
      ->check(CLI::IsMember({"table", "json", "csv"}))
      ->capture_default_str();
  return [options](Io& io) { run_stats(*options, io); };
}

}  // namespace signweave::cli
