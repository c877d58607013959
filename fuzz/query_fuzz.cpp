#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "signweave/query/parse.h"

/// Any bytes are parsed as a query or rejected with a SyntaxError, and a parsed query parses back from its own text.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const signweave::PhaseQuery query = signweave::parse(text);
    const std::string again = signweave::to_string(query);
    // Normalised text is longer than the input ("a=b" becomes "a = b"), so near the limit it may be too long.
    if (again.size() <= 64 * 1024 && signweave::parse(again) != query) std::abort();
  } catch (const signweave::SyntaxError&) {
  }
  return 0;
}
