#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "signweave/formats/fbx/tree.h"

namespace signweave::fbx {
namespace {

/// Deflate expands one byte to at most 1,032.
constexpr std::uint64_t kMostDeflation = 1032;

class BinaryReader {
 public:
  explicit BinaryReader(const Source& source) : source_(source) {}

  Record root() {
    Record root;
    take(23, "its head");
    const auto version = number<std::uint32_t>("the version");
    // From version 7.5 on, positions and counts have 64 bits.
    wide_ = version >= 7500;
    root.values.push_back(whole(version));
    if (version < 7100 || version >= 8000) return root;
    for (;;) {
      Record record;
      if (!read(record, 0, {}, source_.bytes.size())) return root;
      if (matters(0, record.name, {})) root.children.push_back(std::move(record));
    }
  }

 private:
  template <typename T>
  T number(std::string_view what) {
    T value;
    std::memcpy(&value, take(sizeof(T), what).data(), sizeof(T));
    return value;
  }

  std::string_view take(std::uint64_t size, std::string_view what) {
    if (size > source_.bytes.size() - at_) {
      source_.fail(at_, fmt::format("the file ends within {}; copy or export it again", what));
    }
    const std::string_view result = source_.bytes.substr(at_, static_cast<std::size_t>(size));
    at_ += static_cast<std::size_t>(size);
    return result;
  }

  static Value whole(std::int64_t number) {
    Value value;
    value.whole = number;
    return value;
  }
  static Value real(double number) {
    Value value;
    value.kind = Value::Kind::real;
    value.real = number;
    return value;
  }

  Value array(char type, std::size_t place) {
    Value value;
    value.kind = Value::Kind::array;
    value.type = type;
    value.count = number<std::uint32_t>("an array");
    const auto encoding = number<std::uint32_t>("an array");
    const auto size = number<std::uint32_t>("an array");
    const std::uint64_t element = type == 'd' || type == 'l' ? 8 : type == 'b' || type == 'c' ? 1 : 4;
    const std::uint64_t bytes = element * value.count;
    if (encoding > 1) source_.fail(place, fmt::format("an array of unknown encoding {}; export it again", encoding));
    value.deflated = encoding == 1;
    if (value.deflated ? bytes > kMostDeflation * size + 64 : bytes != size) {
      source_.fail(place, fmt::format("an array of {} numbers that its {} bytes cannot hold; export it again",
                                      value.count, size));
    }
    value.bytes = take(size, "an array");
    return value;
  }

  Value value() {
    const std::size_t place = at_;
    const char type = take(1, "a value")[0];
    switch (type) {
      case 'C':
      case 'B':
        return whole(number<std::uint8_t>("a value"));
      case 'Y':
        return whole(number<std::int16_t>("a value"));
      case 'I':
        return whole(number<std::int32_t>("a value"));
      case 'L':
        return whole(number<std::int64_t>("a value"));
      case 'F':
        return real(static_cast<double>(number<float>("a value")));
      case 'D':
        return real(number<double>("a value"));
      case 'S':
      case 'R': {
        Value text;
        text.kind = Value::Kind::text;
        const auto size = number<std::uint32_t>("a text");
        text.bytes = take(size, "a text");
        return text;
      }
      case 'f':
      case 'd':
      case 'l':
      case 'i':
      case 'b':
      case 'c':
        return array(type, place);
      default:
        source_.fail(
            place, fmt::format("a value of unknown type 0x{:02x}; export it again", static_cast<unsigned char>(type)));
    }
  }

  std::uint64_t place_number() { return wide_ ? number<std::uint64_t>("a record") : number<std::uint32_t>("a record"); }

  void count_one(std::size_t place) {
    if (++values_ > kMostValues)
      source_.fail(place, "more than 4 million values besides meshes; this is not an animation");
  }

  /// Reads a record that must end at or before `limit`; false for the empty record that ends a list.
  bool read(Record& record, int depth, std::string_view around, std::uint64_t limit) {
    record.place = at_;
    const std::uint64_t end = place_number();
    const std::uint64_t count = place_number();
    const std::uint64_t size = place_number();
    record.name = take(number<std::uint8_t>("a record"), "a record's name");
    if (end == 0 && count == 0 && size == 0 && record.name.empty()) return false;
    if (end < at_ || end > limit) {
      source_.fail(record.place, "a record that does not end within what is around it; copy or export the file again");
    }
    if (!matters(depth, record.name, around)) {
      at_ = static_cast<std::size_t>(end);
      return true;
    }
    if (depth >= kMostDepth) source_.fail(record.place, "records nested deeper than 32; export it again");
    count_one(record.place);
    // A value has at least two bytes.
    if (size > end - at_ || count > size) {
      source_.fail(record.place, "a record whose values do not fit into it; copy or export the file again");
    }
    const std::uint64_t values_end = at_ + size;
    for (std::uint64_t i = 0; i < count; ++i) {
      count_one(at_);
      record.values.push_back(value());
    }
    if (at_ != values_end) {
      source_.fail(record.place, "a record whose values are not as long as it says; copy or export the file again");
    }
    while (at_ < end) {
      Record child;
      if (!read(child, depth + 1, record.name, end)) break;
      if (matters(depth + 1, child.name, record.name)) record.children.push_back(std::move(child));
    }
    if (at_ != end)
      source_.fail(record.place, "a record that does not end where it says; copy or export the file again");
    return true;
  }

  const Source& source_;
  bool wide_ = false;
  std::size_t at_ = 0;
  std::size_t values_ = 0;
};

}  // namespace

Record read_binary_tree(const Source& source) {
  return BinaryReader(source).root();
}

}  // namespace signweave::fbx
