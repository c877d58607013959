#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/server/served_database.h"

namespace signweave::server {

/// One call, free of the network: what a server's connection makes of an HTTP request.
struct ApiRequest {
  std::string method = "GET";
  std::vector<std::string> path;             ///< decoded segments after /api: {"databases", "demo", "query"}
  std::map<std::string, std::string> query;  ///< decoded; of a name that comes twice the last
  std::string content_type;
  std::string accept;  ///< the Accept header: its first type may say which file sign, edit and exports give
  std::string body;    ///< whole, within the server's limit
  std::filesystem::path body_file;  ///< of an upload: where the server has put the body instead; the call takes it away
};

struct ApiResponse {
  int status = 200;
  std::string content_type = "application/json";
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  std::filesystem::path file{};  ///< where it is given, the body is this file, or the part of it that was asked for
};

struct ApiLimits {
  Milliseconds query_time{5'000};              ///< a query takes no longer
  std::size_t answers = 100'000;               ///< a query gives no more
  Milliseconds sign_time{30'000};              ///< nor any other call, as far as it can be stopped
  std::size_t glosses = 10'000;                ///< of one utterance
  std::int64_t frames = 500'000;               ///< of one result: above an hour at 100 frames a second
  std::uint64_t upload_bytes = 2'000'000'000;  ///< of all files of one upload
  std::size_t uploads = 16;                    ///< open at once
  Seconds upload_idle{3'600};                  ///< an upload that nobody touches goes away after so long
};

/// Answers every call under /api/ but the WebSocket: routes.h has the table, docs/http.md the description. Never
/// throws: a fault is a JSON body {"error": …} with its status. Calls may come from several threads at once; each takes
/// as long as its work does, so they must not run on a thread that streams. Imports run on a thread of the Api's own.
class Api {
 public:
  /// `scratch`: a folder for uploads, which must exist; what is left there is removed at the end.
  Api(ServedDatabases& databases, ApiLimits limits, const std::filesystem::path& scratch);
  /// Waits for a running import, or stops it where it can be.
  ~Api();
  Api(const Api&) = delete;
  Api& operator=(const Api&) = delete;

  ApiResponse answer(ApiRequest request);
  /// True where the body of such a request belongs in a file (`body_file`): the server need not hold it.
  bool takes_file(const ApiRequest& request) const;
  /// True where the body is a document that may be larger than a call's parameters: a score.
  bool takes_document(const ApiRequest& request) const;
  /// The answer to a request whose body need not come, for no body could make it good: the database is not writable,
  /// there is no such upload. None where the body is wanted.
  std::optional<ApiResponse> refusal(const ApiRequest& request);
  /// The OpenAPI 3.1 document, which `answer` gives at /api/openapi.json.
  static std::string openapi();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace signweave::server
