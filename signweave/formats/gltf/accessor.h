#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/formats/gltf/content.h"

namespace signweave::gltf {

/// Limits the bytes that may be allocated for a file, so that a small file never expands to gigabytes.
class Budget {
 public:
  Budget(std::string file, std::uint64_t bytes) : file_(std::move(file)), left_(bytes) {}
  /// Deducts `count` items of `size` bytes each. Throws Error{unsupported} if they exceed what is left.
  void spend(std::uint64_t count, std::uint64_t size, const std::string& what);

 private:
  std::string file_;
  std::uint64_t left_;
};

/// The numbers of an accessor.
struct Numbers {
  std::span<const float> values;  ///< [element][part]; in the file's own bytes if they can be read in place
  std::size_t count = 0;          ///< elements
  std::size_t parts = 0;          ///< per element: 3 for a VEC3, 16 for a MAT4 (column-major)
};

/// The requirements on an accessor where it is used.
struct Wanted {
  int type = 0;                           ///< as tinygltf numbers them
  bool normalized_too = false;            ///< also accepts normalized integers that represent -1 to 1
  bool checked_by_caller = false;         ///< that numbers are finite; otherwise checked here (except for matrices)
  std::optional<std::size_t> count = {};  ///< number of elements, if known
};

/// Reads each accessor once; interleaved, sparse, quantized and packed ones are supported.
class Accessors {
 public:
  /// Both must outlive it.
  Accessors(const Content& content, Budget& budget) : content_(content), budget_(budget) {}

  /// Returns the numbers of accessor `index`, which must exist; valid as long as this object. Throws Error{bad_input}
  /// or Error{unsupported}, "FILE: accessor 3: …".
  Numbers read(int index, const Wanted& wanted);

 private:
  struct ByteLayout {
    std::string_view bytes;  ///< from the first element on
    std::size_t stride = 0;
  };
  std::string_view view(std::size_t index, const std::string& place);
  ByteLayout layout_of(std::size_t view_index, std::size_t offset, std::size_t element, std::size_t count,
                       const std::string& place);
  void add_sparse(const tinygltf::Accessor& accessor, std::size_t parts, std::vector<float>& values,
                  const std::string& place);

  const Content& content_;
  Budget& budget_;
  std::map<int, Numbers> read_;
  std::deque<std::vector<float>> owned_;
  std::map<std::size_t, std::string> unpacked_;  ///< of views
};

}  // namespace signweave::gltf
