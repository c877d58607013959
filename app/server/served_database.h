#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/calls/characters.h"
#include "signweave/database/database.h"
#include "signweave/live/player.h"

namespace signweave::server {

/// A database that is served, under a name that stands in its URLs. Threads share it.
class ServedDatabase {
 public:
  /// Opened for reading; with `writable` also for changes, and then by no other process.
  ServedDatabase(std::string name, const std::filesystem::path& folder, bool writable);

  const std::string& name() const noexcept { return name_; }
  const Database& database() const noexcept { return database_; }
  SharedSigningCache& signing() noexcept { return signing_; }
  bool writable() const noexcept { return writable_; }
  /// See Database::announce; to be called before anything is served.
  void announce(std::string_view who) noexcept { database_.announce(who); }

  /// Runs one change at a time, beside all readers. Throws Error{unsupported} where it is not writable, and what
  /// `change` throws.
  void change(const std::function<void(Database&)>& change);

  /// As calls::stance_of for a recording of these contents; measured when it is first asked for. Threads may share it.
  std::shared_ptr<const calls::SignerStance> stance(const std::shared_ptr<const Contents>& contents,
                                                    const std::string& recording);

 private:
  std::string name_;
  bool writable_;
  Database database_;
  SharedSigningCache signing_;
  std::mutex changing_;
  std::mutex stances_lock_;
  std::shared_ptr<const Contents> stances_of_;
  std::map<std::string, std::shared_ptr<const calls::SignerStance>> stances_;  ///< by recording, of stances_of_
};

/// A page that draws for this process, and where what it sends back is put.
struct Render {
  std::string id;                ///< nobody else knows it
  std::filesystem::path folder;  ///< must exist
};

/// Every database that is served, and what shows them.
class ServedDatabases {
 public:
  /// The name is the folder's without its ending: "corpus/demo.db" is "demo". Throws Error{bad_input} where two have
  /// one name or a name cannot stand in a URL.
  void add(const std::filesystem::path& folder, bool writable);
  const std::vector<std::unique_ptr<ServedDatabase>>& all() const noexcept { return all_; }
  /// Throws Error{not_found} with near matches.
  ServedDatabase& at(std::string_view name) const;

  // To be set before anything is served.
  calls::Characters characters;  ///< that motions may be shown on
  std::filesystem::path media;   ///< folder of the media that annotations link; empty: none are served
  std::optional<Render> render;

 private:
  std::vector<std::unique_ptr<ServedDatabase>> all_;
};

}  // namespace signweave::server
