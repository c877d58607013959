#include "signweave/formats/fbx/array.h"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "signweave/core/text.h"

namespace signweave::fbx {
namespace {

constexpr std::string_view kArrayBlanks = " \t\r\n,";

/// Inflates into exactly `out`; false if the bytes are damaged or give a different number of bytes.
bool inflate_exactly(std::string_view in, std::vector<char>& out) {
  z_stream stream{};
  if (::inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  // zlib's interface lacks const for input that it only reads.
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(in.data()));
  stream.avail_in = static_cast<uInt>(in.size());
  char none = 0;
  stream.next_out = reinterpret_cast<Bytef*>(out.empty() ? &none : out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int state = ::inflate(&stream, Z_FINISH);
  const bool whole = state == Z_STREAM_END && stream.avail_out == 0;
  ::inflateEnd(&stream);
  return whole;
}

/// The number as stored; fails if it cannot be a measurement.
float measurement(const Source& source, const Record& record, double number) {
  if (!(std::abs(number) <= 1e9)) {
    source.fail(record.place,
                fmt::format("{} holds {}; a measurement is a number up to 1e+09", printable(record.name), number));
  }
  return static_cast<float>(number);
}

}  // namespace

const Value& Arrays::array_of(const Record& record) const {
  if (record.values.empty() || record.values[0].kind != Value::Kind::array) {
    source_.fail(record.place, fmt::format("{} is not an array of numbers", printable(record.name)));
  }
  return record.values[0];
}

void Arrays::spend(const Record& record, std::size_t bytes) {
  if (bytes > left_) {
    source_.fail(record.place, fmt::format("{} holds more numbers than an animation in a file of this size can have",
                                           printable(record.name)));
  }
  left_ -= bytes;
}

std::vector<char> Arrays::unpacked(const Record& record, const Value& array, std::size_t element) {
  const std::size_t size = element * array.count;
  spend(record, size);
  std::vector<char> bytes(size);
  if (!array.deflated) {
    std::memcpy(bytes.data(), array.bytes.data(), size);
  } else if (!inflate_exactly(array.bytes, bytes)) {
    source_.fail(record.place, fmt::format("the compressed numbers of {} are damaged; copy or export the file again",
                                           printable(record.name)));
  }
  return bytes;
}

template <typename T>
std::vector<T> Arrays::numbers_of_text(const Record& record, const Value& array) {
  // A number takes at least two characters, so the count is checked against the bytes first.
  if (array.count > array.bytes.size()) {
    source_.fail(record.place,
                 fmt::format("{} announces {} numbers and does not have them", printable(record.name), array.count));
  }
  spend(record, array.count * sizeof(T));
  std::vector<T> numbers;
  numbers.reserve(array.count);
  for (std::size_t at = array.bytes.find_first_not_of(kArrayBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(array.bytes.find_first_of(kArrayBlanks, at), array.bytes.size());
    const std::string_view word = array.bytes.substr(at, end - at);
    T number{};
    const auto [stop, error] =
        std::from_chars(word.data() + (word[0] == '+' ? 1 : 0), word.data() + word.size(), number);
    if (error != std::errc() || stop != word.data() + word.size()) {
      const auto place = static_cast<std::size_t>(word.data() - source_.bytes.data());
      source_.fail(place, fmt::format("expected a number of {}, found '{}'", printable(record.name), printable(word)));
    }
    if (numbers.size() == array.count) {
      source_.fail(record.place,
                   fmt::format("{} announces {} numbers and has more", printable(record.name), array.count));
    }
    numbers.push_back(number);
    at = array.bytes.find_first_not_of(kArrayBlanks, end);
  }
  if (numbers.size() != array.count) {
    source_.fail(record.place, fmt::format("{} announces {} numbers and has {}", printable(record.name), array.count,
                                           numbers.size()));
  }
  return numbers;
}

template <typename In, typename Out>
std::vector<Out> Arrays::cast(const Record& record, const Value& array) {
  const std::vector<char> bytes = unpacked(record, array, sizeof(In));
  spend(record, array.count * sizeof(Out));
  std::vector<Out> numbers(array.count);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    In number;
    std::memcpy(&number, bytes.data() + i * sizeof(In), sizeof(In));
    numbers[i] = static_cast<Out>(number);
  }
  return numbers;
}

std::vector<std::int64_t> Arrays::wholes(const Record& record) {
  const Value& array = array_of(record);
  if (array.type == 't') return numbers_of_text<std::int64_t>(record, array);
  if (array.type == 'l') return cast<std::int64_t, std::int64_t>(record, array);
  if (array.type == 'i') return cast<std::int32_t, std::int64_t>(record, array);
  source_.fail(record.place, fmt::format("{} should hold whole numbers", printable(record.name)));
}

std::vector<float> Arrays::reals(const Record& record) {
  const Value& array = array_of(record);
  std::vector<float> numbers;
  if (array.type == 'd' || array.type == 't') {
    const std::vector<double> exact =
        array.type == 'd' ? cast<double, double>(record, array) : numbers_of_text<double>(record, array);
    numbers.reserve(exact.size());
    for (const double number : exact) numbers.push_back(measurement(source_, record, number));
    return numbers;
  }
  if (array.type != 'f') {
    source_.fail(record.place, fmt::format("{} should hold numbers with fractions", printable(record.name)));
  }
  numbers = cast<float, float>(record, array);
  for (const float number : numbers) measurement(source_, record, static_cast<double>(number));
  return numbers;
}

std::vector<std::uint32_t> Arrays::attributes(const Record& record) {
  const Value& array = array_of(record);
  std::vector<std::uint32_t> bits;
  if (array.type == 'f') {
    for (const float number : cast<float, float>(record, array)) bits.push_back(std::bit_cast<std::uint32_t>(number));
    return bits;
  }
  if (array.type == 'i') return cast<std::int32_t, std::uint32_t>(record, array);
  if (array.type != 't') {
    source_.fail(record.place, fmt::format("{} should hold numbers with fractions", printable(record.name)));
  }
  const std::vector<double> numbers = numbers_of_text<double>(record, array);
  bits.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double number = numbers[i];
    const bool is_bits = i % 4 >= 2 && number >= 1 && number <= 4294967295.0 && number == std::floor(number);
    if (is_bits) {
      bits.push_back(static_cast<std::uint32_t>(number));
    } else {
      const bool fits = std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max());
      bits.push_back(std::bit_cast<std::uint32_t>(fits ? static_cast<float>(number) : 0.0f));
    }
  }
  return bits;
}

}  // namespace signweave::fbx
