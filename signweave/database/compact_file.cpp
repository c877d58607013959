#include "signweave/database/compact_file.h"

#include "signweave/database/writer_lock.h"

namespace signweave {

kv::Compacted compact_file(const std::filesystem::path& folder, const Database::Progress& progress) {
  { const Database whole(folder, kv::Access::read_write); }  // throws unless it is a database; sweeps it
  WriterLock lock(folder);
  lock.announce("signweave compact-file");
  return kv::compact(folder, progress);
}

}  // namespace signweave
