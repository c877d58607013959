#include "signweave/calls/utterance_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace signweave::calls {
namespace {

/// Converts positions in a text from bytes to characters; fast if they are requested in ascending order.
class CharacterCounter {
 public:
  explicit CharacterCounter(std::string_view text) : text_(text) {}
  std::size_t at(std::size_t byte) {
    if (byte < byte_) *this = CharacterCounter(text_);
    for (; byte_ < byte; ++byte_) {
      characters_ += (text_[byte_] & 0xC0) != 0x80 ? 1 : 0;
      if (text_[byte_] != '\n') continue;
      ++line_;
      line_begin_ = characters_;
    }
    return characters_;
  }
  /// The line of the last position, from 1.
  std::size_t line() const noexcept { return line_; }
  /// Its column, from 1.
  std::size_t column() const noexcept { return characters_ - line_begin_ + 1; }

 private:
  std::string_view text_;
  std::size_t byte_ = 0;
  std::size_t characters_ = 0;
  std::size_t line_ = 1;
  std::size_t line_begin_ = 0;  // in characters
};

}  // namespace

std::vector<std::string_view> part_names() {
  std::vector<std::string_view> names;
  for (const BodyPart part : kBodyParts) names.push_back(name_of(part));
  return names;
}

std::vector<std::string_view> fault_names() {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kUtteranceFaultKinds; ++i) {
    names.push_back(name_of(static_cast<UtteranceFault::Kind>(i)));
  }
  return names;
}

std::string_view kind_name(NonManual::Kind kind) {
  switch (kind) {
    case NonManual::Kind::expression:
      return "expression";
    case NonManual::Kind::mouthing:
      return "mouthing";
    case NonManual::Kind::gaze:
      return "gaze";
  }
  return "expression";
}

std::optional<std::string> locus_text(const std::optional<LocusRef>& locus) {
  return locus ? std::optional(to_string(*locus)) : std::nullopt;
}

double as_written(float value) {
  const std::string text = fmt::format("{}", value);
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

std::optional<std::vector<double>> as_written(const std::array<float, 3>& axes, float usual) {
  if (std::ranges::count(axes, usual) == 3) return std::nullopt;
  return std::vector<double>{as_written(axes[0]), as_written(axes[1]), as_written(axes[2])};
}

std::optional<std::string_view> pause_name(Milliseconds pause) {
  if (pause <= Milliseconds(0)) return std::nullopt;
  return pause > kComma ? "stop" : "comma";
}

UtteranceAnswer run(const UtteranceCall& call) {
  const std::string& text = call.text;
  const UtteranceText read = read_utterance(text);
  UtteranceAnswer answer{.pause_after = read.pause_after,
                         .holds = read.utterance.holds,
                         .non_manuals = read.utterance.non_manuals,
                         .loci = read.utterance.loci};
  if (read.faults.empty() && !read.utterance.places.empty()) answer.canonical = to_string(read.utterance);
  CharacterCounter in_places(text);
  for (std::size_t k = 0; k < read.spans.size(); ++k) {
    const std::size_t begin = in_places.at(read.spans[k].begin);
    answer.places.push_back({read.utterance.places[k], begin, in_places.at(read.spans[k].end)});
  }
  CharacterCounter in_faults(text);
  for (const UtteranceFault& fault : read.faults) {
    TextFault one{.code = name_of(fault.kind), .message = fault.message, .begin = in_faults.at(fault.at.begin)};
    one.line = in_faults.line();
    one.column = in_faults.column();
    one.end = in_faults.at(fault.at.end);
    if (!fault.replacement.empty()) {
      one.corrected = text;
      one.corrected->replace(fault.at.begin, fault.at.end - fault.at.begin, fault.replacement);
    }
    answer.faults.push_back(std::move(one));
  }
  return answer;
}

}  // namespace signweave::calls
