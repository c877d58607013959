#pragma once

#include <cstdint>
#include <vector>

#include "signweave/formats/fbx/tree.h"

/// The arrays of numbers in an FBX file, fully checked: their count, their inflated size, and that every element is a
/// number.
namespace signweave::fbx {

/// Unpacks the arrays of one file, up to the amount that an animation of its size can hold.
class Arrays {
 public:
  /// Borrows the source, which must outlive this.
  explicit Arrays(const Source& source) : source_(source), left_(source.bytes.size() * 64 + (std::size_t{1} << 20)) {}

  /// The numbers of the record's array. Throws as Source::fail does if there is none or its elements are not numbers.
  std::vector<std::int64_t> wholes(const Record& record);
  std::vector<float> reals(const Record& record);
  /// The attributes of keys, as bits: four floats each; in the text form the last two are written as the integer value
  /// of their bits.
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
