#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include "signweave/kv/kv_store.h"

/// Internal to this module: the interface of an engine in the table of kv_store.cpp.
namespace signweave::kv {

/// One row of the engine table.
struct Engine {
  std::string_view name;
  std::string_view file;  ///< its main file, by which its folder is recognised
  /// Creates an empty store in an existing empty folder. Null if this build lacks the engine.
  void (*create)(const std::filesystem::path& folder);
  /// Opens a store whose main file exists.
  std::unique_ptr<KvStore> (*open)(const std::filesystem::path& folder, Access access);
  /// Rewrites the main file without free space; `compacting` is an empty subfolder of `folder` for the new file.
  void (*compact)(const std::filesystem::path& folder, const std::filesystem::path& compacting,
                  const std::function<void(double fraction)>& progress);
};

void lmdb_create(const std::filesystem::path& folder);
std::unique_ptr<KvStore> lmdb_open(const std::filesystem::path& folder, Access access);
void lmdb_compact(const std::filesystem::path& folder, const std::filesystem::path& compacting,
                  const std::function<void(double fraction)>& progress);

void berkeley_create(const std::filesystem::path& folder);
std::unique_ptr<KvStore> berkeley_open(const std::filesystem::path& folder, Access access);
void berkeley_compact(const std::filesystem::path& folder, const std::filesystem::path& compacting,
                      const std::function<void(double fraction)>& progress);

void tokyo_create(const std::filesystem::path& folder);
std::unique_ptr<KvStore> tokyo_open(const std::filesystem::path& folder, Access access);
void tokyo_compact(const std::filesystem::path& folder, const std::filesystem::path& compacting,
                   const std::function<void(double fraction)>& progress);

}  // namespace signweave::kv
