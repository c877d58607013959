#include "app/server/metrics.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace signweave::server {
namespace {

constexpr std::array<std::string_view, kRouteClasses> kClassNames = {"api",     "file",   "health",
                                                                     "metrics", "stream", "refused"};

struct Total {
  std::string_view name;
  std::string_view type;
  std::string_view help;
  Counter Metrics::*counter;
};
constexpr Total kTotals[] = {
    {"signweave_connections", "gauge", "Open connections.", &Metrics::connections},
    {"signweave_connections_total", "counter", "Connections accepted.", &Metrics::accepted},
    {"signweave_refused_total", "counter", "Connections and requests refused because of a limit.", &Metrics::refused},
    {"signweave_timeouts_total", "counter", "Connections closed because of a timeout.", &Metrics::timeouts},
    {"signweave_streams", "gauge", "Open streams.", &Metrics::streams},
    {"signweave_controls_total", "counter", "Control messages of streams.", &Metrics::controls},
    {"signweave_control_errors_total", "counter", "Control messages answered with an error.", &Metrics::control_errors},
    {"signweave_frames_total", "counter", "Frames sent.", &Metrics::frames},
    {"signweave_frames_left_out_total", "counter", "Frames dropped for slow clients.", &Metrics::left_out},
    {"signweave_messages_total", "counter", "Messages of frames sent.", &Metrics::messages},
    {"signweave_message_bytes_total", "counter", "Bytes of messages of frames.", &Metrics::bytes},
    {"signweave_messages_by_io_uring_total", "counter",
     "Messages of streams sent together with others by one system call.", &Metrics::by_one_call},
    {"signweave_ticks_total", "counter", "Paced messages that were due.", &Metrics::ticks},
    {"signweave_ticks_late_total", "counter", "Paced messages sent more than half a frame late.", &Metrics::late},
    {"signweave_starved_total", "counter", "Times that a paced stream had no frame ready in time.", &Metrics::starved},
};

template <typename Of>
std::uint64_t sum(std::span<const Metrics* const> threads, const Of& of) {
  std::uint64_t total = 0;
  for (const Metrics* one : threads) total += of(*one);
  return total;
}

void head(std::string& out, std::string_view name, std::string_view type, std::string_view help) {
  out += fmt::format("# HELP {0} {2}\n# TYPE {0} {1}\n", name, type, help);
}

/// The lines of one histogram; `label` is "class=\"api\"," or empty.
template <typename Of>
void histogram(std::string& out, std::span<const Metrics* const> threads, std::string_view name, std::string_view label,
               const Of& of) {
  std::uint64_t below = 0;
  for (std::size_t i = 0; i <= Histogram::kBounds.size(); ++i) {
    below += sum(threads, [&](const Metrics& m) { return of(m).bucket(i); });
    const std::string bound = i < Histogram::kBounds.size() ? fmt::format("{}", Histogram::kBounds[i]) : "+Inf";
    out += fmt::format("{}_bucket{{{}le=\"{}\"}} {}\n", name, label, bound, below);
  }
  double seconds = 0;
  for (const Metrics* one : threads) seconds += of(*one).sum();
  const std::string braces = label.empty() ? std::string() : fmt::format("{{{}}}", label.substr(0, label.size() - 1));
  out += fmt::format("{0}_sum{1} {2}\n{0}_count{1} {3}\n", name, braces, seconds, below);
}

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t size = 0;
  std::uint64_t resident = 0;
  file >> size >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

double cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

void Histogram::observe(double seconds) noexcept {
  const auto* bound = std::ranges::lower_bound(kBounds, seconds);
  buckets_[static_cast<std::size_t>(bound - kBounds.begin())].add();
  nanoseconds_.add(seconds > 0 ? static_cast<std::uint64_t>(seconds * 1e9) : 0);
}

std::string metrics_text(std::span<const Metrics* const> threads, const ServerState& state) {
  std::string out;
  head(out, "signweave_requests_total", "counter", "Requests answered.");
  for (std::size_t c = 0; c < kRouteClasses; ++c) {
    for (std::size_t status = 1; status < 6; ++status) {
      const std::uint64_t n = sum(threads, [&](const Metrics& m) { return m.requests[c][status].value(); });
      if (n == 0) continue;
      out += fmt::format("signweave_requests_total{{class=\"{}\",status=\"{}xx\"}} {}\n", kClassNames[c], status, n);
    }
  }
  head(out, "signweave_request_seconds", "histogram", "From a request's header to the last byte of its answer.");
  for (std::size_t c = 0; c < kRouteClasses; ++c) {
    histogram(out, threads, "signweave_request_seconds", fmt::format("class=\"{}\",", kClassNames[c]),
              [c](const Metrics& m) -> const Histogram& { return m.latency[c]; });
  }
  for (const Total& total : kTotals) {
    head(out, total.name, total.type, total.help);
    out +=
        fmt::format("{} {}\n", total.name, sum(threads, [&](const Metrics& m) { return (m.*total.counter).value(); }));
  }
  head(out, "signweave_lateness_seconds", "histogram", "Delay with which paced messages were sent.");
  histogram(
      out, threads, "signweave_lateness_seconds", "", [](const Metrics& m) -> auto& { return m.lateness; });
  head(out, "signweave_prepare_seconds", "histogram", "Computing frames ahead.");
  histogram(
      out, threads, "signweave_prepare_seconds", "", [](const Metrics& m) -> auto& { return m.prepare; });
  head(out, "signweave_first_frame_seconds", "histogram", "From glosses received to the first frame sent.");
  histogram(
      out, threads, "signweave_first_frame_seconds", "", [](const Metrics& m) -> auto& { return m.first_frame; });

  const auto gauge = [&](std::string_view name, std::string_view help, auto value) {
    head(out, name, "gauge", help);
    out += fmt::format("{} {}\n", name, value);
  };
  gauge("signweave_calls", "Calls being answered or waiting.", state.calls);
  gauge("signweave_databases", "Databases served.", state.databases);
  gauge("signweave_draining", "1 while the server is being stopped.", state.draining ? 1 : 0);
  gauge("process_resident_memory_bytes", "Resident memory of the process.", resident_bytes());
  head(out, "process_cpu_seconds_total", "counter", "Processor time of the process.");
  out += fmt::format("process_cpu_seconds_total {}\n", cpu_seconds());
  return out;
}

}  // namespace signweave::server
