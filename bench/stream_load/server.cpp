#include "bench/stream_load/server.h"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "signweave/database/database.h"
#include "signweave/notation/utterance.h"

namespace signweave::bench {

namespace {

/// The program of this build, or another one, for instance with sanitizers.
std::string program() {
  const char* other = std::getenv("SIGNWEAVE_PROGRAM");
  return other != nullptr ? other : SIGNWEAVE_PROGRAM;
}

std::vector<std::string> command(const std::filesystem::path& database, const std::vector<std::string>& options) {
  std::vector<std::string> words = {program(), "serve", database.string(), "--listen", "127.0.0.1:0"};
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

}  // namespace

Server::Server(const std::filesystem::path& database, const std::filesystem::path& work,
               const std::vector<std::string>& options)
    : process_(command(database, options), work / "server.log"),
      port_(static_cast<std::uint16_t>(std::stoi(process_.wait_for_line("listening on http://127.0.0.1:")))) {}

std::unique_ptr<Connection> Server::open(std::string_view options) const {
  auto stream = std::make_unique<Connection>(port_);
  stream->upgrade("/api/stream");
  stream->send(fmt::format(R"({{"type":"open",{}}})", options));
  if (!wait_for_answer(*stream)) throw std::runtime_error("the server did not open a stream");
  return stream;
}

std::string Server::metrics() const {
  Connection connection(port_);
  connection.send_raw("GET /metrics HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n");
  return connection.read_to_end();
}

double Server::metric(std::string_view name) const {
  const std::string text = metrics();
  const std::size_t at = text.find(fmt::format("\n{} ", name));
  if (at == text.npos) throw std::runtime_error(fmt::format("/metrics has no {}", name));
  return std::stod(text.substr(at + name.size() + 2));
}

bool wait_for_answer(Connection& stream) {
  for (;;) {
    const Connection::OwnedMessage message = stream.wait();
    if (is_of_type(message.text, "ok")) return true;
    if (is_of_type(message.text, "error")) return false;
  }
}

Connection::OwnedMessage wait_for_frames(Connection& stream) {
  for (;;) {
    Connection::OwnedMessage message = stream.wait();
    if (message.binary) return message;
    if (is_of_type(message.text, "error")) throw std::runtime_error(message.text);
  }
}

std::string control(std::string_view type, std::string_view utterance) {
  return nlohmann::json{{"type", type}, {"utterance", utterance}}.dump();
}

Utterances::Utterances(const std::filesystem::path& database)
    : glosses_(Database(database, kv::Access::read_only).snapshot().contents().segments.glosses()) {}

std::string Utterances::one() {
  return to_string(GlossRef{.gloss = glosses_[random_() % glosses_.size()]});
}

std::string Utterances::of(std::size_t glosses) {
  std::string text;
  for (std::size_t i = 0; i < glosses; ++i) text += one() + " ";
  return text;
}

std::string Utterances::in_four_lanes(std::size_t places) {
  std::string text;
  for (std::size_t i = 0; i < places; ++i) {
    text += fmt::format("{}{{weak: {}; fingers: {}; head: {}}} ", one(), one(), one(), one());
  }
  return text;
}

}  // namespace signweave::bench
