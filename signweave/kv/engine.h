#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "signweave/kv/kv_store.h"

/// Inside this module only: what an engine must offer to stand in the table of kv_store.cpp.
namespace signweave::kv {

/// One row of the engine table.
struct Engine {
  std::string_view name;
  /// True where the folder holds files of this engine.
  bool (*recognises)(const std::filesystem::path& folder);
  /// Makes an empty store in a folder that exists and is empty.
  void (*create)(const std::filesystem::path& folder);
  /// Opens a store that `recognises` said yes to.
  std::unique_ptr<KvStore> (*open)(const std::filesystem::path& folder, Access access);
};

bool lmdb_recognises(const std::filesystem::path& folder);
void lmdb_create(const std::filesystem::path& folder);
std::unique_ptr<KvStore> lmdb_open(const std::filesystem::path& folder, Access access);

}  // namespace signweave::kv
