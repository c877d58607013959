#include "signweave/formats/annotation_file.h"

#include "signweave/core/atomic_file.h"
#include "signweave/core/bytes.h"
#include "signweave/core/text.h"
#include "signweave/formats/anvil/anvil.h"

namespace signweave::annotation_file {
namespace {

/// The name of the first element, if it is ASCII, in any of the supported encodings: in the wide ones the letters are
/// separated by zero bytes.
std::string root_name(std::string_view text) {
  constexpr std::size_t kMost = std::size_t{1} << 20;  // a prolog is short
  std::string plain(text.substr(0, kMost));
  std::erase(plain, '\0');
  for (std::size_t at = plain.find('<'); at != std::string::npos; at = plain.find('<', at)) {
    const std::string_view rest = std::string_view(plain).substr(at);
    std::size_t skip = 0;
    if (rest.starts_with("<?")) {
      skip = rest.find("?>");
    } else if (rest.starts_with("<!--")) {
      skip = rest.find("-->");
    } else if (rest.starts_with("<!")) {  // a DOCTYPE, whose own declarations are in brackets
      const std::size_t bracket = rest.find_first_of("[>");
      skip = bracket == rest.npos || rest[bracket] == '>' ? bracket : rest.find(']', bracket);
    } else {
      return std::string(rest.substr(1, rest.find_first_of(" \t\r\n/>", 1) - 1));
    }
    if (skip == rest.npos) break;
    at += skip;
  }
  return {};
}

}  // namespace

bool is_name(const std::filesystem::path& path) {
  const std::string extension = fold_case(path.extension().string());
  return extension == ".eaf" || extension == ".anvil";
}

SourceFormat format_of(std::string_view text) {
  return root_name(text) == "annotation" ? SourceFormat::anvil : SourceFormat::eaf;
}

File read(const std::filesystem::path& path, Unsound unsound) {
  return fold_case(path.extension().string()) == ".anvil" ? anvil::read(path) : eaf::read(path, unsound);
}

File read_text(std::string name, std::string_view text, std::string_view specification) {
  if (format_of(text) == SourceFormat::eaf) return eaf::read_text(std::move(name), text);
  return anvil::read_text(name, text, specification);
}

std::uint64_t fingerprint(const std::filesystem::path& path) {
  const std::uint64_t print = file_checksum(path);
  if (fold_case(path.extension().string()) != ".anvil") return print;
  std::filesystem::path specification;
  try {
    specification = anvil::specification_of(path);
  } catch (const Error& error) {  // reading the file reports the error
    if (error.code() != ErrorCode::bad_input) throw;
  }
  if (specification.empty()) return print;
  ByteWriter both;
  both.number(print);
  both.number(file_checksum(specification));
  return checksum(both.bytes());
}

}  // namespace signweave::annotation_file
