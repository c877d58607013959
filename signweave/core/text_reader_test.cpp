#include "signweave/core/text_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A word and the line that it is on.
struct Found {
  std::string word;
  std::size_t line;
  friend bool operator==(const Found&, const Found&) = default;
  friend void PrintTo(const Found& found, std::ostream* out) { *out << found.word << '@' << found.line; }
};

std::vector<Found> words_of(TextReader& reader) {
  std::vector<Found> found;
  for (std::string word(reader.word()); !word.empty(); word = reader.word()) found.push_back({word, reader.line()});
  return found;
}

std::vector<Found> words_of(std::string_view text) {
  TextReader reader("text", text);
  return words_of(reader);
}

std::string fault_of(std::string_view text, double* value = nullptr) {
  TextReader reader("f", text);
  try {
    const double read = reader.number("a number");
    if (value != nullptr) *value = read;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return {};
}

/// A file that exists as long as the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view text)
      : path_(
            std::filesystem::temp_directory_path() /
            fmt::format("signweave_{}_{}", ::getpid(), testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(TextReader, EveryKindOfLineEndCountsOnce) {
  EXPECT_THAT(words_of("a\nb\r\nc\rd\r\r\ne\n\rf"),
              ElementsAre(Found{"a", 1}, Found{"b", 2}, Found{"c", 3}, Found{"d", 4}, Found{"e", 6}, Found{"f", 8}));
}

TEST(TextReader, WordsAreSeparatedByAnyWhiteSpace) {
  EXPECT_THAT(words_of("\t a\t\vb\f c  "), ElementsAre(Found{"a", 1}, Found{"b", 1}, Found{"c", 1}));
}

TEST(TextReader, AByteOrderMarkIsNotPartOfTheFirstWord) {
  EXPECT_THAT(words_of("\xEF\xBB\xBFhello"), ElementsAre(Found{"hello", 1}));
}

TEST(TextReader, APeekedWordIsReadOnce) {
  TextReader reader("f", "a\nb");
  EXPECT_EQ(reader.peek(), "a");
  EXPECT_EQ(reader.peek(), "a");
  EXPECT_EQ(reader.word(), "a");
  EXPECT_EQ(reader.peek(), "b");
  EXPECT_EQ(reader.line(), 2u);
  EXPECT_EQ(reader.word(), "b");
  EXPECT_EQ(reader.peek(), "");
}

TEST(TextReader, TheRestOfALinePreservesInnerBlanksAndEndsBeforeTheNext) {
  TextReader reader("f", "JOINT  left  hand \t\r\nnext\r\n\r\nlast");
  EXPECT_EQ(reader.word(), "JOINT");
  EXPECT_EQ(reader.rest_of_line(), "left  hand");
  EXPECT_EQ(reader.line(), 1u);
  EXPECT_EQ(reader.word(), "next");
  EXPECT_EQ(reader.line(), 2u);
  EXPECT_EQ(reader.rest_of_line(), "");
  EXPECT_EQ(reader.rest_of_line(), "");
  EXPECT_EQ(reader.rest_of_line(), "last");
  EXPECT_EQ(reader.line(), 4u);
  EXPECT_EQ(reader.rest_of_line(), "");
}

TEST(TextReader, ANumberMayHaveAnyUsualNotation) {
  const std::vector<std::pair<std::string, double>> cases = {
      {"1", 1},      {"-0.5", -0.5}, {"+7.25", 7.25},     {".5", 0.5},         {"5.", 5},
      {"1e3", 1000}, {"1E+2", 100},  {"5.1e-06", 5.1e-6}, {"-1.5E-2", -0.015}, {"000.25", 0.25}};
  for (const auto& [text, value] : cases) {
    double read = -1;
    EXPECT_EQ(fault_of(text, &read), "") << text;
    EXPECT_EQ(read, value) << text;
  }
}

TEST(TextReader, ANumberTooSmallForADoubleIsZero) {
  for (const char* text : {"1e-400", "-1e-99999999999999999999", "0.000001e-399"}) {
    double read = -1;
    EXPECT_EQ(fault_of(text, &read), "") << text;
    EXPECT_EQ(read, 0) << text;
  }
}

TEST(TextReader, OtherWordsThanFiniteNumbersAreRefusedWithTheirLine) {
  for (const char* text : {"nan", "NaN", "inf", "-inf", "1e400", "0.001e500", "1.#QNAN", "0,5", "1.5f", "+-5", "++5",
                           "-", "+", "0x10", "1e", "twelve"}) {
    EXPECT_THAT(fault_of("\n" + std::string(text)), testing::StartsWith("f:2: ")) << text;
  }
  EXPECT_EQ(fault_of(""), "f:1: the file ends here, expected a number");
}

TEST(TextReader, ANulByteIsAnError) {
  using namespace std::string_view_literals;
  TextReader reader("f", "ab\0c"sv);
  EXPECT_THROW(reader.word(), Error);
  TextReader line("f", "ab c\0d"sv);
  EXPECT_EQ(line.word(), "ab");
  EXPECT_THROW(line.rest_of_line(), Error);
}

TEST(TextReader, AnOverlongWordIsAnErrorWhereverItEnds) {
  const std::string longest(65'536, 'x');
  EXPECT_THAT(words_of(longest), ElementsAre(Found{longest, 1}));
  const std::string too_long = "a " + longest + "xx";
  TextReader reader("f", std::string_view(too_long).substr(2));
  EXPECT_THROW(reader.word(), Error);
  const TemporaryFile file(std::string(1'000'000, 'x'));
  TextReader from_file(file.path());
  EXPECT_THROW(from_file.word(), Error);
  TextReader line("f", too_long);
  line.word();
  EXPECT_THROW(line.rest_of_line(), Error);
}

TEST(TextReader, ExpectNamesWhatItFound) {
  TextReader reader("f", "a\nb");
  reader.expect("a");
  try {
    reader.expect("c");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "f:2: expected c, found 'b'");
  }
}

/// Reads all numbers of a text in runs of at most `most_at_once`, and one by one where a run stops. Counts those in
/// runs.
struct NumbersFound {
  std::vector<double> numbers;
  std::vector<std::size_t> lines;
  std::size_t in_runs = 0;
};
NumbersFound numbers_of(TextReader& reader, std::size_t most_at_once) {
  NumbersFound found;
  std::vector<double> buffer(most_at_once);
  for (;;) {
    const TextReader::NumberRun run = reader.plain_numbers(buffer, 1e300);
    found.numbers.insert(found.numbers.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(run.count));
    found.lines.resize(found.numbers.size());
    if (run.count > 0) {
      found.lines[found.lines.size() - run.count] = run.first_line;
      found.lines.back() = reader.line();
    }
    found.in_runs += run.count;
    if (run.count == most_at_once) continue;
    if (reader.peek().empty()) return found;
    found.numbers.push_back(reader.number("a number"));
    found.lines.push_back(reader.line());
  }
}

// A run must give the same bits as reading number by number: correctly rounded, in every notation.
RC_GTEST_PROP(TextReader, ARunEqualsNumbersReadOneByOne, ()) {
  auto state = static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30));
  const auto next = [&](std::uint32_t most) {
    state = state * 1'664'525u + 1'013'904'223u;
    return (state >> 8) % most;
  };
  const std::vector<std::string> gaps = {" ", " ", " ", "\t", "  ", "\n", "\r\n", "\r", " \r \n"};
  const auto digits = [&](std::uint32_t count) {
    std::string text;
    for (std::uint32_t i = 0; i < count; ++i) text += static_cast<char>('0' + (next(4) == 0 ? 0 : next(10)));
    return text;
  };
  std::string text;
  for (int i = 0; i < 3'000; ++i) {
    const std::uint32_t form = next(16);
    if (next(2) == 0) text += '-';
    if (form == 0) text.append(text.ends_with('-') ? 0 : 1, '+');
    text += digits(form == 1 ? 0 : 1 + next(form == 2 ? 25 : 9));
    if (form == 1 || form > 3) text += '.' + digits(form == 1 ? 1 + next(5) : next(form == 4 ? 25 : 10));
    if (form == 5 || form == 6) text += (form == 5 ? "e-" : "E+") + std::to_string(next(form == 5 ? 45 : 30));
    text += gaps[next(static_cast<std::uint32_t>(gaps.size()))];
  }
  TextReader reader("text", text);
  const NumbersFound found = numbers_of(reader, 1 + next(40));
  RC_ASSERT(found.numbers.size() == 3'000u);
  RC_ASSERT(found.in_runs > 2'000u);
  TextReader slow("text", text);
  for (std::size_t i = 0; i < found.numbers.size(); ++i) {
    const double expected = slow.number("a number");
    RC_ASSERT(found.numbers[i] == expected);
    RC_ASSERT(std::signbit(found.numbers[i]) == std::signbit(expected));
    if (found.lines[i] != 0) RC_ASSERT(found.lines[i] == slow.line());
  }
  RC_ASSERT(slow.peek().empty());
  RC_ASSERT(reader.bytes_read() == slow.bytes_read());
}

TEST(TextReader, RunsOfNumbersCrossTheEdgesOfTheWindow) {
  std::string text;
  std::size_t count = 0;
  for (; text.size() < 900'000; ++count)
    text += fmt::format("{}.{:04}{}", count % 1000, count % 7919, count % 50 == 0 ? "\r\n" : " ");
  const TemporaryFile file(text);
  TextReader reader(file.path());
  const NumbersFound found = numbers_of(reader, 168);
  ASSERT_EQ(found.numbers.size(), count);
  EXPECT_GT(found.in_runs, count - 100);
  TextReader slow("text", text);
  for (const double number : found.numbers) ASSERT_EQ(number, slow.number("a number"));
  EXPECT_EQ(reader.line(), slow.line());
}

TEST(TextReader, ARunStopsBeforeAWordThatIsNotAPlainNumber) {
  const std::string rest(64, ' ');
  for (const std::string word : {"nan", "inf", "1,5", "1.5f", "1.5.5", "--5", "-", ".", "-.", "e5", "1e", "1e+", "0x10",
                                 "1e999", "5-", "twelve"}) {
    SCOPED_TRACE(word);
    const std::string text = "1 -2.5\n3 " + word + " 4" + rest;
    TextReader reader("f", text);
    std::vector<double> numbers(8);
    const TextReader::NumberRun run = reader.plain_numbers(numbers, 1e9);
    EXPECT_EQ(run.count, 3u);
    EXPECT_EQ(run.first_line, 1u);
    EXPECT_EQ(reader.line(), 2u);
    EXPECT_EQ(reader.word(), word);
  }
}

TEST(TextReader, ARunContainsNoNumberThatIsTooLarge) {
  const std::string text = "999 -1000 1000.001 5" + std::string(64, ' ');
  TextReader reader("f", text);
  std::vector<double> numbers(4);
  EXPECT_EQ(reader.plain_numbers(numbers, 1000).count, 2u);
  EXPECT_EQ(reader.word(), "1000.001");
}

TEST(TextReader, ARunDoesNotSkipAPeekedWord) {
  const std::string text = "1 2 3" + std::string(64, ' ');
  TextReader reader("f", text);
  EXPECT_EQ(reader.peek(), "1");
  std::vector<double> numbers(3);
  EXPECT_EQ(reader.plain_numbers(numbers, 10).count, 0u);
  EXPECT_EQ(reader.word(), "1");
  EXPECT_EQ(reader.plain_numbers(numbers, 10).count, 2u);
}

TEST(TextReader, AMissingFileIsNotFound) {
  try {
    TextReader reader(std::filesystem::path("/nowhere/at/all"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
  }
  EXPECT_THROW(TextReader reader(std::filesystem::temp_directory_path()), Error);
}

TEST(TextReader, BytesReadReachTheSizeOfTheFile) {
  const TemporaryFile file("\xEF\xBB\xBFone two\r\nthree\r\n");
  TextReader reader(file.path());
  words_of(reader);
  EXPECT_EQ(reader.total_bytes(), 19u);
  EXPECT_EQ(reader.bytes_read(), 19u);
}

// The difficult cases are words, line ends and lines that cross the edge of the window, which has 256 KiB.
RC_GTEST_PROP(TextReader, AFileGivesTheSameWordsAsItsText, ()) {
  const auto seed = *rc::gen::inRange(0, 1 << 30);
  const std::vector<std::string> gaps = {" ", "\n", "\r\n", "\r", "\t", "\r\n\r\n", " \r \n"};
  std::string text;
  auto state = static_cast<std::uint32_t>(seed);
  const auto next = [&](std::uint32_t most) {
    state = state * 1'664'525u + 1'013'904'223u;
    return (state >> 8) % most;
  };
  while (text.size() < 600'000) {
    text += std::string(1 + next(40), static_cast<char>('a' + next(26)));
    text += gaps[next(static_cast<std::uint32_t>(gaps.size()))];
  }
  const TemporaryFile file(text);
  TextReader from_file(file.path());
  TextReader from_text("text", text);
  for (std::size_t i = 0;; ++i) {
    const bool by_line = i % 5 == 4;
    const std::string a(by_line ? from_file.rest_of_line() : from_file.word());
    const std::string b(by_line ? from_text.rest_of_line() : from_text.word());
    RC_ASSERT(a == b);
    RC_ASSERT(from_file.line() == from_text.line());
    RC_ASSERT(from_file.bytes_read() == from_text.bytes_read());
    if (a.empty() && from_text.bytes_read() == text.size()) break;
  }
}

}  // namespace
}  // namespace signweave
