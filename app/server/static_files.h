#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace signweave::server {

/// An open file to be served.
struct StaticFile {
  int descriptor = -1;  ///< the caller closes it
  std::uint64_t size = 0;
  std::string content_type;
  std::string etag;           ///< from size and modification time, quoted
  std::string last_modified;  ///< as an HTTP date
};

/// Which symbolic links below a folder are followed: those to a file within the folder, if the kernel can verify that
/// (Linux 5.6), or none.
enum class FollowedLinks { inside, none };

/// Opens the file at these decoded segments below `folder`; for a folder its index.html. Nullopt if there is no such
/// regular file. No path leads outside, and none to hidden files: segments that are "..", begin with a dot or contain a
/// backslash or NUL are refused, and the kernel resolves the rest beneath the folder, whatever links it contains. On an
/// older kernel no links are followed.
std::optional<StaticFile> open_static(const std::filesystem::path& folder, const std::vector<std::string>& segments,
                                      FollowedLinks links = FollowedLinks::inside);

/// The same for one regular file in any folder.
std::optional<StaticFile> open_plain(const std::filesystem::path& path);

/// The bytes of `size` that a Range header requests.
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;  ///< exclusive; 0: the range is not satisfiable
};
/// Parses one range of bytes (RFC 9110, section 14): "bytes=0-99", "bytes=100-", "bytes=-100". Nullopt if the header
/// requests anything else, which may be ignored.
std::optional<ByteRange> range_of(std::string_view header, std::uint64_t size);

/// By the name's extension; "application/octet-stream" if that is unknown.
std::string_view content_type_of(std::string_view name) noexcept;

/// "Sun, 06 Nov 1994 08:49:37 GMT"
std::string http_date(std::int64_t seconds_since_1970);

}  // namespace signweave::server
