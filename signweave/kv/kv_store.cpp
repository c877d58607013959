#include "signweave/kv/kv_store.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "signweave/core/text.h"
#include "signweave/kv/engine.h"

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

/// A new engine is one row here, the default first; the tests run over every row by themselves.
constexpr std::array kEngines = {
    Engine{.name = "lmdb", .recognises = lmdb_recognises, .create = lmdb_create, .open = lmdb_open},
};

[[noreturn]] void fail_io(const fs::path& folder, const std::error_code& error) {
  throw Error(ErrorCode::io, folder.string() + ": " + error.message() + "; check the path and its permissions");
}

}  // namespace

std::vector<std::string> engines() {
  std::vector<std::string> names;
  for (const Engine& engine : kEngines) names.emplace_back(engine.name);
  return names;
}

void create(const fs::path& folder, std::string_view engine) {
  const auto row = std::find_if(kEngines.begin(), kEngines.end(), [&](const Engine& e) { return e.name == engine; });
  if (row == kEngines.end()) {
    std::string known;
    for (const std::string& name : engines()) known += (known.empty() ? "" : ", ") + name;
    throw Error(ErrorCode::unsupported,
                folder.string() + ": no storage engine '" + printable(engine) + "'; this build has " + known);
  }
  std::error_code error;
  const bool made = fs::create_directories(folder, error);
  if (error && !fs::is_directory(folder)) fail_io(folder, error);
  const bool empty = fs::is_empty(folder, error);
  if (error) fail_io(folder, error);
  if (!empty) {
    throw Error(ErrorCode::already_exists, folder.string() + ": the folder is not empty; name a new or an empty one");
  }
  try {
    row->create(folder);
  } catch (...) {
    // The folder was empty, so whatever is in it now is half a store of ours.
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) fs::remove(entry.path(), error);
    if (made) fs::remove(folder, error);
    throw;
  }
}

std::unique_ptr<KvStore> open(const fs::path& folder, Access access) {
  for (const Engine& engine : kEngines) {
    if (engine.recognises(folder)) return engine.open(folder, access);
  }
  throw Error(ErrorCode::not_found, folder.string() + ": no signweave database (make one with 'signweave create')");
}

}  // namespace signweave::kv
