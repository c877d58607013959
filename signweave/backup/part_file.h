#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "signweave/core/atomic_file.h"
#include "signweave/core/bytes.h"
#include "signweave/core/running_checksum.h"

/// Files of a backup that hold records of a store, drawn in docs/store.md. Internal to `backup`.
namespace signweave::backup_files {

/// What must be known of a whole file to tell that it is the one that was written.
struct Stamp {
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;  ///< XXH3-64 of all of them
  friend bool operator==(const Stamp&, const Stamp&) = default;
};

/// Writes a part, which appears whole at `commit` or not at all. Throws Error{io}.
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

/// Empty where the file is the one with this stamp, else what is wrong with it; reads every byte.
std::string fault_of_part(const std::filesystem::path& path, const Stamp& stamp);

/// Calls see(key, value) for each record of a part, in the order in which they were added; what it is given is valid
/// until it returns. Throws Error{corrupt} where the file is none, or ends within a record, and Error{io}.
void read_part(const std::filesystem::path& path, const std::function<void(ByteSpan key, ByteSpan value)>& see);

}  // namespace signweave::backup_files
