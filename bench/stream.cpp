// The cost of streaming, measured by a client on the same machine: how soon the first frame of a gloss is sent, how
// many paced streams keep their time and what they cost against a loop that only sends, what batches gain and what a
// client that reads nothing costs. The server is a separate process.
//
// Arguments: --quick is the shortest form; --database FOLDER uses that database instead of generating 44 minutes of the
// demo corpus; --only PART measures one of: codec, first, long, paced, lanes, batches, stalled; --streams N uses only N
// paced streams; --no-io-uring: the server sends each message by a separate system call.

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <stdexcept>
#include <thread>
#include <tuple>

#include "bench/measure.h"
#include "bench/stream_load/paced.h"
#include "bench/stream_load/server.h"
#include "signweave/notation/utterance.h"
#include "tests/demo_database.h"

namespace {

using namespace signweave;
using namespace signweave::bench;
using bench::print;

constexpr double kRate = 60;
constexpr std::string_view kLive = R"("rate":60,"pace":"live","idle":"rest")";
constexpr std::string_view kLoop = R"("rate":60,"pace":"live","loop":true)";

struct Size {
  int glosses = 1000;
  std::size_t resting_streams = 50;
  std::size_t long_utterance = 1000;
  int long_rounds = 201;
  std::vector<std::size_t> paced = {100, 500, 1000};
  std::size_t in_lanes = 500;
  std::size_t looped_in_lanes = 8;  // places of one stream's utterance
  double settle = 2;
  double first_seconds = 5;
  double until_again = 10;  // by then the longest of the utterances has begun again
  double seconds = 15;
  int batch_rounds = 5;
  double batch_seconds = 1;
  std::size_t stalled = 200;
  double stalled_seconds = 10;
};
/// The minimum sleep of the bare loop, seconds; and the server's own tick.
constexpr double kBareTick = 0.001;
constexpr double kServersTick = 0.002;
constexpr std::size_t kOfPaced = 8;  // glosses of one stream's utterance

void codec() {
  const FrameShape shape{.joints = 60, .translations = 1, .tracks = 22};
  const std::vector<Eigen::Quaternionf> rotations(shape.joints, Eigen::Quaternionf(0.5f, 0.5f, -0.5f, 0.5f));
  const std::vector<Eigen::Vector3f> translations(shape.translations, Eigen::Vector3f(0.1f, 0.9f, 0));
  const std::vector<float> tracks(shape.tracks, 0.5f);
  const FrameView frame{{rotations, translations}, tracks};
  std::vector<std::byte> bytes(bytes_of(shape));
  std::vector<double> seconds;
  for (int round = 0; round < 15; ++round) {
    seconds.push_back(seconds_of(
        [&] {
          encode(frame, bytes);
          keep(bytes);
        },
        20'000));
  }
  const double us = 1e6 * median(seconds);
  print("stream/encode_60_joints_against_the_aim", us, "us", 0.2, us / 0.2, "<= 1");
}

void print_times(std::string_view name, std::vector<double> seconds, const std::vector<double>& pings) {
  std::sort(seconds.begin(), seconds.end());
  for (const auto& [part, value] : {std::pair("p50", 0.5), {"p99", 0.99}}) {
    const double ours = 1e3 * quantile(seconds, value);
    const double ping = 1e3 * quantile(pings, value);
    print(fmt::format("stream/first_frame/{}:{}_against_ping", name, part), ours, "ms", ping, ours / ping, "-");
  }
  const double aimed = 1e3 * quantile(seconds, 0.99);
  print(fmt::format("stream/first_frame/{}:p99_against_the_aim", name), aimed, "ms", 5, aimed / 5, "<= 1");
}

/// Seconds of the round trip of an empty control message.
double ping(Connection& stream) {
  const double begin = now();
  stream.send(R"({"type":"ping"})");
  if (!wait_for_answer(stream)) throw std::runtime_error("no answer to a ping");
  return now() - begin;
}

/// From sending a gloss to reading the first frames after its answer.
double first_frame(Connection& stream, std::string_view type, std::string_view utterance) {
  const std::string message = control(type, utterance);
  const double begin = now();
  stream.send(message);
  if (!wait_for_answer(stream)) throw std::runtime_error("the server sends no signing");
  return wait_for_frames(stream).at - begin;
}

/// The server's own measurement of the same, if it has one.
void print_of_server(const Server& server) {
  const std::string name = "signweave_first_frame_seconds";
  const double all = server.metric(name + "_count");
  for (const char* bound :
       {"0.0001", "0.00025", "0.0005", "0.001", "0.0025", "0.005", "0.01", "0.025", "0.05", "0.1"}) {
    if (server.metric(fmt::format("{}_bucket{{le=\"{}\"}}", name, bound)) < 0.99 * all) continue;
    const double ms = 1e3 * std::stod(bound);
    print("stream/first_frame/within_the_server:p99_at_most", ms, "ms", 5, ms / 5, "<= 1");
    return;
  }
}

void first_frames(const Server& server, Utterances& utterances, const Size& size) {
  std::vector<double> fresh, pings;
  for (int i = 0; i < size.glosses; ++i) {
    const std::unique_ptr<Connection> stream = server.open(kLive);
    fresh.push_back(first_frame(*stream, "append", utterances.of(1)));
    pings.push_back(ping(*stream));
  }
  std::sort(pings.begin(), pings.end());
  print_times("fresh", fresh, pings);

  // Streams at rest, which send the breathing signer continuously: one after another is sent a gloss, whenever it
  // rests.
  std::vector<std::unique_ptr<Connection>> streams;
  for (std::size_t i = 0; i < size.resting_streams; ++i) {
    streams.push_back(server.open(kLive));
    streams.back()->send(control("append", utterances.of(1)));
  }
  std::vector<double> at_rest;
  for (int i = 0; i < size.glosses; ++i) {
    Connection& stream = *streams[static_cast<std::size_t>(i) % streams.size()];
    while (!is_of_type(stream.wait().text, "rest")) {
    }
    while (stream.read([](const Connection::Message&) {})) {  // received meanwhile
    }
    std::this_thread::sleep_for(
        std::chrono::microseconds(1'000 + 331 * (i % 50)));  // at varying moments between two frames
    while (stream.read([](const Connection::Message&) {})) {
    }
    at_rest.push_back(first_frame(stream, "append", utterances.of(1)));
  }
  print_times("at_rest", at_rest, pings);
  print_of_server(server);
}

void long_utterances(const Server& server, Utterances& utterances, const Size& size) {
  std::vector<double> longer, shorter;
  // Each with its own glosses: repeated signing is cached, and would be as fast for any length.
  for (int round = -1; round < size.long_rounds; ++round) {
    const double a = first_frame(*server.open(kLive), "sign", utterances.of(size.long_utterance));
    const double b = first_frame(*server.open(kLive), "sign", utterances.of(10));
    if (round < 0) continue;
    longer.push_back(a);
    shorter.push_back(b);
  }
  print(fmt::format("stream/first_frame/{}_signs_against_10", size.long_utterance), 1e3 * median(longer), "ms",
        1e3 * median(shorter), median(longer) / median(shorter), "<= 1.2");
}

/// Streams that loop: in the first round everything is chosen, read and computed for each; later rounds are cached.
struct Looped {
  Paced first_time;
  Paced again;
};

Looped paced_by_server(const Server& server, const std::function<std::string()>& utterance, std::size_t count,
                       const Size& size) {
  std::vector<std::unique_ptr<Connection>> streams;
  for (std::size_t i = 0; i < count; ++i) {
    streams.push_back(server.open(kLoop));
    streams.back()->send(control("sign", utterance()));
    if (i % 20 > 0) continue;
    for (const auto& stream : streams)
      stream->read([](const Connection::Message&) {});  // reads, so that no client is slow
  }
  const auto cpu = [&] { return server.process().cpu_seconds(); };
  Looped looped;
  looped.first_time = receive_paced(streams, kRate, size.settle, size.first_seconds, cpu);
  looped.again = receive_paced(streams, kRate, size.until_again, size.seconds, cpu);
  return looped;
}

/// A process that only sends, with so many bytes per message.
struct BareSender {
  BareSender(std::size_t streams, double bytes, double rate, double tick, const std::filesystem::path& work)
      : process({"/proc/self/exe", "--bare-sender", std::to_string(streams), fmt::format("{:.0f}", bytes),
                 fmt::format("{}", rate), fmt::format("{}", tick)},
                work / "bare.log"),
        port(static_cast<std::uint16_t>(std::stoi(process.wait_for_line("listening on ")))) {}

  Process process;
  std::uint16_t port;
};

Paced paced_by_bare_loop(std::size_t count, double bytes, double tick, const std::filesystem::path& work,
                         const Size& size) {
  const BareSender sender(count, bytes, kRate, tick, work);
  std::vector<std::unique_ptr<Connection>> streams;
  for (std::size_t i = 0; i < count; ++i) {
    streams.push_back(std::make_unique<Connection>(sender.port));
    streams.back()->send_raw("!");
    std::this_thread::sleep_for(std::chrono::microseconds(500));  // they start one after another, as streams do
  }
  return receive_paced(streams, kRate, size.settle, size.seconds, [&] { return sender.process.cpu_seconds(); });
}

void print_lateness(const std::string& name, const Paced& paced) {
  for (const auto& [part, value] : {std::pair("p50", 0.5), {"p99", 0.99}}) {
    const double ms = 1e3 * quantile(paced.lateness, value);
    const double half_a_frame = 1e3 * 0.5 / kRate;
    print(fmt::format("{}/lateness:{}_against_half_a_frame", name, part), ms, "ms", half_a_frame, ms / half_a_frame,
          value > 0.9 ? "<= 1" : "-");
  }
}

void print_missed(const std::string& name, const Paced& paced) {
  const double due = static_cast<double>(paced.frames + paced.left_out);
  print(name, static_cast<double>(paced.missed), "frames", due, static_cast<double>(paced.missed) / due, "<= 0");
}

/// Per received frame, so that neither side gains by sending less.
double us_a_frame(const Paced& paced) {
  return 1e6 * paced.server_cpu_seconds / static_cast<double>(paced.frames);
}

void print_paced(const std::string& name, const Paced& ours, const Paced& bare) {
  print_missed(name + "/missed_of_due", ours);
  print(name + "/left_out_of_due", static_cast<double>(ours.left_out), "frames",
        static_cast<double>(ours.frames + ours.left_out), 0, "-");
  print_lateness(name, ours);
  print(name + "/cpu_a_frame_against_bare_loop", us_a_frame(ours), "us", us_a_frame(bare),
        us_a_frame(ours) / us_a_frame(bare), "<= 1.5");
  const auto cores = [](const Paced& p) { return p.server_cpu_seconds / p.seconds; };
  print(name + "/cores_against_bare_loop", cores(ours), "cores", cores(bare), cores(ours) / cores(bare), "-");
}

void paced_streams(const Server& server, Utterances& utterances, const std::filesystem::path& work, const Size& size) {
  for (const std::size_t count : size.paced) {
    const std::string name = fmt::format("stream/paced:{}", count);
    const Looped ours = paced_by_server(
        server, [&] { return utterances.of(kOfPaced); }, count, size);
    const Paced bare = paced_by_bare_loop(count, ours.again.message_bytes, kBareTick, work, size);
    const Paced slower = paced_by_bare_loop(count, ours.again.message_bytes, kServersTick, work, size);
    print_paced(name, ours.again, bare);
    print_paced(name + "/first_time", ours.first_time, bare);
    print(name + "/cpu_a_frame_against_bare_loop_of_2_ms", us_a_frame(ours.again), "us", us_a_frame(slower),
          us_a_frame(ours.again) / us_a_frame(slower), "-");
    print_missed(name + "/bare_loop/missed_of_due", bare);
    print_lateness(name + "/bare_loop", bare);
    const double of_client = ours.again.client_cpu_seconds / ours.again.seconds;
    const double against_bare = bare.client_cpu_seconds / bare.seconds;
    print(name + "/cores_of_the_client", of_client, "cores", against_bare, of_client / against_bare, "-");
  }
}

/// Streams in which three channels differ from the body, against the same number of whole-body ones.
void lanes(const Server& server, Utterances& utterances, Size size) {
  size.until_again *= 2;  // clips of other channels make a place longer
  const std::size_t count = size.in_lanes;
  const std::string name = fmt::format("stream/lanes:{}", count);
  const Looped whole = paced_by_server(
      server, [&] { return utterances.of(size.looped_in_lanes); }, count, size);
  const Looped ours = paced_by_server(
      server, [&] { return utterances.in_four_lanes(size.looped_in_lanes); }, count, size);
  for (const auto& [part, a, b] : {std::tuple(std::string(), &ours.again, &whole.again),
                                   {std::string("/first_time"), &ours.first_time, &whole.first_time}}) {
    print_missed(name + part + "/missed_of_due", *a);
    print_missed(name + part + "/whole_body/missed_of_due", *b);
    print_lateness(name + part, *a);
    print(name + part + "/cpu_a_frame_against_whole_body", us_a_frame(*a), "us", us_a_frame(*b),
          us_a_frame(*a) / us_a_frame(*b), part.empty() ? "<= 1.5" : "-");
  }
}

/// What is received on a stream that sends as fast as this client reads.
struct Flow {
  double frames_a_second = 0;
  double message_bytes = 0;
};

Flow flow_of(Connection& stream, double seconds) {
  std::uint64_t frames = 0, messages = 0, bytes = 0;
  const double begin = now();
  while (now() < begin + seconds) {
    const auto count = [&](const Connection::Message& message) {
      if (!message.binary) return;
      frames += message.header.frames;
      bytes += message.bytes;
      ++messages;
    };
    if (!stream.read(count)) stream.wait_until_readable();
  }
  return {static_cast<double>(frames) / (now() - begin),
          static_cast<double>(bytes) / static_cast<double>(std::max<std::uint64_t>(messages, 1))};
}

Flow flow_of_server(const Server& server, Utterances& utterances, int batch, double seconds) {
  const std::unique_ptr<Connection> stream =
      server.open(fmt::format(R"("rate":60,"pace":"fast","loop":true,"batch":{})", batch));
  stream->send(control("sign", utterances.of(kOfPaced)));
  wait_for_frames(*stream);
  return flow_of(*stream, seconds);
}

/// Messages of the same size that are only sent.
double messages_a_second(double bytes, const std::filesystem::path& work, double seconds) {
  const BareSender sender(1, bytes, 0, kBareTick, work);
  Connection stream(sender.port);
  stream.send_raw("!");
  return flow_of(stream, seconds).frames_a_second;
}

void batches(const Server& server, Utterances& utterances, const std::filesystem::path& work, const Size& size) {
  constexpr int kBatch = 60;
  std::vector<double> many, single, ratios, bare_many, bare_single, bare_ratios;
  for (int round = -1; round < size.batch_rounds; ++round) {
    const Flow a = flow_of_server(server, utterances, kBatch, size.batch_seconds);
    const Flow b = flow_of_server(server, utterances, 1, size.batch_seconds);
    const double bare_a = kBatch * messages_a_second(a.message_bytes, work, size.batch_seconds);
    const double bare_b = messages_a_second(b.message_bytes, work, size.batch_seconds);
    if (round < 0) continue;
    many.push_back(a.frames_a_second);
    single.push_back(b.frames_a_second);
    ratios.push_back(a.frames_a_second / b.frames_a_second);
    bare_many.push_back(bare_a);
    bare_single.push_back(bare_b);
    bare_ratios.push_back(bare_a / bare_b);
  }
  print("stream/batches_of_60_against_single_frames", median(many), "frames/s", median(single), median(ratios),
        ">= 20");
  print("stream/batches_of_60_against_single_frames/bare_loop", median(bare_many), "frames/s", median(bare_single),
        median(bare_ratios), "-");
}

/// Kilobytes that the system holds for TCP.
double tcp_memory() {
  std::ifstream file("/proc/net/sockstat");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("TCP:")) continue;
    return std::stod(line.substr(line.find("mem ") + 4)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  }
  return 0;
}

void stalled_clients(const Server& server, Utterances& utterances, const Size& size) {
  constexpr double kMiB = 1 << 20;
  // All sign the same, because transitions cached by the server must not be counted as a client's.
  const std::string text = utterances.of(kOfPaced);
  std::vector<std::unique_ptr<Connection>> reading;
  reading.push_back(server.open(kLoop));
  reading.back()->send(control("sign", text));
  wait_for_frames(*reading.back());
  const double before = server.process().resident_bytes();
  const double tcp_before = tcp_memory();
  std::vector<std::unique_ptr<Connection>> stalled;
  for (std::size_t i = 0; i < size.stalled; ++i) {
    stalled.push_back(server.open(kLoop));
    stalled.back()->send(control("sign", text));
  }
  const Paced with_stalled =
      receive_paced(reading, kRate, size.settle, size.stalled_seconds, [&] { return server.process().cpu_seconds(); });
  const auto each = [&](double bytes) { return bytes / kMiB / static_cast<double>(size.stalled); };
  const double grown = each(server.process().resident_bytes() - before);
  print("stream/stalled_client_against_the_aim", grown, "MiB", 1, grown, "<= 1");
  print("stream/stalled_client/both_ends_in_the_system", each(tcp_memory() - tcp_before), "MiB", 1,
        each(tcp_memory() - tcp_before), "-");
  print_missed("stream/with_stalled_clients/missed_of_due", with_stalled);
  print_lateness("stream/with_stalled_clients", with_stalled);
}

std::filesystem::path database_in(const std::filesystem::path& folder, double minutes) {
  demo_database(folder / "demo.db", demo::corpus_scripts(minutes));
  return folder / "demo.db";
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 5 && words[0] == "--bare-sender") {
    return run_bare_sender(std::stoul(words[1]), std::stoul(words[2]), std::stod(words[3]), std::stod(words[4]));
  }
  Size size;
  double minutes = 44;
  std::string database, only;
  std::vector<std::string> options;  // of the server
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--quick") {
      minutes = 2;
      size = {30, 20, 100, 7, {50}, 50, 1, 0.5, 1, 0.5, 1.5, 2, 0.2, 10, 0.5};
    } else if (words[i] == "--database" && i + 1 < words.size()) {
      database = words[++i];
    } else if (words[i] == "--only" && i + 1 < words.size()) {
      only = words[++i];
    } else if (words[i] == "--no-io-uring") {
      options.push_back(words[i]);
    } else if (words[i] == "--streams" && i + 1 < words.size()) {
      size.in_lanes = std::stoul(words[++i]);
      size.paced = {size.in_lanes};
    } else {
      fmt::print(stderr, "bench_stream: no argument '{}'\n", words[i]);
      return 2;
    }
  }
  // A thousand connections may exceed a shell's initial limit.
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
  try {
    const bench::Folder work("stream");
    const std::filesystem::path path = database.empty() ? database_in(work.path(), minutes) : database.c_str();
    Utterances utterances(path);
    const auto wanted = [&](std::string_view part) { return only.empty() || only == part; };
    // A separate server for each part, so that none is affected by earlier parts.
    const auto measure = [&](std::string_view part, auto&& action) {
      if (!wanted(part)) return;
      const Server server(path, work.path(), options);
      action(server);
    };
    if (wanted("codec")) codec();
    measure("first", [&](const Server& server) { first_frames(server, utterances, size); });
    measure("long", [&](const Server& server) { long_utterances(server, utterances, size); });
    measure("paced", [&](const Server& server) { paced_streams(server, utterances, work.path(), size); });
    measure("lanes", [&](const Server& server) { lanes(server, utterances, size); });
    measure("batches", [&](const Server& server) { batches(server, utterances, work.path(), size); });
    measure("stalled", [&](const Server& server) { stalled_clients(server, utterances, size); });
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_stream: {}\n", error.what());
    return 1;
  }
}
