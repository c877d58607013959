#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace signweave::server {

/// A file that is served, open.
struct StaticFile {
  int descriptor = -1;  ///< the caller closes it
  std::uint64_t size = 0;
  std::string content_type;
  std::string etag;           ///< of size and time of change, quoted
  std::string last_modified;  ///< as HTTP writes dates
};

/// Which symbolic links below a folder are followed: those that lead to a file of the folder, where the kernel can
/// prove that (Linux 5.6), or none.
enum class FollowedLinks { inside, none };

/// Opens the file of these decoded segments below `folder`; of a folder its index.html. None where there is no such
/// plain file. No path leads outside, and none to hidden files: segments that are "..", that begin with a dot or hold
/// a backslash or NUL are no names here, and the kernel resolves the rest beneath the folder, whatever links lie there.
/// On an older kernel no links are followed.
std::optional<StaticFile> open_static(const std::filesystem::path& folder, const std::vector<std::string>& segments,
                                      FollowedLinks links = FollowedLinks::inside);

/// The same of one plain file, whatever folder it is in.
std::optional<StaticFile> open_plain(const std::filesystem::path& path);

/// What a Range header asks for of `size` bytes.
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;  ///< not part of it; 0: the range is not satisfiable
};
/// One range of bytes (RFC 9110, section 14): "bytes=0-99", "bytes=100-", "bytes=-100". None where the header asks for
/// something else, which may be left unheard.
std::optional<ByteRange> range_of(std::string_view header, std::uint64_t size);

/// By the name's ending; "application/octet-stream" where it tells nothing.
std::string_view content_type_of(std::string_view name) noexcept;

/// "Sun, 06 Nov 1994 08:49:37 GMT"
std::string http_date(std::int64_t seconds_since_1970);

}  // namespace signweave::server
