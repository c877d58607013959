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

/// `signweave serve` of one database, as a process of its own, on a free port of this machine.
class Server {
 public:
  Server(const std::filesystem::path& database, const std::filesystem::path& work,
         const std::vector<std::string>& options = {});

  const Process& process() const noexcept { return process_; }
  std::uint16_t port() const noexcept { return port_; }
  /// A connection to its streams, opened: `options` are the fields of "open" after its type, such as
  /// R"("rate":60,"pace":"live")".
  std::unique_ptr<Connection> open(std::string_view options) const;
  /// A number that /metrics tells, by its whole name with labels.
  double metric(std::string_view name) const;

 private:
  std::string metrics() const;

  Process process_;
  std::uint16_t port_ = 0;
};

/// Waits for the answer to a control message; false where it is an error. What comes before it is passed over.
bool wait_for_answer(Connection& stream);
/// Waits for the next message of frames; events are passed over. Throws where the server tells of an error.
Connection::OwnedMessage wait_for_frames(Connection& stream);

/// A control message that signs or appends.
std::string control(std::string_view type, std::string_view utterance);

/// Utterances of a database's own glosses, others each time.
class Utterances {
 public:
  explicit Utterances(const std::filesystem::path& database);
  /// So many glosses at random, one after another.
  std::string of(std::size_t glosses);

 private:
  std::vector<std::string> glosses_;
  std::mt19937 random_{1};
};

}  // namespace signweave::bench
