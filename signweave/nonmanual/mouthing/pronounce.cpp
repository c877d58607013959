#include "signweave/nonmanual/mouthing/pronounce.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/nonmanual/mouthing/run_program.h"

namespace signweave {
namespace {

constexpr std::string_view kNoSpeech = "; mouthings are read by letter rules";

/// One line of words for the program: no control characters, and none of those that it takes for commands.
std::string spoken(std::string_view text) {
  std::string result = match_form(text);
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f ||
        std::string_view("[]<>|").find(c) != std::string_view::npos) {
      c = ' ';
    }
  }
  return result;
}

std::vector<std::string> espeak_arguments(MouthingLanguage language, std::string text) {
  const std::string ipa = std::string("-") + "-ipa=3";  // with ties in diphthongs
  return {"-q", ipa, "-v", std::string(name_of(language)), "--", std::move(text)};
}

std::string failure_of(const ProgramResult& result, Milliseconds patience) {
  switch (result.end) {
    case ProgramResult::End::finished:
      return "gave no pronunciation";
    case ProgramResult::End::failed:
      return fmt::format("failed with status {}", result.status);
    case ProgramResult::End::too_long:
      return fmt::format("did not answer within {} ms", patience.count());
    case ProgramResult::End::too_much:
      return "gave far too much output";
  }
  return "failed";
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

std::string_view name_of(MouthingSource source) noexcept {
  switch (source) {
    case MouthingSource::letters:
      return "letters";
    case MouthingSource::espeak:
      return "espeak";
    case MouthingSource::none:
      return "none";
  }
  return "none";
}

std::optional<MouthingSource> mouthing_source(std::string_view name) noexcept {
  for (const MouthingSource source : {MouthingSource::letters, MouthingSource::espeak, MouthingSource::none}) {
    if (name_of(source) == name) return source;
  }
  return std::nullopt;
}

std::optional<std::string> Pronouncer::by_program(std::string_view text, const std::string& where,
                                                  std::vector<Notice>& notices) {
  const auto failed = [&](const std::string& why) {
    program_failed_ = true;
    notices.push_back({.where = where, .text = why + std::string(kNoSpeech)});
    return std::nullopt;
  };
  const std::optional<std::filesystem::path> file = find_program(options_.program);
  if (!file) return failed(fmt::format("no program {} found", printable(options_.program.string())));
  try {
    ProgramResult result =
        run_program(*file, espeak_arguments(options_.language, spoken(text)), {.patience = options_.patience});
    if (result.end != ProgramResult::End::finished || !is_utf8(result.output)) {
      return failed(fmt::format("{} {}", printable(file->string()), failure_of(result, options_.patience)));
    }
    return std::string(trimmed(result.output));
  } catch (const Error& error) {
    return failed(error.what());
  }
}

Pronunciation Pronouncer::pronounce(std::string_view text, const std::string& where) {
  if (text.size() > 4 * kMostMouthed || characters(text) > kMostMouthed) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: a mouthing of {}; at most {} characters can be mouthed", where,
                                                  size_text(text.size()), kMostMouthed));
  }
  if (!is_utf8(text)) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: the text to be mouthed is not UTF-8", where));
  }
  Pronunciation result;
  if (options_.source == MouthingSource::none || trimmed(text).empty()) return result;
  std::optional<std::string> spoken_ipa;
  if (options_.source == MouthingSource::espeak && !program_failed_) {
    spoken_ipa = by_program(text, where, result.notices);
  }
  if (spoken_ipa) {
    result.ipa = std::move(*spoken_ipa);
  } else {
    LetterReading reading = read_letters(text, options_.language);
    result.ipa = std::move(reading.ipa);
    if (!reading.skipped.empty()) {
      std::string list;
      for (const std::string& one : reading.skipped) list += one;
      result.notices.push_back({.where = where,
                                .text = fmt::format("not mouthed in '{}', because the rules for {} do not read it: {}",
                                                    printable(text), name_of(options_.language), printable(list))});
    }
  }
  result.phones = phones_of_ipa(result.ipa);
  return result;
}

}  // namespace signweave
