#include "signweave/calls/signing_space.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "signweave/core/error.h"
#include "signweave/formats/write_file.h"
#include "signweave/space/locus.h"

namespace signweave::calls {

namespace {

struct NamedLocus {
  std::string name;
  LocusRef is;
};

NamedLocus read_named(std::string_view text) {
  if (text.starts_with('@')) text.remove_prefix(1);
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  if (equals == std::string_view::npos) return {std::string(text), read_locus(text)};
  std::string_view is = text.substr(equals + 1);
  if (is.starts_with('@')) is.remove_prefix(1);
  const LocusRef own = read_locus(name);
  if (own.kind != LocusRef::Kind::name || is_built_in_locus(own.name)) {
    throw Error(ErrorCode::bad_input, fmt::format("'{}': give the locus another name: a={}", text, is));
  }
  return {own.name, read_locus(is)};
}

}  // namespace

std::vector<MarkedLocus> marked_loci(std::span<const std::string> texts, const SignerBody& body) {
  std::vector<LocusSetup> setups;
  std::vector<MarkedLocus> marks;
  for (const std::string& text : texts) {
    const NamedLocus one = read_named(text);
    marks.push_back({one.name, resolve(one.is, setups, 0, body).at});
    if (text.find('=') != std::string::npos) setups.push_back({.name = one.name, .is = one.is});
  }
  return marks;
}

std::string check_marked_locus(const std::string& text) {
  try {
    read_named(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void check_signing_space(bool wanted, const std::vector<std::string>& paths, std::string_view parameter) {
  const auto is_sheet = [](const std::string& path) { return extension_of(path) == ".svg"; };
  if (!wanted || std::ranges::any_of(paths, is_sheet)) return;
  throw Error(ErrorCode::bad_input,
              fmt::format("'{}' is drawn on contact sheets only: request an .svg file", parameter));
}

}  // namespace signweave::calls
