#include <algorithm>
#include <string>
#include <vector>

#include "signweave/kv/fault.h"
#include "signweave/kv/files.h"
#include "signweave/kv/store_lock.h"
#include "signweave/kv/versioned_store.h"

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPuts = 512;
constexpr std::size_t kMostBytes = std::size_t{16} << 20;

/// Copies every entry and reads it back.
void copy(const PlainStore& from, PlainStore& to, const fs::path& folder,
          const std::function<void(double fraction)>& progress) {
  std::vector<std::string> keys;
  from.visit([&](ByteSpan key, std::size_t) { keys.emplace_back(text_of(key)); });
  if (keys.size() != from.entries()) {
    fail(folder, "compacting the store",
         {ErrorCode::corrupt, "the number of its entries differs from its count; restore it from a copy"});
  }
  std::vector<Bytes> values;
  std::size_t bytes = 0, begin = 0;
  Bytes buffer;
  const auto flush = [&](std::size_t end) {
    to.begin(values.size(), bytes);
    for (std::size_t i = begin; i < end; ++i) to.put(bytes_of(keys[i]), values[i - begin]);
    to.finish();
    to.commit();
    for (std::size_t i = begin; i < end; ++i) {
      const std::optional<ByteSpan> back = to.get(bytes_of(keys[i]), buffer);
      if (back && std::ranges::equal(*back, values[i - begin])) continue;
      fail(folder, "compacting the store",
           {ErrorCode::io,
            "the new file does not read back as it was written; the old one is unchanged, check memory and disk"});
    }
    if (progress) progress(static_cast<double>(end) / static_cast<double>(keys.size()));
    values.clear();
    bytes = 0;
    begin = end;
  };
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::optional<ByteSpan> value = from.get(bytes_of(keys[i]), buffer);
    if (!value)
      fail(folder, "compacting the store", {ErrorCode::corrupt, "an entry cannot be read; see signweave check"});
    values.emplace_back(value->begin(), value->end());
    bytes += keys[i].size() + value->size();
    if (values.size() >= kMostPuts || bytes >= kMostBytes) flush(i + 1);
  }
  if (!values.empty()) flush(keys.size());
}

/// Removes the engine's other files, which are useless once the main file was closed in order.
void drop_logs(const fs::path& folder, const PlainEngine& engine) {
  std::vector<fs::path> logs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with(engine.logs)) logs.push_back(entry.path());
  }
  std::error_code error;
  for (const fs::path& path : logs) {
    fs::remove(path, error);
    if (error) fail_system(folder, "compacting the store", error.value());
  }
}

}  // namespace

void compact_versioned(const fs::path& folder, const fs::path& compacting, const PlainEngine& engine,
                       const std::function<void(double fraction)>& progress) {
  StoreLock lock(folder, Access::read_write);  // a lock of an open file: also excludes this process
  if (!lock.closed_in_order()) {
    engine.open(folder, Access::read_write, false)->close();  // undoes unfinished changes
    lock.mark(true);
  }
  {
    const std::unique_ptr<PlainStore> from = engine.open(folder, Access::read_only, true);
    const std::unique_ptr<PlainStore> to = engine.make(compacting);
    copy(*from, *to, folder, progress);
    to->close();
  }
  sync_file(compacting / engine.file);
  // After an orderly close neither the old nor the new file needs a log, but the new file must not be used with the old
  // one's log.
  drop_logs(folder, engine);
  std::error_code error;
  fs::rename(compacting / engine.file, folder / engine.file, error);
  if (error) fail_system(folder, "compacting the store", error.value());
}

}  // namespace signweave::kv
