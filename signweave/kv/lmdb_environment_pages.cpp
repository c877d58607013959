#include <fcntl.h>
#include <unistd.h>

#include <cstring>
#include <optional>

#include "signweave/kv/lmdb_environment.h"

// The relevant layout of LMDB's file (data version 1, 64 bits):
//   page  u64 number, u16 pad, u16 flags, u16 lower, u16 upper (in an overflow run: u32 pages), u16 offsets of nodes
//   node  u16 low, u16 high, u16 flags, u16 key size, key; in a leaf then the value or the number of its overflow page
//   meta  after a page header: u32 magic, u32 version, u64, u64 map size, two trees of 48 bytes (free list, main) with
//         the root last (the first tree's first u32 is the page size), u64 last page, u64 transaction

namespace signweave::kv {

namespace {

constexpr std::uint32_t kMagic = 0xBEEFC0DE;
constexpr std::uint16_t kBranch = 0x01;
constexpr std::uint16_t kLeaf = 0x02;
constexpr std::uint16_t kBigData = 0x01;
constexpr std::size_t kPageHeader = 16;
constexpr std::size_t kNodeHeader = 8;
constexpr std::uint64_t kNoPage = ~std::uint64_t{0};
constexpr int kDeepest = 32;

template <typename T>
T number_at(const Bytes& page, std::size_t at) {
  T value;
  std::memcpy(&value, page.data() + at, sizeof(T));
  return value;
}

std::optional<Bytes> read_at(int file, std::uint64_t at, std::size_t size) {
  Bytes bytes(size);
  for (std::size_t done = 0; done < size;) {
    const ssize_t got = ::pread(file, bytes.data() + done, size - done, static_cast<off_t>(at + done));
    if (got <= 0) return std::nullopt;
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

struct Walk {
  int file;
  std::size_t page_size;
  std::uint64_t pages;  ///< complete pages in the file

  bool run_inside(std::uint64_t first, std::uint64_t count) const { return first < pages && count <= pages - first; }

  bool tree_inside(std::uint64_t number, int depth) const {
    if (number == kNoPage && depth == 0) return true;  // an empty tree
    if (number >= pages || depth > kDeepest) return false;
    const std::optional<Bytes> page = read_at(file, number * page_size, page_size);
    if (!page) return false;
    const auto flags = number_at<std::uint16_t>(*page, 10);
    const std::size_t lower = number_at<std::uint16_t>(*page, 12);
    if (!(flags & (kBranch | kLeaf)) || lower < kPageHeader || lower > page_size) return false;
    for (std::size_t slot = kPageHeader; slot + 2 <= lower; slot += 2) {
      const std::size_t node = number_at<std::uint16_t>(*page, slot);
      if (node < lower || node + kNodeHeader > page_size) return false;
      const std::uint64_t low = number_at<std::uint32_t>(*page, node);
      const auto node_flags = number_at<std::uint16_t>(*page, node + 4);
      if (flags & kBranch) {
        if (!tree_inside(low | static_cast<std::uint64_t>(node_flags) << 32, depth + 1)) return false;
      } else if (node_flags & kBigData) {
        const std::size_t at = node + kNodeHeader + number_at<std::uint16_t>(*page, node + 6);
        if (at + 8 > page_size) return false;
        const std::uint64_t count = (kPageHeader + low + page_size - 1) / page_size;
        if (!run_inside(number_at<std::uint64_t>(*page, at), count)) return false;
      }
    }
    return true;
  }
};

}  // namespace

bool lmdb_pages_inside(int file, std::uint64_t bytes, std::uint64_t transaction) {
  const std::optional<Bytes> first = read_at(file, 0, 152);
  if (!first) return false;
  const std::size_t page_size = number_at<std::uint32_t>(*first, 40);
  const Walk walk{.file = file, .page_size = page_size, .pages = bytes / page_size};
  for (const std::uint64_t meta : {0, 1}) {
    const std::optional<Bytes> page = read_at(file, meta * page_size, 152);
    if (!page || number_at<std::uint64_t>(*page, 144) != transaction) continue;
    return walk.tree_inside(number_at<std::uint64_t>(*page, 80), 0) &&
           walk.tree_inside(number_at<std::uint64_t>(*page, 128), 0);
  }
  return false;
}

void check_lmdb_header(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "data.mdb";
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail_lmdb(folder, "opening data.mdb", errno);
  const std::optional<Bytes> head = read_at(file, 0, 44);
  const off_t size = ::lseek(file, 0, SEEK_END);
  ::close(file);
  const auto refuse = [&](const char* what) {
    throw Error(ErrorCode::corrupt, path.string() + ": " + what + "; restore it from a copy");
  };
  if (!head) refuse("the file is cut short");
  if (number_at<std::uint32_t>(*head, 16) != kMagic) refuse("the file is damaged, or not LMDB's");
  const auto page_size = number_at<std::uint32_t>(*head, 40);
  if (page_size < 512 || page_size > 65'536 || (page_size & (page_size - 1)) != 0) refuse("the file's head is damaged");
  if (size < 2 * static_cast<off_t>(page_size)) refuse("the file is cut short");
}

}  // namespace signweave::kv
