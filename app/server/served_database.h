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

#include "signweave/calls/characters.h"
#include "signweave/database/database.h"
#include "signweave/live/player.h"

namespace signweave::server {

/// A served database, with the name used in its URLs. Thread-safe.
class ServedDatabase {
 public:
  /// Opened for reading; with `writable` also for changes, which excludes changes by other processes.
  ServedDatabase(std::string name, const std::filesystem::path& folder, bool writable);

  const std::string& name() const noexcept { return name_; }
  const Database& database() const noexcept { return database_; }
  SharedSigningCache& signing() noexcept { return signing_; }
  bool writable() const noexcept { return writable_; }
  /// See Database::announce; to be called before anything is served.
  void announce(std::string_view who) noexcept { database_.announce(who); }

  /// Runs one change at a time, concurrently with all readers. Throws Error{unsupported} if it is not writable, and
  /// what `change` throws.
  void change(const std::function<void(Database&)>& change);

  /// As calls::stance_of for a recording with these contents; computed on first use. Thread-safe.
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
  std::map<std::string, std::shared_ptr<const calls::SignerStance>>
      stances_;  ///< by recording, for the contents stances_of_
};

/// A page that draws for this process, and the folder for what it sends back.
struct Render {
  std::string id;                ///< known only to the page
  std::filesystem::path folder;  ///< must exist
};

/// All served databases, and what is served alongside them.
class ServedDatabases {
 public:
  /// The name is that of the folder without its extension: "corpus/demo.db" is "demo". Throws Error{bad_input} if two
  /// have the same name or a name cannot be used in a URL.
  void add(const std::filesystem::path& folder, bool writable);
  const std::vector<std::unique_ptr<ServedDatabase>>& all() const noexcept { return all_; }
  /// Throws Error{not_found} with near matches.
  ServedDatabase& at(std::string_view name) const;

  // To be set before anything is served.
  calls::Characters characters;  ///< on which motions may be shown
  std::filesystem::path media;   ///< folder of the media that annotations link to; empty: none are served
  std::optional<Render> render;

 private:
  std::vector<std::unique_ptr<ServedDatabase>> all_;
};

}  // namespace signweave::server
