#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "signweave/choose/edit.h"
#include "signweave/core/error.h"
#include "signweave/notation/utterance.h"

using namespace signweave;

namespace {

/// A quoted gloss, in which nothing can be parsed as syntax.
std::string quoted(const GlossRef& gloss) {
  std::string text = "\"";
  for (const char c : gloss.gloss) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + '"' + (gloss.token > 0 ? '#' + std::to_string(gloss.token) : "");
}

std::string quoted(const SignRun& run) {
  return quoted(run.first) + ".." + quoted(run.last);
}

/// Every fault is one line about a part of the text, in the order of the text.
void check_faults(std::string_view text, const UtteranceText& read) {
  std::size_t before = 0;
  if (read.spans.size() != read.utterance.places.size()) std::abort();
  for (const UtteranceFault& fault : read.faults) {
    if (fault.at.begin < before || fault.at.end <= fault.at.begin || fault.at.end > text.size()) std::abort();
    if (fault.message.empty() || fault.message.find('\n') != std::string::npos) std::abort();
    before = fault.at.begin;
  }
}

}  // namespace

/// Any bytes are parsed as an utterance or rejected with an Error, and a parsed utterance parses back from its own
/// text. The same bytes are also tried as the two words of an edit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  UtteranceWords some;  // a database that knows every other word
  some.is_gloss = [](std::string_view word) { return word.size() % 2 == 1; };
  for (const UtteranceWords& words : {UtteranceWords(), some}) {
    try {
      check_faults(text, read_utterance(text, words));
      const Utterance utterance = parse_utterance(text, words);
      if (utterance.places.empty()) std::abort();
      if (parse_utterance(to_string(utterance)) != utterance) std::abort();
    } catch (const Error&) {
    }
  }
  try {
    const Replacement replacement = parse_replacement(text);
    const Replacement again = parse_replacement(quoted(replacement.from) + '=' + quoted(replacement.to));
    if (again.from != replacement.from || again.to != replacement.to) std::abort();
  } catch (const Error&) {
  }
  try {
    const auto [first, second] = parse_swap(text);
    const auto again = parse_swap(quoted(first) + ',' + quoted(second));
    if (again.first.first != first.first || again.second.last != second.last) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
