#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/server/api.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/kv/test_folder.h"
#include "tests/demo_database.h"

namespace signweave::server {

using Path = std::vector<std::string>;

/// For tests: an Api over databases of the demo signer, each in its own folder.
class TestApi {
 public:
  /// One database, "demo", with meteo and villes.
  explicit TestApi(bool writable, ApiLimits limits = {}) {
    std::filesystem::copy(made(), folder_ / "demo.db", std::filesystem::copy_options::recursive);
    std::filesystem::create_directory(folder_ / "scratch");
    databases_.add(folder_ / "demo.db", writable);
    api_ = std::make_unique<Api>(databases_, limits, folder_ / "scratch");
  }

  Api& api() { return *api_; }
  /// What is served alongside the databases; to be set before requests.
  ServedDatabases& served() { return databases_; }
  const Database& database() { return databases_.at("demo").database(); }
  std::filesystem::path scratch() const { return folder_ / "scratch"; }

  ApiResponse get(Path path, std::map<std::string, std::string> query = {}) {
    return api_->answer({.method = "GET", .path = std::move(path), .query = std::move(query)});
  }
  ApiResponse send(std::string method, Path path, const nlohmann::json& body = nullptr) {
    ApiRequest request{.method = std::move(method), .path = std::move(path)};
    if (!body.is_null()) {
      request.content_type = "application/json";
      request.body = body.dump();
    }
    return api_->answer(std::move(request));
  }
  ApiResponse put(Path path, std::string body) {
    return api_->answer({.method = "PUT", .path = std::move(path), .body = std::move(body)});
  }

  /// A database of the demo's first two recordings, created once for the whole program.
  static const std::filesystem::path& made() {
    static const kv::TestFolder folder;
    static const std::filesystem::path path = [] {
      copy_demo_database(folder / "demo.db", 2);
      return folder / "demo.db";
    }();
    return path;
  }

 private:
  kv::TestFolder folder_;
  ServedDatabases databases_;
  std::unique_ptr<Api> api_;
};

/// The path of a resource of the database that TestApi serves.
inline Path at(Path rest) {
  Path path = {"databases", "demo"};
  path.insert(path.end(), rest.begin(), rest.end());
  return path;
}

inline nlohmann::json json_in(const ApiResponse& response) {
  return nlohmann::json::parse(response.body);
}

/// Opens an upload and puts these files into it: name and bytes.
inline std::string upload_of(TestApi& api, const std::vector<std::pair<std::string, std::string>>& files) {
  std::string id = json_in(api.send("POST", at({"uploads"})))["upload"];
  for (const auto& [name, body] : files) EXPECT_EQ(api.put(at({"uploads", id, "files", name}), body).status, 200);
  return id;
}

/// Waits until a job has ended.
inline nlohmann::json wait_for(TestApi& api, const std::string& job) {
  for (int i = 0; i < 6'000; ++i) {
    nlohmann::json state = json_in(api.get({"jobs", job}));
    if (state["state"] != "waiting" && state["state"] != "running") return state;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return "a job that does not end";
}

/// The error of an answer, "404 not_found: …".
inline std::string fault_of(const ApiResponse& response) {
  const nlohmann::json error = json_in(response).at("error");
  return std::to_string(response.status) + " " + error.at("code").get<std::string>() + ": " +
         error.at("message").get<std::string>();
}

inline std::string header_of(const ApiResponse& response, const std::string& name) {
  for (const auto& [of, value] : response.headers) {
    if (of == name) return value;
  }
  return {};
}

}  // namespace signweave::server
