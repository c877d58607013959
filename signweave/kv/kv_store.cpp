#include "signweave/kv/kv_store.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "signweave/core/text.h"
#include "signweave/kv/engine.h"
#include "signweave/kv/files.h"

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

/// A new engine is one row here, the default first; the tests run over all rows automatically. An engine that this
/// build lacks has a row with name and file, so that the error can name it.
constexpr std::array kEngines = {
    Engine{.name = "lmdb", .file = "data.mdb", .create = lmdb_create, .open = lmdb_open, .compact = lmdb_compact},
#if SIGNWEAVE_BERKELEY
    Engine{.name = "berkeley",
           .file = "data.bdb",
           .create = berkeley_create,
           .open = berkeley_open,
           .compact = berkeley_compact},
#else
    Engine{.name = "berkeley", .file = "data.bdb", .create = nullptr, .open = nullptr, .compact = nullptr},
#endif
#if SIGNWEAVE_TOKYO
    Engine{.name = "tokyo", .file = "data.tch", .create = tokyo_create, .open = tokyo_open, .compact = tokyo_compact},
#else
    Engine{.name = "tokyo", .file = "data.tch", .create = nullptr, .open = nullptr, .compact = nullptr},
#endif
};

std::string known_engines() {
  std::string text;
  for (const std::string& name : engines()) text += (text.empty() ? "" : ", ") + name;
  return text;
}

[[noreturn]] void fail_lacking(const fs::path& folder, std::string_view engine) {
  throw Error(ErrorCode::unsupported, folder.string() + ": its storage engine '" + std::string(engine) +
                                          "' was left out of this build, which has " + known_engines() +
                                          "; use a build that has it");
}

[[noreturn]] void fail_io(const fs::path& folder, const std::error_code& error) {
  throw Error(ErrorCode::io, folder.string() + ": " + error.message() + "; check the path and its permissions");
}

}  // namespace

std::vector<std::string> engines() {
  std::vector<std::string> names;
  for (const Engine& engine : kEngines) {
    if (engine.create) names.emplace_back(engine.name);
  }
  return names;
}

void create(const fs::path& folder, std::string_view engine) {
  const auto row = std::find_if(kEngines.begin(), kEngines.end(), [&](const Engine& e) { return e.name == engine; });
  if (row == kEngines.end()) {
    throw Error(ErrorCode::unsupported,
                folder.string() + ": no storage engine '" + printable(engine) + "'; this build has " + known_engines());
  }
  if (!row->create) fail_lacking(folder, row->name);
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
    sync_folder(folder);
    sync_folder(fs::absolute(folder).parent_path());
  } catch (...) {
    // The folder was empty before, so its present content is an unfinished store.
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) fs::remove(entry.path(), error);
    if (made) fs::remove(folder, error);
    throw;
  }
}

namespace {

constexpr const char* kCompacting = "compacting";

/// The engine whose main file is in the folder. Throws Error{not_found, corrupt, unsupported}.
const Engine& engine_of(const fs::path& folder) {
  for (const Engine& engine : kEngines) {
    std::error_code error;
    if (!fs::is_regular_file(folder / engine.file, error)) continue;
    if (!engine.open) fail_lacking(folder, engine.name);
    return engine;
  }
  for (const char* const left : {"writer.lock", "engine.lock", "lock.mdb"}) {
    if (!fs::exists(folder / left)) continue;
    throw Error(ErrorCode::corrupt, folder.string() +
                                        ": a signweave database whose data file is missing (data.mdb, "
                                        "data.bdb or data.tch); restore it from a copy");
  }
  throw Error(ErrorCode::not_found, folder.string() + ": no signweave database (make one with 'signweave create')");
}

}  // namespace

std::unique_ptr<KvStore> open(const fs::path& folder, Access access) {
  return engine_of(folder).open(folder, access);
}

Compacted compact(const fs::path& folder, const std::function<void(double fraction)>& progress) {
  const Engine& engine = engine_of(folder);
  const std::uint64_t before = bytes_in(folder);
  drop_unfinished(folder);
  std::error_code error;
  fs::create_directory(folder / kCompacting, error);
  if (error) fail_io(folder / kCompacting, error);
  try {
    engine.compact(folder, folder / kCompacting, progress);
  } catch (...) {
    drop_unfinished(folder);
    throw;
  }
  drop_unfinished(folder);
  sync_folder(folder);
  return {before, bytes_in(folder)};
}

void drop_unfinished(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder / kCompacting, ignored);
}

}  // namespace signweave::kv
