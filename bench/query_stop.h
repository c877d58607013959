#pragma once

// How long a search continues after it was stopped: cancelled from another thread at random moments, or by its
// deadline.

#include <pthread.h>
#include <time.h>

#include <atomic>
#include <chrono>
#include <random>
#include <string>
#include <thread>

#include "bench/measure.h"
#include "signweave/query/find.h"
#include "signweave/query/parse.h"

namespace signweave::bench {

/// The longest time in seconds from the stop to the end of the search, of `tries`. A try that ends by itself before the
/// stop is not counted.
inline double slowest_stop(const char* text, const std::shared_ptr<const Segments>& segments, int tries, bool cancelled,
                           int& stopped) {
  clockid_t own{};
  pthread_getcpuclockid(pthread_self(), &own);
  const auto worked = [own] {
    timespec time{};
    clock_gettime(own, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  std::mt19937 random(7);
  double longest = 0;
  stopped = 0;
  for (int i = 0; i < tries; ++i) {
    const auto when = std::chrono::steady_clock::now() + std::chrono::microseconds(500 + random() % 150'000);
    std::atomic<bool> cancel = false;
    double stopped_at = 0;
    FindLimits limits;
    if (cancelled) limits.cancel = &cancel;
    if (!cancelled) limits.deadline = when;
    std::thread other([&] {
      std::this_thread::sleep_until(when);
      stopped_at = worked();
      cancel = true;
    });
    bool threw = false;
    try {
      keep(find(parse(text), *segments, limits).size());
    } catch (const Error& error) {
      threw = error.code() == ErrorCode::cancelled;
    }
    const double end = worked();
    other.join();
    if (!threw) continue;
    ++stopped;
    longest = std::max(longest, end - stopped_at);
  }
  return longest;
}

/// Queries that take long for different reasons: endless combinations, an answer of every row, sorting, expressions,
/// partners that are sequences.
inline void measure_stops(std::string_view corpus, const std::shared_ptr<const Segments>& segments, bool quick) {
  const struct {
    const char* name;
    const char* text;
  } kQueries[] = {
      {"combinations", "gloss =~ /.*/ ->[0s..] gloss =~ /.*/ ->[0s..] gloss =~ /.*/ ->[0s..] gloss =~ /.*/"},
      {"every_row", "phase =~ /.*/ | gloss =~ /.*/ | tier(\"BenchMouthing\") =~ /.*/"},
      {"join", "gloss =~ /.*/ overlaps tier(\"BenchMouthing\") =~ /.*/"},
      {"sorting", "@ tier(\"BenchMouthing\") =~ /.*/ overlaps gloss =~ /.*/ & duration > 1ms"},
      {"expressions", "gloss =~ /(A|B|.)*[0-9]{0,60}(X|.*).*/ | tier(\"BenchMouthing\") =~ /.*(a.*b|c.*d|.*e).*/"},
      {"groups", "(gloss =~ /.*/ ->[0s..] gloss =~ /.*/) overlaps (phase = stroke ->[0s..] phase = stroke)"},
      {"linked", "!overlaps(tier(\"BenchMouthing\") =~ /.*/) & child(phase = stroke) | duration > 1ms"},
  };
  const int tries = quick ? 2 : 40;
  for (const auto& query : kQueries) {
    FindLimits some;
    some.limit = 20;
    const double limited = seconds_of([&] { keep(find(parse(query.text), *segments, some).size()); });
    print(fmt::format("{}/stop/{}/limit_20", corpus, query.name), 1e3 * limited, "ms", 10, 100 * limited, "-");
    for (const bool cancelled : {true, false}) {
      int stopped = 0;
      const double longest = slowest_stop(query.text, segments, tries, cancelled, stopped);
      const std::string name = fmt::format("{}/stop/{}/{}", corpus, query.name, cancelled ? "cancel" : "deadline");
      print(name, 1e3 * longest, "ms", 10, 100 * longest, "<= 1");
      fmt::print(stderr, "{}: {} of {} were stopped\n", name, stopped, tries);
    }
  }
}

}  // namespace signweave::bench
