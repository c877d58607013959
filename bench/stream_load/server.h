#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bench/stream_load/connection.h"
#include "bench/stream_load/process.h"

namespace signweave::bench {

/// `signweave serve` of one database, as a separate process, on a free port of this machine.
class Server {
 public:
  Server(const std::filesystem::path& database, const std::filesystem::path& work,
         const std::vector<std::string>& options = {});

  const Process& process() const noexcept { return process_; }
  std::uint16_t port() const noexcept { return port_; }
  /// A connection to its stream, opened: `options` are the fields of "open" after its type, such as
  /// R"("rate":60,"pace":"live")".
  std::unique_ptr<Connection> open(std::string_view options) const;
  /// The value of a metric in /metrics, by its full name with labels.
  double metric(std::string_view name) const;

 private:
  std::string metrics() const;

  Process process_;
  std::uint16_t port_ = 0;
};

/// Waits for the answer to a control message; false if it is an error. Earlier messages are skipped.
bool wait_for_answer(Connection& stream);
/// Waits for the next message of frames; events are skipped. Throws if the server reports an error.
Connection::OwnedMessage wait_for_frames(Connection& stream);

/// A control message that signs or appends.
std::string control(std::string_view type, std::string_view utterance);

/// Generates utterances from a database's own glosses, different ones each time.
class Utterances {
 public:
  explicit Utterances(const std::filesystem::path& database);
  /// So many random glosses, one after another.
  std::string of(std::size_t glosses);
  /// So many places in which the other hand, the fingers and the head have random glosses of their own.
  std::string in_four_lanes(std::size_t places);

 private:
  std::string one();

  std::vector<std::string> glosses_;
  std::mt19937 random_{1};
};

}  // namespace signweave::bench
