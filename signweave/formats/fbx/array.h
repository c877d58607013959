#pragma once

#include <cstdint>
#include <vector>

#include "signweave/formats/fbx/tree.h"

/// The arrays of numbers in an FBX file, checked in full: their count, their inflated size, that every number is one.
namespace signweave::fbx {

/// Unpacks arrays of one file, and no more than an animation of its size can hold.
class Arrays {
 public:
  /// Borrows the source, which must outlive this.
  explicit Arrays(const Source& source) : source_(source), left_(source.bytes.size() * 64 + (std::size_t{1} << 20)) {}

  /// The numbers of the record's array. Throws as Source::fail does where it has none or they are none.
  std::vector<std::int64_t> wholes(const Record& record);
  std::vector<float> reals(const Record& record);
  /// The attributes of keys: four floats each, of which the text form writes the last two as the whole number of their
  /// bits. As bits.
  std::vector<std::uint32_t> attributes(const Record& record);

 private:
  const Value& array_of(const Record& record) const;
  std::vector<char> unpacked(const Record& record, const Value& array, std::size_t element);
  void spend(const Record& record, std::size_t bytes);
  template <typename T>
  std::vector<T> numbers_of_text(const Record& record, const Value& array);
  template <typename In, typename Out>
  std::vector<Out> cast(const Record& record, const Value& array);

  const Source& source_;
  std::size_t left_;
};

}  // namespace signweave::fbx
