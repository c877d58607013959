#include "signweave/calls/utterance_call.h"

namespace signweave::calls {
namespace {

/// Converts positions in a text from bytes to characters; positions must be requested in ascending order.
class CharacterCounter {
 public:
  explicit CharacterCounter(std::string_view text) : text_(text) {}
  std::size_t at(std::size_t byte) {
    for (; byte_ < byte; ++byte_) characters_ += (text_[byte_] & 0xC0) != 0x80 ? 1 : 0;
    return characters_;
  }

 private:
  std::string_view text_;
  std::size_t byte_ = 0;
  std::size_t characters_ = 0;
};

}  // namespace

std::optional<std::string_view> pause_name(Milliseconds pause) {
  if (pause <= Milliseconds(0)) return std::nullopt;
  return pause > kComma ? "stop" : "comma";
}

UtteranceAnswer run(const UtteranceCall& call) {
  const std::string& text = call.text;
  const UtteranceText read = read_utterance(text);
  UtteranceAnswer answer{.places = {}, .pause_after = read.pause_after, .faults = {}};
  CharacterCounter in_places(text);
  for (std::size_t k = 0; k < read.spans.size(); ++k) {
    const std::size_t begin = in_places.at(read.spans[k].begin);
    answer.places.push_back({read.utterance.places[k], begin, in_places.at(read.spans[k].end)});
  }
  CharacterCounter in_faults(text);
  for (const UtteranceFault& fault : read.faults) {
    const std::size_t begin = in_faults.at(fault.at.begin);
    TextFault one{name_of(fault.kind), fault.message, begin, in_faults.at(fault.at.end), {}};
    if (!fault.replacement.empty()) {
      one.corrected = text;
      one.corrected->replace(fault.at.begin, fault.at.end - fault.at.begin, fault.replacement);
    }
    answer.faults.push_back(std::move(one));
  }
  return answer;
}

}  // namespace signweave::calls
