#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "signweave/core/time.h"

namespace signweave::server {

/// Files that clients send before they import them: each upload is a folder of the scratch folder. Threads may share
/// it.
class Uploads {
 public:
  /// Removes what an earlier server left in `folder`, which it makes.
  Uploads(std::filesystem::path folder, std::size_t most, std::uint64_t most_bytes, Seconds idle);
  ~Uploads();
  Uploads(const Uploads&) = delete;
  Uploads& operator=(const Uploads&) = delete;

  /// A new upload for a database. Where there are as many as may be, the one that nobody touched for longest gives way,
  /// if that is a sixth of the idle time: pages are closed without a word. Else throws StatusError 503.
  std::string open(const std::string& database);
  /// Takes a file: `from` is moved where it is given, else `body` is written. Takes the place of a file of the same
  /// name. Throws Error{not_found}, Error{bad_input} for what is no plain file name, StatusError 413, Error{conflict}
  /// while it is imported.
  nlohmann::json put(const std::string& database, const std::string& id, const std::string& name,
                     const std::filesystem::path& from, std::string_view body);
  /// Removes one file of it. Throws Error{not_found}, Error{conflict} while it is imported.
  void take_away(const std::string& database, const std::string& id, const std::string& name);
  /// Throws what `put` would, but for sizes: asked before a long file is sent.
  void require_open(const std::string& database, const std::string& id, const std::string& name) const;
  nlohmann::json describe(const std::string& database, const std::string& id) const;
  /// Removes it. Throws Error{not_found}, Error{conflict} while it is imported.
  void discard(const std::string& database, const std::string& id);
  /// The folder, for an import: until `release` nobody changes it. Throws Error{not_found}, Error{conflict}.
  std::filesystem::path hold(const std::string& database, const std::string& id);
  /// The folder, for a look at its files, which may be changed and removed meanwhile; of a file that another takes the
  /// place of whoever has it open reads the old one. Throws Error{not_found}.
  std::filesystem::path look(const std::string& database, const std::string& id);
  /// After an import; with `remove` its files go.
  void release(const std::string& id, bool remove);
  /// Removes uploads that nobody touched for the idle time.
  void sweep();

  /// Throws Error{bad_input} where `name` is no plain file name: parts, controls, a leading dot, no UTF-8, 200 bytes.
  static void require_plain(std::string_view name);
  /// Throws Error{unsupported} for a file of which no import has any use, such as a picture, by its name's ending.
  static void require_readable(const std::string& name);

 private:
  struct Upload {
    std::string database;
    std::filesystem::path folder;
    std::map<std::string, std::uint64_t> files;  ///< bytes
    std::chrono::steady_clock::time_point touched;
    bool held = false;
  };

  void give_way();
  Upload& at(const std::string& database, const std::string& id);
  const Upload& at(const std::string& database, const std::string& id) const;
  const Upload& at_open(const std::string& database, const std::string& id) const;
  void remove(std::map<std::string, Upload>::iterator upload);

  std::filesystem::path folder_;
  std::size_t most_;
  std::uint64_t most_bytes_;
  Seconds idle_;
  mutable std::mutex mutex_;
  std::map<std::string, Upload> uploads_;
};

}  // namespace signweave::server
