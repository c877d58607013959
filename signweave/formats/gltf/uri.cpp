#include "signweave/formats/gltf/uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::gltf {
namespace {

[[noreturn]] void refuse_uri(const std::string& place, const std::string& what) {
  throw Error(ErrorCode::bad_input, fmt::format("{}: {}", place, what));
}

/// The six bits of a base64 character; negative for any other.
int six_bits(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string percent_decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool coded =
        text[i] == '%' && text.size() - i > 2 && hexadecimal(text[i + 1]) >= 0 && hexadecimal(text[i + 2]) >= 0;
    result += coded ? static_cast<char>(16 * hexadecimal(text[i + 1]) + hexadecimal(text[i + 2])) : text[i];
    if (coded) i += 2;
  }
  return result;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return fold_case(uri.substr(0, 5)) == "data:";
}

std::string data_of_uri(const std::string& place, std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == uri.npos || !uri.substr(0, comma).ends_with(";base64")) {
    refuse_uri(place, "its data is not in base64; export the file again");
  }
  std::string_view coded = uri.substr(comma + 1);
  while (coded.ends_with('=')) coded.remove_suffix(1);
  std::string bytes;
  bytes.reserve(coded.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : coded) {
    const int six = six_bits(c);
    if (six < 0) refuse_uri(place, "its data is damaged: not base64; export the file again");
    bits = (bits << 6) | static_cast<std::uint32_t>(six);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> held));
  }
  return bytes;
}

std::filesystem::path path_of_uri(const std::string& place, std::string_view uri, const std::filesystem::path& folder) {
  const std::string text = percent_decoded(uri);
  if (folder.empty()) refuse_uri(place, fmt::format("it lies in another file, '{}'; export as .glb", printable(text)));
  const std::filesystem::path relative = std::filesystem::path(text).lexically_normal();
  const bool outside = text.empty() || text.find('\0') != text.npos || text.find(':') != text.npos ||
                       relative.is_absolute() || relative.begin() == relative.end() || *relative.begin() == "..";
  if (outside) {
    refuse_uri(place, fmt::format("'{}' is not a file in its folder; put it there under that name", printable(text)));
  }
  return folder / relative;
}

}  // namespace signweave::gltf
