#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "signweave/core/atomic_file.h"
#include "signweave/core/bytes.h"
#include "signweave/core/running_checksum.h"

/// The files of a backup that hold records of a store, drawn in docs/store.md. Internal to `backup`.
namespace signweave::backup_files {

/// Identifies the content of a whole file, to verify that it is as written.
struct Stamp {
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;  ///< XXH3-64 of all bytes
  friend bool operator==(const Stamp&, const Stamp&) = default;
};

/// Writes a part, which `commit` creates atomically. Throws Error{io}.
class PartWriter {
 public:
  explicit PartWriter(const std::filesystem::path& path);
  void add(ByteSpan key, ByteSpan value);
  Stamp commit();

 private:
  void write(ByteSpan bytes);

  AtomicFile file_;
  RunningChecksum checksum_;
  std::uint64_t bytes_ = 0;
};

/// Returns what is wrong with a file, or "" if it matches the stamp; reads every byte.
std::string fault_of_part(const std::filesystem::path& path, const Stamp& stamp);

/// Calls see(key, value) for each record of a part, in the order in which they were added; the spans are valid until it
/// returns. Throws Error{corrupt} if the file is not a part or ends within a record, and Error{io}.
void read_part(const std::filesystem::path& path, const std::function<void(ByteSpan key, ByteSpan value)>& see);

}  // namespace signweave::backup_files
