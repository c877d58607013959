#include "app/server/api.h"

namespace signweave::server {

// The thinnest path: the list of databases.

struct Api::State {
  ServedDatabases& databases;
};
Api::Api(ServedDatabases& databases, ApiLimits, std::filesystem::path) : state_(new State{databases}) {}
Api::~Api() = default;
bool Api::takes_file(const ApiRequest&) const {
  return false;
}
std::string Api::openapi() {
  return "{}";
}
ApiResponse Api::answer(ApiRequest request) {
  if (request.path == std::vector<std::string>{"databases"}) {
    std::string names;
    for (const auto& one : state_->databases.all()) names += (names.empty() ? "\"" : ", \"") + one->name() + "\"";
    return {
        .status = 200, .content_type = "application/json", .headers = {}, .body = "{\"databases\": [" + names + "]}\n"};
  }
  return {.status = 404, .content_type = "application/json", .headers = {}, .body = "{\"error\": \"no such call\"}\n"};
}

}  // namespace signweave::server
