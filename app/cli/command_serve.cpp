#include <fmt/format.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/validators.h"
#include "app/server/access.h"
#include "app/server/api.h"
#include "app/server/server.h"
#include "signweave/core/text.h"

namespace signweave::cli {
namespace {

struct ServeArguments {
  std::vector<std::string> folders;
  std::string listen = "127.0.0.1:8080";
  bool writable = false;
  std::string token_file;
  std::string characters;
  std::string media;
  bool no_io_uring = false;
  server::ServerOptions server;
};

struct Listen {
  std::string address;
  std::uint16_t port = 0;
};

/// "127.0.0.1:8080", "[::1]:0"
std::optional<Listen> parse_listen(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  Listen result{.address = text.substr(0, colon)};
  if (result.address.starts_with('[') && result.address.ends_with(']')) {
    result.address = result.address.substr(1, result.address.size() - 2);
  } else if (result.address.find(':') != std::string::npos) {
    return std::nullopt;
  }
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data() + colon + 1, end, result.port);
  if (error != std::errc{} || parsed != end) return std::nullopt;
  return result;
}

std::string read_token(const std::string& file) {
  if (file.empty()) {
    const char* const value = std::getenv("SIGNWEAVE_TOKEN");
    return value == nullptr ? std::string() : std::string(trimmed(value));
  }
  std::ifstream in(file, std::ios::binary);
  std::string text(4'096, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  std::string token(trimmed(text));
  if (token.empty()) throw Error(ErrorCode::bad_input, fmt::format("{}: no token in this file", file));
  return token;
}

/// A folder for this process only, removed at its end.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "signweave-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw Error(ErrorCode::io, fmt::format("{}: the folder for uploads could not be created", name));
    }
    path_ = name;
  }
  Scratch(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

/// Raises the limit of open connections to what the system allows the process.
void raise_file_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= limit.rlim_max) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

void run_serve(const ServeArguments& given, Io& io) {
  server::ServerOptions options = given.server;
  const Listen listen = *parse_listen(given.listen);
  options.address = listen.address;
  options.port = listen.port;
  options.token = read_token(given.token_file);
  options.io_uring = !given.no_io_uring;
  if (!server::is_loopback(options.address)) {
    if (options.limits.connections_per_address == 0) options.limits.connections_per_address = 256;
    if (options.limits.requests_per_second <= 0) options.limits.requests_per_second = 100;
  }
  if (!options.files.empty() && !std::filesystem::is_directory(options.files)) {
    throw Error(ErrorCode::not_found, fmt::format("{}: no folder", options.files.string()));
  }
  if (!given.media.empty() && !std::filesystem::is_directory(given.media)) {
    throw Error(ErrorCode::not_found, fmt::format("{}: no folder", given.media));
  }
  (void)server::AccessControl(options);  // before databases are opened, which may take a while

  server::ServedDatabases databases;
  if (!given.characters.empty()) {
    databases.characters = calls::Characters(given.characters);
  } else if (const auto served_characters = options.files / "characters";
             !options.files.empty() && std::filesystem::is_directory(served_characters)) {
    databases.characters = calls::Characters(served_characters);
  }
  databases.media = given.media;
  for (const std::string& folder : given.folders) databases.add(folder, given.writable);
  for (const auto& one : databases.all()) {
    report_damage(one->database(), io);
    one->signing().warm_up();
  }
  io.status = 0;  // damage was reported, and is left out
  raise_file_limit();
  const Scratch scratch;
  options.scratch = scratch.path();
  server::Api api(databases, {}, scratch.path());
  server::Server server(databases, api, options);
  server.stop_on_signals();
  for (const auto& one : databases.all()) one->announce(fmt::format("signweave serve at {}", server.url()));
  io.err << "listening on " << server.url() << std::endl;
  server.wait();
}

}  // namespace

Run serve(CLI::App& verb) {
  auto options = std::make_shared<ServeArguments>();
  server::ServerOptions& server = options->server;
  verb.add_option("DB", options->folders, "databases; each is served under its folder's name without extension")
      ->required();
  verb.add_option("--listen", options->listen,
                  "address and port; port 0 is any free one. Addresses other than loopback require a token")
      ->check([](const std::string& text) {
        return parse_listen(text) ? std::string()
                                  : "'" + printable(text) + "' is not ADDRESS:PORT, such as 127.0.0.1:8080 or [::1]:0";
      })
      ->capture_default_str();
  verb.add_flag("--writable", options->writable, "allow imports and removals to change the databases");
  verb.add_option("--files", server.files, "serve the files of this folder in addition to the calls");
  verb.add_option("--characters", options->characters,
                  "folder of the characters (.glb) that motions may be shown on; 'characters' of the served files if "
                  "not given");
  verb.add_option("--media", options->media, "folder of the videos that annotations link to");
  verb.add_option("--token-file", options->token_file,
                  "the token that clients must send, as 'Authorization: Bearer TOKEN'; SIGNWEAVE_TOKEN if not given");
  verb.add_option("--allow-origin", server.allowed_origins,
                  "allow requests from pages of this origin, such as https://signs.example.org; may be repeated")
      ->allow_extra_args(false);
  verb.add_option("--threads", server.threads, "threads that serve connections and streams")
      ->check(within(std::int64_t{1}, std::int64_t{64}))
      ->capture_default_str();
  verb.add_option("--workers", server.workers, "threads that answer calls")
      ->check(within(std::int64_t{1}, std::int64_t{64}))
      ->capture_default_str();
  verb.add_option("--max-connections", server.limits.connections, "connections open at once")
      ->check(within(std::int64_t{1}, std::int64_t{1'000'000}))
      ->capture_default_str();
  verb.add_option("--max-streams", server.limits.streams, "streams open at once")
      ->check(within(std::int64_t{0}, std::int64_t{1'000'000}))
      ->capture_default_str();
  verb.add_option("--max-per-address", server.limits.connections_per_address,
                  "connections per address (0: no limit on loopback, 256 elsewhere)");
  verb.add_option("--requests-per-second", server.limits.requests_per_second,
                  "per address, on average (0: no limit on loopback, 100 elsewhere)")
      ->check(within(0.0, 1e6));
  verb.add_flag("--no-io-uring", options->no_io_uring,
                "send the frames of each stream by a separate system call, as if the kernel did not allow io_uring");
  return [options](Io& io) { run_serve(*options, io); };
}

}  // namespace signweave::cli
