#include "app/server/static_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <utility>

namespace signweave::server {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 24> kTypes = {{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".wasm", "application/wasm"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".jpeg", "image/jpeg"},
    {".webp", "image/webp"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".woff", "font/woff"},
    {".glb", "model/gltf-binary"},
    {".gltf", "model/gltf+json"},
    {".webm", "video/webm"},
    {".mp4", "video/mp4"},
    {".txt", "text/plain; charset=utf-8"},
    {".md", "text/markdown; charset=utf-8"},
    {".csv", "text/csv; charset=utf-8"},
    {".bvh", "text/plain; charset=utf-8"},
    {".eaf", "application/xml"},
}};

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int get() const noexcept { return value_; }
  int release() noexcept { return std::exchange(value_, -1); }

 private:
  int value_;
};

constexpr int kOpenFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

/// As open_beneath, for kernels older than 5.6: folder by folder, and without any links. A path that ends with a slash
/// names a folder.
int open_without_links(int folder, std::string_view path) {
  Descriptor at(::dup(folder));
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    const std::string name(path.substr(0, slash));
    const bool is_folder = slash != std::string_view::npos;
    path.remove_prefix(is_folder ? slash + 1 : path.size());
    at = Descriptor(::openat(at.get(), name.c_str(), kOpenFlags | O_NOFOLLOW | (is_folder ? O_DIRECTORY : 0)));
    if (at.get() < 0) return -1;
  }
  return at.release();
}

/// Opens `path` beneath the folder: no "..", no link that leads outside.
int open_beneath(int folder, const std::string& path, FollowedLinks links) {
  if (links == FollowedLinks::none) return open_without_links(folder, path);
  open_how how{};
  how.flags = kOpenFlags;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  const auto file =
      static_cast<int>(::syscall(SYS_openat2, folder, path.empty() ? "." : path.c_str(), &how, sizeof how));
  return file < 0 && errno == ENOSYS ? open_without_links(folder, path) : file;
}

StaticFile described(int descriptor, const struct stat& status, std::string_view name) {
  return {.descriptor = descriptor,
          .size = static_cast<std::uint64_t>(status.st_size),
          .content_type = std::string(content_type_of(name)),
          .etag = fmt::format("\"{:x}-{:x}-{:x}\"", status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec),
          .last_modified = http_date(status.st_mtim.tv_sec)};
}

bool read_number(std::string_view text, std::uint64_t& value) {
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && parsed == end;
}

}  // namespace

std::optional<StaticFile> open_plain(const std::filesystem::path& path) {
  Descriptor file(::open(path.c_str(), kOpenFlags));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return described(file.release(), status, path.native());
}

std::optional<ByteRange> range_of(std::string_view header, std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return std::nullopt;
  header.remove_prefix(kUnit.size());
  const std::size_t dash = header.find('-');
  if (dash == header.npos || header.find(',') != header.npos) return std::nullopt;
  const std::string_view first = header.substr(0, dash);
  const std::string_view last = header.substr(dash + 1);
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  if (first.empty()) {  // the last bytes
    if (!read_number(last, end)) return std::nullopt;
    if (end == 0 || size == 0) return ByteRange{};
    return ByteRange{size - std::min(end, size), size};
  }
  if (!read_number(first, begin)) return std::nullopt;
  if (last.empty()) {
    end = size;
  } else {
    if (!read_number(last, end) || end < begin) return std::nullopt;
    end = end < size ? end + 1 : size;
  }
  if (begin >= size) return ByteRange{};
  return ByteRange{begin, end};
}

std::string_view content_type_of(std::string_view name) noexcept {
  for (const auto& [extension, type] : kTypes) {
    if (name.ends_with(extension)) return type;
  }
  return "application/octet-stream";
}

std::string http_date(std::int64_t seconds_since_1970) {
  const std::time_t time = seconds_since_1970;
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  constexpr std::array kDays = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  constexpr std::array kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  return fmt::format("{}, {:02} {} {} {:02}:{:02}:{:02} GMT", kDays[static_cast<std::size_t>(parts.tm_wday)],
                     parts.tm_mday, kMonths[static_cast<std::size_t>(parts.tm_mon)], parts.tm_year + 1900,
                     parts.tm_hour, parts.tm_min, parts.tm_sec);
}

std::optional<StaticFile> open_static(const std::filesystem::path& folder, const std::vector<std::string>& segments,
                                      FollowedLinks links) {
  std::string path;
  for (const std::string& segment : segments) {
    if (segment.starts_with('.') || segment.find_first_of(std::string_view("\\/\0", 3)) != std::string::npos) {
      return std::nullopt;
    }
    if (!path.empty()) path += '/';  // also before an empty segment: "page.html/" is not a page
    path += segment;
  }
  const Descriptor root(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (root.get() < 0) return std::nullopt;
  for (int step = 0; step < 2; ++step) {
    Descriptor file(open_beneath(root.get(), path, links));
    struct stat status {};
    if (file.get() < 0 || ::fstat(file.get(), &status) != 0) return std::nullopt;
    if (S_ISDIR(status.st_mode)) {
      path += path.empty() || path.ends_with('/') ? "index.html" : "/index.html";
      continue;
    }
    if (!S_ISREG(status.st_mode)) return std::nullopt;
    return described(file.release(), status, path);
  }
  return std::nullopt;
}

}  // namespace signweave::server
