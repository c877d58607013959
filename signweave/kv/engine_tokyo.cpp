#include <fcntl.h>
#include <tchdb.h>
#include <tcutil.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

#include "signweave/kv/engine.h"
#include "signweave/kv/fault.h"
#include "signweave/kv/versioned_store.h"

// A store is one hash database in data.tch and, while it is open for writing, data.tch.wal with the former content of
// the pages that the current change has overwritten.
//
// Tokyo Cabinet's own locks are not used: VersionedStore ensures that no read runs during a change, and with those
// locks every reader would wait while a commit is flushed.

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTokyoFile = "data.tch";
constexpr const char* kLogFile = "data.tch.wal";
// A bucket is a tree, so more entries than buckets do little harm; each bucket takes 8 bytes from the start.
constexpr std::uint32_t kBuckets = 131'071;
constexpr std::uint8_t kAlignmentPower = 4;
constexpr std::uint8_t kFreeBlocksPower = 12;
// The map is only address space. Halved if the system refuses (ulimit -v).
constexpr std::int64_t kTokyoLargestMap = std::int64_t{1} << 40;
constexpr std::int64_t kTokyoSmallestMap = std::int64_t{1} << 28;
constexpr std::size_t kHeadSize = 256;
constexpr std::uint64_t kTokyoEntryHead = 64;  // a record's own head and padding
constexpr std::int32_t kLargestValue = std::numeric_limits<std::int32_t>::max() - (1 << 20);

int size_of(ByteSpan bytes) {
  return static_cast<int>(bytes.size());
}

[[noreturn]] void fail_tokyo(const fs::path& folder, std::string_view doing, int code, int system) {
  switch (code) {
    case TCEMETA:
    case TCERHEAD:
      fail(folder, doing, {ErrorCode::corrupt, "the store is damaged; restore it from a copy"});
    case TCELOCK:
      fail(folder, doing, {ErrorCode::conflict, "another program has the file open; try again when it has finished"});
    case TCEREAD:  // a position outside the file
      if (system == 0) fail(folder, doing, {ErrorCode::corrupt, "the store is damaged; restore it from a copy"});
      [[fallthrough]];
    default:
      fail_system(folder, doing, system != 0 ? system : EIO);
  }
}

/// The byte order of the Tokyo Cabinet build; Debian's is highest first.
enum class ByteOrder { highest_first, lowest_first };

/// The number that all bytes of a field form.
std::uint64_t number_of(ByteSpan field, ByteOrder order) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const std::size_t from = order == ByteOrder::highest_first ? i : field.size() - 1 - i;
    value = value << 8 | std::to_integer<std::uint64_t>(field[from]);
  }
  return value;
}

/// The order in which a field is this number.
ByteOrder order_of(ByteSpan field, std::uint64_t number) {
  return number_of(field, ByteOrder::highest_first) == number ? ByteOrder::highest_first : ByteOrder::lowest_first;
}

/// Rejects a foreign file, and one shorter than its own head says. (If a change must be undone, its size does not match
/// its head yet.)
void check_head(const fs::path& folder) {
  const fs::path path = folder / kTokyoFile;
  Bytes head(kHeadSize);
  std::ifstream file(path, std::ios::binary);
  if (!file) fail_system(folder, "opening the store", errno);
  file.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  const std::uint64_t bytes = size_of_file(folder, kTokyoFile, "opening the store");
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::corrupt, path.string() + ": " + what + "; restore it from a copy");
  };
  if (!file) refuse("the file is cut short (" + std::to_string(bytes) + " bytes)");
  constexpr std::string_view kTokyoMagic = "ToKyO CaBiNeT";
  const auto byte_at = [&](std::size_t at) { return std::to_integer<int>(head[at]); };
  const ByteSpan buckets = ByteSpan(head).subspan(40, 8);
  const ByteOrder order = order_of(buckets, kBuckets);
  if (text_of(head).substr(0, kTokyoMagic.size()) != kTokyoMagic || byte_at(32) != TCDBTHASH ||
      byte_at(34) != kAlignmentPower || byte_at(36) != HDBTLARGE || number_of(buckets, order) != kBuckets) {
    refuse("this is not a Tokyo Cabinet file of signweave");
  }
  const std::uint64_t wanted = number_of(ByteSpan(head).subspan(56, 8), order);
  if (bytes < wanted && !fs::exists(folder / kLogFile)) {
    refuse("the file is cut short (" + std::to_string(bytes) + " bytes of " + std::to_string(wanted) + ")");
  }
}

/// Removes the incomplete last line of a killed writer's log: Tokyo Cabinet would undo the other lines and then
/// continue with the state that it had read before.
void repair_log(const fs::path& folder) {
  const fs::path path = folder / kLogFile;
  std::error_code error;
  const std::uint64_t bytes = fs::file_size(path, error);
  if (error) return;  // there is no log
  std::ifstream file(path, std::ios::binary);
  Bytes head(20);  // the file's size before the change; then per line the position, the length and the bytes
  file.read(reinterpret_cast<char*>(head.data()), 20);
  const ByteOrder order =
      order_of(ByteSpan(head).subspan(16, 4), kHeadSize);  // the first line contains the file's head
  std::uint64_t whole = 8;
  while (whole + 12 <= bytes) {
    file.seekg(static_cast<std::streamoff>(whole + 8));
    if (!file.read(reinterpret_cast<char*>(head.data()), 4)) break;
    const std::uint64_t next = whole + 12 + number_of(ByteSpan(head).first(4), order);
    if (next > bytes) break;
    whole = next;
  }
  if (whole < bytes) fs::resize_file(path, whole, error);
  if (error) fail_system(folder, "undoing unfinished changes", error.value());
}

class TokyoStore final : public PlainStore {
 public:
  TokyoStore(const fs::path& folder, Access access, bool make) : folder_(folder), file_(::tchdbnew()) {
    try {
      open(access, make);
    } catch (...) {
      ::tchdbdel(file_);
      throw;
    }
  }
  ~TokyoStore() override {
    if (changing_) ::tchdbtranabort(file_);
    ::tchdbdel(file_);  // also closes it
  }

  std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const override {
    make_room(buffer, 1);
    for (;;) {
      errno = 0;
      const int room = static_cast<int>(std::min<std::size_t>(buffer.size(), std::numeric_limits<int>::max()));
      const int size = ::tchdbget3(file_, key.data(), size_of(key), buffer.data(), room);
      if (size < 0) {
        need_sound("reading");
        return std::nullopt;
      }
      if (size < room) return ByteSpan(buffer).first(static_cast<std::size_t>(size));
      const int whole = ::tchdbvsiz(file_, key.data(), size_of(key));  // the buffer is full: the value may be longer
      if (whole < 0) need_sound("reading");
      make_room(buffer, static_cast<std::size_t>(whole) + 1);
    }
  }

  bool has(ByteSpan key) const override {
    errno = 0;
    const int size = ::tchdbvsiz(file_, key.data(), size_of(key));
    if (size < 0) need_sound("reading");
    return size >= 0;
  }

  std::uint64_t entries() const override { return ::tchdbrnum(file_); }

  void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const override {
    need(::tchdbiterinit(file_), "reading");
    for (;;) {
      errno = 0;
      int size = 0;
      const std::unique_ptr<void, void (*)(void*)> key(::tchdbiternext(file_, &size), ::tcfree);
      if (!key) break;
      const int value_size = ::tchdbvsiz(file_, key.get(), size);
      if (value_size < 0) break;
      see(ByteSpan(static_cast<const std::byte*>(key.get()), static_cast<std::size_t>(size)),
          static_cast<std::size_t>(value_size));
    }
    need_sound("reading");
  }

  void begin(std::size_t entries, std::uint64_t bytes) override {
    // Tokyo Cabinet writes through a map, and a page for which the disk has no room would kill the process (SIGBUS).
    reserve(folder_, file_->fd, ::tchdbfsiz(file_), bytes + entries * kTokyoEntryHead);
    need(::tchdbtranbegin(file_), "beginning to write");
    changing_ = true;
  }
  void put(ByteSpan key, ByteSpan value) override {
    const void* const data = value.empty() ? "" : static_cast<const void*>(value.data());  // it does not accept null
    need(::tchdbput(file_, key.data(), size_of(key), data, size_of(value)), "writing");
  }
  void erase(ByteSpan key) override { need(::tchdbout(file_, key.data(), size_of(key)), "erasing"); }
  // With HDBOTSYNC Tokyo Cabinet would do all this itself, but it flushes the log once per entry: 512 puts took 97 ms,
  // or 700 ms on a shared disk; this way they take 5. (What HDBOTSYNC would add: in the few milliseconds between a
  // change in the map and the flush of the log below, the system must not write that page out before a power failure.)
  void commit() override {
    need(::fdatasync(file_->walfd) == 0, "committing");  // first the log that can undo the change,
    need(::tchdbmemsync(file_, true), "committing");     // then the change;
    need(::tchdbtrancommit(file_), "committing");        // this ends the change and empties the log,
    changing_ = false;
    need(::fdatasync(file_->walfd) == 0, "committing");  // which must stay empty after a power failure
  }
  void abort() override {
    if (!changing_) return;
    need(::tchdbtranabort(file_), "undoing a change");
    changing_ = false;
    need(::fsync(file_->fd) == 0, "undoing a change");
  }

  bool sound() const noexcept override { return !file_->fatal; }

  void close() override { need(::tchdbsync(file_) && ::tchdbclose(file_), "closing the store"); }

 private:
  void open(Access access, bool make);

  void need(bool done, std::string_view doing) const {
    if (!done) fail_tokyo(folder_, doing, ::tchdbecode(file_), errno);
  }
  /// Distinguishes an error from a missing key. (An error sets `fatal` in the thread that met it, before its call
  /// returns; the error code is shared by all threads.)
  void need_sound(std::string_view doing) const { need(!file_->fatal || ::tchdbecode(file_) == TCENOREC, doing); }

  fs::path folder_;
  TCHDB* file_;
  bool changing_ = false;
};

void TokyoStore::open(Access access, bool make) {
  const std::string path = (folder_ / kTokyoFile).string();
  if (!make) {
    check_head(folder_);
    if (access == Access::read_write) repair_log(folder_);
  }
  std::error_code error;
  ::tchdbtune(file_, kBuckets, kAlignmentPower, kFreeBlocksPower, HDBTLARGE);
  // HDBOTSYNC: a recovery is on disk before the log is removed.
  const int mode = access == Access::read_write ? HDBOWRITER | HDBOTSYNC | (make ? HDBOCREAT : 0) : HDBOREADER;
  // Tokyo Cabinet refuses to open a file twice in a process, which OpenStores prevents, but it also mistakes the parent
  // process's open files for its own.
  ::tcpathunlock(fs::canonical(folder_, error).append(kTokyoFile).c_str());
  for (std::int64_t map = kTokyoLargestMap;; map /= 2) {
    ::tchdbsetxmsiz(file_, map);
    errno = 0;
    if (::tchdbopen(file_, path.c_str(), mode | HDBOLCKNB)) break;
    if (::tchdbecode(file_) != TCEMMAP || errno != ENOMEM || map <= kTokyoSmallestMap) {
      need(false, make ? "making the store" : "opening the store");
    }
  }
  file_->omode &= ~static_cast<std::uint32_t>(HDBOTSYNC);  // from now on `commit` flushes
}

constexpr PlainEngine kTokyo = {
    .name = "tokyo",
    .file = kTokyoFile,
    .logs = kLogFile,
    .version = [] { return std::string(::tcversion); },
    .longest_key = 511,
    .largest_value = kLargestValue,
    .make = [](const fs::path& folder) -> std::unique_ptr<PlainStore> {
      return std::make_unique<TokyoStore>(folder, Access::read_write, true);
    },
    .open = [](const fs::path& folder, Access access, bool) -> std::unique_ptr<PlainStore> {
      return std::make_unique<TokyoStore>(folder, access, false);
    },
};

}  // namespace

void tokyo_create(const fs::path& folder) {
  create_versioned(folder, kTokyo);
}

std::unique_ptr<KvStore> tokyo_open(const fs::path& folder, Access access) {
  return open_versioned(folder, access, kTokyo);
}

void tokyo_compact(const fs::path& folder, const fs::path& compacting,
                   const std::function<void(double fraction)>& progress) {
  compact_versioned(folder, compacting, kTokyo, progress);
}

}  // namespace signweave::kv
