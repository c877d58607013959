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

/// One API call, independent of the network; a connection builds it from an HTTP request.
struct ApiRequest {
  std::string method = "GET";
  std::vector<std::string> path;             ///< decoded segments after /api: {"databases", "demo", "query"}
  std::map<std::string, std::string> query;  ///< decoded; the last value of a repeated name
  std::string content_type;
  std::string
      accept;  ///< the Accept header: its first type may choose the file format that sign, edit and exports return
  std::string body;  ///< complete, within the server's limit
  std::filesystem::path
      body_file;  ///< for an upload: the file where the server has put the body instead; the call moves it away
};

struct ApiResponse {
  int status = 200;
  std::string content_type = "application/json";
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  std::filesystem::path file{};  ///< if not empty, the body is this file, or the requested range of it
};

struct ApiLimits {
  Milliseconds query_time{5'000};              ///< longest time of a query
  std::size_t answers = 100'000;               ///< most answers of a query
  Milliseconds sign_time{30'000};              ///< longest time of any other call, as far as it can be interrupted
  std::size_t glosses = 10'000;                ///< per utterance
  std::int64_t frames = 500'000;               ///< per result: more than an hour at 100 frames per second
  std::uint64_t upload_bytes = 2'000'000'000;  ///< all files of one upload together
  std::size_t uploads = 16;                    ///< open at the same time
  Seconds upload_idle{3'600};                  ///< an unused upload is removed after this time
};

/// Answers every call under /api/ except the WebSocket: routes.h has the table, docs/http.md the description. Never
/// throws: an error is a JSON body {"error": …} with its status. Thread-safe; a call takes as long as its work does, so
/// calls must not run on a thread that streams. Imports run on a thread owned by the Api.
class Api {
 public:
  /// `scratch`: an existing folder for uploads; uploads left in it are removed by the destructor.
  Api(ServedDatabases& databases, ApiLimits limits, const std::filesystem::path& scratch);
  /// Stops a running import if it can be stopped, and waits for it.
  ~Api();
  Api(const Api&) = delete;
  Api& operator=(const Api&) = delete;

  ApiResponse answer(ApiRequest request);
  /// True if the body of such a request is to be put into a file (`body_file`), so that the server need not hold it in
  /// memory.
  bool takes_file(const ApiRequest& request) const;
  /// True if the body is a document that may be larger than a call's parameters: a score.
  bool takes_document(const ApiRequest& request) const;
  /// The error response to a request that no body could make valid: the database is not writable, or there is no such
  /// upload. Nullopt if the body is needed.
  std::optional<ApiResponse> refusal(const ApiRequest& request);
  /// The OpenAPI 3.1 document, which `answer` returns for /api/openapi.json.
  static std::string openapi();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace signweave::server
