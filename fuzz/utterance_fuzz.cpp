#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "signweave/choose/edit.h"
#include "signweave/core/error.h"
#include "signweave/notation/utterance.h"

using namespace signweave;

namespace {

/// A quoted gloss, in which nothing can be parsed as syntax. nullopt if it cannot be quoted.
std::optional<std::string> quoted(const GlossRef& gloss) {
  if (gloss.gloss.find('"') != std::string::npos) return std::nullopt;
  return '"' + gloss.gloss + '"' + (gloss.token > 0 ? '#' + std::to_string(gloss.token) : "");
}

std::optional<std::string> quoted(const SignRun& run) {
  const auto first = quoted(run.first);
  const auto last = quoted(run.last);
  if (!first || !last) return std::nullopt;
  return *first + ".." + *last;
}

}  // namespace

/// Any bytes are parsed as an utterance or rejected with an Error, and a parsed utterance parses back from its own
/// text. The same bytes are also tried as the two words of an edit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const Utterance utterance = parse_utterance(text);
    if (utterance.places.empty()) std::abort();
    if (parse_utterance(to_string(utterance)) != utterance) std::abort();
  } catch (const Error&) {
  }
  try {
    const Replacement replacement = parse_replacement(text);
    const auto from = quoted(replacement.from);
    const auto to = quoted(replacement.to);
    if (from && to) {
      const Replacement again = parse_replacement(*from + '=' + *to);
      if (again.from != replacement.from || again.to != replacement.to) std::abort();
    }
  } catch (const Error&) {
  }
  try {
    const auto [first, second] = parse_swap(text);
    const auto one = quoted(first);
    const auto other = quoted(second);
    if (one && other) {
      const auto again = parse_swap(*one + ',' + *other);
      if (again.first.first != first.first || again.second.last != second.last) std::abort();
    }
  } catch (const Error&) {
  }
  return 0;
}
