#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "app/server/api.h"
#include "signweave/database/database.h"
#include "signweave/database/test_recording.h"

using namespace signweave;

namespace {

/// A server with two databases of one small recording: one read-only, one writable.
struct Served {
  kv::TestFolder folder;
  server::ServedDatabases databases;
  std::unique_ptr<server::Api> api;
  std::uint64_t entries = 0;

  Served() {
    for (const char* name : {"fixed.db", "open.db"}) {
      Database::create(folder / name, {});
      Database database(folder / name, kv::Access::read_write);
      database.put(testing_database::small_recording("a", 1, {"VANNES", "LE MANS", "VANNES"}, 130));
    }
    std::filesystem::create_directory(folder / "scratch");
    databases.add(folder / "fixed.db", false);
    databases.add(folder / "open.db", true);
    api = std::make_unique<server::Api>(databases,
                                        server::ApiLimits{.query_time = Milliseconds(1'000),
                                                          .sign_time = Milliseconds(1'000),
                                                          .glosses = 20,
                                                          .frames = 2'000,
                                                          .upload_bytes = 100'000},
                                        folder / "scratch");
    entries = databases.at("fixed").database().engine().entries;
  }
};

/// Takes the next line off the input.
std::string_view line_of(std::string_view& input) {
  const std::size_t end = std::min(input.find('\n'), input.size());
  const std::string_view line = input.substr(0, end);
  input.remove_prefix(std::min(end + 1, input.size()));
  return line;
}

}  // namespace

/// Every request is answered with a status and, for an error, with JSON that describes it; the call never throws, and a
/// database served read-only stays unchanged. The input is lines METHOD, PATH with segments separated by '/',
/// NAME=VALUE pairs separated by '&', CONTENT-TYPE, and then the body.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Served served;
  std::string_view input(reinterpret_cast<const char*>(data), size);
  server::ApiRequest request;
  request.method = std::string(line_of(input));
  for (std::string_view path = line_of(input); !path.empty();) {
    const std::size_t end = std::min(path.find('/'), path.size());
    request.path.emplace_back(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  for (std::string_view query = line_of(input); !query.empty();) {
    const std::string_view pair = query.substr(0, std::min(query.find('&'), query.size()));
    const std::size_t equals = std::min(pair.find('='), pair.size());
    request.query[std::string(pair.substr(0, equals))] = std::string(pair.substr(std::min(equals + 1, pair.size())));
    query.remove_prefix(std::min(pair.size() + 1, query.size()));
  }
  request.content_type = std::string(line_of(input));
  request.body = std::string(input);
  const server::ApiResponse response = served.api->answer(request);
  if (response.status < 200 || response.status > 599) std::abort();
  if (response.status >= 400 && response.body.find("\"error\"") == std::string::npos) std::abort();
  const Database& fixed = served.databases.at("fixed").database();
  if (fixed.engine().entries != served.entries || fixed.contents()->recordings.size() != 1) std::abort();
  return 0;
}
