// The paper's Table 1: its two scenarios on 44 minutes of motion, against the paper's own figures; and the motion part
// of the first (retrieval and concatenation) against a plain memcpy of its output.
//
// Arguments: --table prints a table for people instead of lines; --minutes M uses a corpus of another length;
// --quick two minutes and fewer rounds.

#include <malloc.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "signweave/choose/edit.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "tests/demo_database.h"

namespace {

using namespace signweave;

int rounds = 41;  // fewer with --quick

/// Milliseconds.
struct Row {
  double semantic_query = 0;
  double selection = 0;  ///< the paper has no such step
  double frames = 0;
  double retrieval = 0;
  double concatenation = 0;
  double total = 0;
};

struct Scenario {
  const char* name;
  Edit edit;
  Row paper;
  Row ours = {};
  std::size_t junctions = 0;
};

std::vector<Scenario> scenarios() {
  Edit replace;
  for (const char* text : {"BRETAGNE=VANNES", "DEMAIN=MARSEILLE", "VENDREDI=RENNES", "MATIN#2=LE MANS"}) {
    replace.replacements.push_back(parse_replacement(text));
  }
  Edit swap;
  swap.swap = parse_swap("BRETAGNE..PLUIE,NUAGES#2..BROUILLARD");
  return {{"scenario1", replace, {557, 0, 7050, 1786, 13856, 20492}},
          {"scenario2", swap, {144, 0, 6094, 1418, 5337, 8733}}};
}

void measure(const Database& database, Scenario& scenario) {
  std::vector<double> query, selection, retrieval, concatenation, total;
  Synthesis used;
  for (int round = -1; round < rounds; ++round) {
    Synthesized made = synthesize(database, "meteo", scenario.edit, {}, std::move(used));
    const Timings& t = made.timings;
    if (round >= 0) {
      query.push_back(1e3 * t.semantic_query.count());
      selection.push_back(1e3 * t.selection.count());
      retrieval.push_back(1e3 * t.retrieval.count());
      concatenation.push_back(1e3 * t.concatenation.count());
      total.push_back(1e3 * t.total.count());
    }
    scenario.ours.frames = static_cast<double>(made.result.motion.frame_count());
    scenario.junctions = made.result.junctions.size();
    used = std::move(made.result);
  }
  scenario.ours.semantic_query = bench::median(query);
  scenario.ours.selection = bench::median(selection);
  scenario.ours.retrieval = bench::median(retrieval);
  scenario.ours.concatenation = bench::median(concatenation);
  scenario.ours.total = bench::median(total);
}

double rest(const Row& row) {
  return row.total - row.semantic_query - row.selection - row.retrieval - row.concatenation;
}

void print_table(const std::vector<Scenario>& all, double minutes) {
  fmt::print("Table 1 of the paper, milliseconds (paper: 44 minutes; here: {:.1f}; medians of {} runs)\n\n", minutes,
             rounds);
  fmt::print("{:<22}{:>10}{:>11}{:>8}{:>11}{:>15}{:>9}{:>10}\n", "", "semantic", "selection", "frames", "retrieval",
             "concatenation", "rest", "total");
  for (const Scenario& one : all) {
    const auto row = [&](const char* whose, const Row& r, int digits) {
      fmt::print("{:<22}{:>10.{}f}{:>11}{:>8.0f}{:>11.{}f}{:>15.{}f}{:>9.{}f}{:>10.{}f}\n",
                 fmt::format("{}, {}", one.name, whose), r.semantic_query, digits,
                 r.selection > 0 ? fmt::format("{:.{}f}", r.selection, digits) : "-", r.frames, r.retrieval, digits,
                 r.concatenation, digits, rest(r), digits, r.total, digits);
    };
    row("paper", one.paper, 0);
    row("here", one.ours, 3);
  }
  fmt::print("\nPer frame retrieved and per junction, microseconds:\n");
  for (const Scenario& one : all) {
    const auto junctions = static_cast<double>(one.junctions);
    fmt::print("  {}: {:.3f} and {:.1f} (paper: {:.0f} and {:.0f})\n", one.name,
               1e3 * one.ours.retrieval / one.ours.frames, 1e3 * one.ours.concatenation / junctions,
               1e3 * one.paper.retrieval / one.paper.frames, 1e3 * one.paper.concatenation / junctions);
  }
}

void print_lines(const std::vector<Scenario>& all) {
  for (const Scenario& one : all) {
    const auto line = [&](const char* what, const char* unit, double ours, double paper) {
      bench::print(fmt::format("table1/{}/{}", one.name, what), ours, unit, paper, ours / paper, "<= 1");
    };
    line("semantic_query", "ms", one.ours.semantic_query, one.paper.semantic_query);
    fmt::print("table1/{}/selection {:.4g} ms - - -\n", one.name, one.ours.selection);
    fmt::print("table1/{}/frames {:.0f} frames {:.0f} - -\n", one.name, one.ours.frames, one.paper.frames);
    line("retrieval", "ms", one.ours.retrieval, one.paper.retrieval);
    line("concatenation", "ms", one.ours.concatenation, one.paper.concatenation);
    line("rest", "ms", rest(one.ours), rest(one.paper));
    line("total", "ms", one.ours.total, one.paper.total);
    const auto junctions = static_cast<double>(one.junctions);
    line("retrieval_per_frame", "us", 1e3 * one.ours.retrieval / one.ours.frames,
         1e3 * one.paper.retrieval / one.paper.frames);
    line("concatenation_per_junction", "us", 1e3 * one.ours.concatenation / junctions,
         1e3 * one.paper.concatenation / junctions);
  }
}

std::size_t size_of(const Motion& motion) {
  return motion.rotations().size_bytes() + motion.translations().size_bytes() +
         motion.tracks().size() * static_cast<std::size_t>(motion.frame_count()) * sizeof(float);
}

/// Copies all numbers of a motion to `to`.
void copy(const Motion& motion, std::byte* to) {
  std::memcpy(to, motion.rotations().data()->coeffs().data(), motion.rotations().size_bytes());
  to += motion.rotations().size_bytes();
  std::memcpy(to, motion.translations().data()->data(), motion.translations().size_bytes());
  to += motion.translations().size_bytes();
  for (const ScalarTrack& track : motion.tracks()) {
    std::memcpy(to, track.values.data(), track.values.size() * sizeof(float));
    to += track.values.size() * sizeof(float);
  }
}

/// Scenario 1 in total, warm and on a database just opened, against the aims for them.
void compare_with_aims(const std::filesystem::path& folder, const Scenario& scenario) {
  bench::print("table1/scenario1/total_warm", scenario.ours.total, "ms", 1.8, scenario.ours.total / 1.8, "<= 1");
  std::vector<double> opened;
  for (int round = 0; round < rounds; ++round) {
    const Database database(folder, kv::Access::read_only);
    opened.push_back(1e3 * synthesize(database, "meteo", scenario.edit).timings.total.count());
  }
  const double total = bench::median(opened);
  bench::print("table1/scenario1/total_just_opened", total, "ms", 10, total / 10, "<= 1");
}

double seconds_of_motion_part(const Synthesized& made) {
  return (made.timings.retrieval + made.timings.concatenation).count();
}

/// Scenario 1's retrieval and concatenation against a memcpy of its output.
void compare_with_memcpy(const Database& database, const Edit& edit) {
  // Blocks of a megabyte always come from the system and are returned to it, so every allocation touches new pages.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
  Synthesis used = synthesize(database, "meteo", edit).result;
  std::vector<std::byte> warm(size_of(used.motion));
  std::vector<double> ours_warm, ours_fresh, copy_warm, copy_fresh, ratio_warm, ratio_fresh;
  for (int round = 0; round < rounds; ++round) {
    Synthesized made = synthesize(database, "meteo", edit, {}, std::move(used));
    ours_warm.push_back(seconds_of_motion_part(made));
    used = std::move(made.result);
    copy_warm.push_back(bench::seconds_of([&] { copy(used.motion, warm.data()); }));
    ratio_warm.push_back(ours_warm.back() / copy_warm.back());

    const Synthesized fresh = synthesize(database, "meteo", edit);
    ours_fresh.push_back(seconds_of_motion_part(fresh));
    copy_fresh.push_back(bench::seconds_of([&] {
      auto* const block = static_cast<std::byte*>(std::malloc(size_of(used.motion)));
      if (block == nullptr) std::abort();
      copy(used.motion, block);
      bench::keep(block);
      std::free(block);
    }));
    ratio_fresh.push_back(ours_fresh.back() / copy_fresh.back());
  }
  bench::keep(warm);
  const auto line = [](const char* name, const std::vector<double>& ours, const std::vector<double>& bare,
                       const std::vector<double>& ratios, const char* goal) {
    bench::print(name, 1e3, "ms", {bench::median(ours), bench::median(bare), bench::median(ratios)}, goal);
  };
  line("motion_part/warm_pages", ours_warm, copy_warm, ratio_warm, "<= 3.5");
  line("motion_part/fresh_pages", ours_fresh, copy_fresh, ratio_fresh, "<= 1.5");
}

}  // namespace

int main(int count, char** arguments) {
  try {
    bool table = false;
    double minutes = 44;
    for (int i = 1; i < count; ++i) {
      const std::string word = arguments[i];
      if (word == "--table") {
        table = true;
      } else if (word == "--quick") {
        minutes = 2;
        rounds = 11;
      } else if (word == "--minutes" && i + 1 < count) {
        minutes = std::stod(arguments[++i]);
      } else {
        fmt::print(stderr, "bench_table1: unknown argument '{}'; available: --table, --quick and --minutes M\n", word);
        return 2;
      }
    }
    const bench::Folder folder("table1");
    const std::unique_ptr<const Database> database =
        demo_database(folder.path() / "corpus.db", demo::corpus_scripts(minutes));
    double motion = 0;
    const std::shared_ptr<const Contents> contents = database->contents();
    for (const RecordingInfo& info : contents->recordings) {
      motion += static_cast<double>(info.motion->frames) / info.motion->rate.hertz() / 60;
    }
    std::vector<Scenario> all = scenarios();
    for (Scenario& one : all) measure(*database, one);
    if (all[0].junctions != 8 || all[1].junctions != 3) {
      fmt::print(stderr, "bench_table1: {} and {} junctions where the paper has 8 and 3\n", all[0].junctions,
                 all[1].junctions);
      return 1;
    }
    if (table) {
      print_table(all, motion);
    } else {
      fmt::print("table1/corpus {:.1f} minutes 44 - -\n", motion);
      print_lines(all);
      compare_with_aims(folder.path() / "corpus.db", all.front());
      compare_with_memcpy(*database, all.front().edit);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_table1: {}\n", error.what());
    return 1;
  }
  return 0;
}
