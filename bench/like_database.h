#pragma once

// The part of bench/like that queries a database: one generated recording of so many minutes at 100 frames per second.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "bench/measure.h"
#include "signweave/query/parse.h"
#include "tests/demo_database.h"

namespace signweave::bench {

/// The whole demo corpus as one recording: the amount measured per recording is then as large as possible.
inline demo::Script in_one(double minutes) {
  demo::Script whole;
  for (demo::Script& script : demo::corpus_scripts(minutes)) {
    if (whole.units.empty())
      whole = std::move(script);
    else
      whole.units.insert(whole.units.end(), script.units.begin(), script.units.end());
  }
  whole.name = "whole";
  return whole;
}

struct Overshoot {
  double longest = 0;  ///< seconds from the deadline to the error
  int stopped = 0;     ///< searches that ended at their deadline
};

/// Queries a freshly opened database repeatedly, with deadlines spread over the time that the query takes.
inline Overshoot overshoot(const std::filesystem::path& folder, const PhaseQuery& query, double seconds, int times) {
  Overshoot result;
  for (int i = 0; i < times; ++i) {
    const Database database(folder, kv::Access::read_only);
    database.contents();
    const auto after = std::chrono::duration<double>(seconds * (i + 0.5) / times);
    const auto deadline =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::nanoseconds>(after);
    try {
      keep(database.find(query, {.limit = {}, .deadline = deadline}));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::cancelled) throw;
      ++result.stopped;
      const std::chrono::duration<double> late = std::chrono::steady_clock::now() - deadline;
      result.longest = std::max(result.longest, late.count());
    }
  }
  return result;
}

/// First and later answers to queries on movement, and how soon they stop at a deadline.
inline void ask_database(double minutes, int times) {
  const Folder folder("like");
  const std::filesystem::path path = folder.path() / "db";
  const demo::Script script = in_one(minutes);
  { demo_database(path, std::span(&script, 1)); }
  struct Question {
    const char* name;
    const char* text;
  };
  for (const auto& [name, text] : {Question{"speed_of_hands", "speed(hand) > 1.2 m/s"},
                                   Question{"speed_of_strokes", "phase = stroke & speed(right_hand) > 1.2 m/s"},
                                   Question{"height_of_strokes", "phase = stroke & max(right_hand).height > shoulder"},
                                   Question{"zone_of_strokes", "phase = stroke & enters(right_hand, chin)"},
                                   Question{"palm_of_strokes", "phase = stroke & any(right_hand).palm = up"},
                                   Question{"height_of_elbow", "max(right_elbow).height > chest"},
                                   Question{"speed_of_elbow", "speed(right_elbow) > 0.5 m/s"},
                                   Question{"like_hands", R"(like("whole"@61000..61500))"},
                                   Question{"like_elbow", R"(like("whole"@61000..61500, right_elbow))"}}) {
    const PhaseQuery query = parse(text);
    const Database database(path, kv::Access::read_only);
    const std::size_t rows = database.contents()->segments.row_count();
    std::size_t found = 0;
    const auto ask = [&] { found = database.find(query).size(); };
    const double first = seconds_of(ask);
    const double later = seconds_of(ask, times);
    print(fmt::format("find/{}:first", name), 1e3 * first, "ms", 1e3 * later, first / later, "-");
    const Overshoot late = overshoot(path, query, first, times);
    print(fmt::format("find/{}:after_its_deadline", name), 1e3 * late.longest, "ms", 10, 1e2 * late.longest, "<= 1");
    fmt::print(stderr, "{}: {} rows, {} answers, {} of {} searches stopped\n", text, rows, found, late.stopped, times);
  }
}

}  // namespace signweave::bench
