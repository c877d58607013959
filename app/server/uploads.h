#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "app/server/answers.h"
#include "signweave/core/time.h"

namespace signweave::server {

/// Files that clients send before importing them: each upload is a subfolder of the scratch folder. Thread-safe.
class Uploads {
 public:
  /// Removes `folder` with what an earlier server left in it; it is created again for the first upload.
  Uploads(std::filesystem::path folder, std::size_t most, std::uint64_t most_bytes, Seconds idle);
  ~Uploads();
  Uploads(const Uploads&) = delete;
  Uploads& operator=(const Uploads&) = delete;

  /// Opens an upload for a database and returns its id. If the limit is reached, the upload unused for longest is
  /// removed if it was unused for at least a sixth of the idle time, because pages are closed without notice. Otherwise
  /// throws StatusError 503.
  std::string open(const std::string& database);
  /// Adds a file: `from` is moved if given, else `body` is written. Replaces a file of the same name. Throws
  /// Error{not_found}, Error{bad_input} if the name is not a plain file name, StatusError 413, Error{conflict} while
  /// the upload is being imported.
  UploadedFile put(const std::string& database, const std::string& id, const std::string& name,
                   const std::filesystem::path& from, std::string_view body);
  /// Removes one file of the upload. Throws Error{not_found}, Error{conflict} while the upload is being imported.
  void take_away(const std::string& database, const std::string& id, const std::string& name);
  /// Throws what `put` would throw, except for sizes: for a check before a long file is sent.
  void require_open(const std::string& database, const std::string& id, const std::string& name) const;
  UploadAnswer describe(const std::string& database, const std::string& id) const;
  /// Removes the upload. Throws Error{not_found}, Error{conflict} while it is being imported.
  void discard(const std::string& database, const std::string& id);
  /// The folder, for an import: the upload cannot be changed until `release`. Throws Error{not_found}, Error{conflict}.
  std::filesystem::path hold(const std::string& database, const std::string& id);
  /// The folder, for reading its files, which may be changed or removed meanwhile; a reader that has a replaced file
  /// open continues to read the old one. Throws Error{not_found}.
  std::filesystem::path look(const std::string& database, const std::string& id);
  /// To be called after an import; with `remove` the upload is removed.
  void release(const std::string& id, bool remove);
  /// Removes uploads that were unused for the idle time.
  void sweep();

  /// Throws Error{bad_input} if `name` is not a plain file name: path separators, control characters, ':', a leading
  /// dot, invalid UTF-8, more than 200 bytes.
  static void require_plain(std::string_view name);
  /// Throws Error{unsupported} for a file that no import can use, such as a picture, judging by its extension.
  static void require_readable(const std::string& name);

 private:
  struct Upload {
    std::string database;
    std::filesystem::path folder;
    std::map<std::string, std::uint64_t> files;  ///< bytes
    std::chrono::steady_clock::time_point touched;
    bool held = false;
  };

  void make_room();
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
