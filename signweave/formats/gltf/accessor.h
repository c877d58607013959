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

/// How many bytes may still be made from a file, so that a small one never becomes gigabytes.
class Budget {
 public:
  Budget(std::string file, std::uint64_t bytes) : file_(std::move(file)), left_(bytes) {}
  /// Takes `count` things of `size` bytes each. Throws Error{unsupported} where they are more than what is left.
  void spend(std::uint64_t count, std::uint64_t size, const std::string& what);

 private:
  std::string file_;
  std::uint64_t left_;
};

/// The numbers of an accessor.
struct Numbers {
  std::span<const float> values;  ///< [element][part], in the file's own bytes where they can be read there
  std::size_t count = 0;          ///< elements
  std::size_t parts = 0;          ///< of an element: 3 of a VEC3, 16 of a MAT4 (columns first)
};

/// What an accessor must be where it is used.
struct Wanted {
  int type = 0;                  ///< as tinygltf numbers them
  bool normalized_too = false;   ///< not floats alone, but also whole numbers that stand for -1 to 1
  bool looked_at_later = false;  ///< whether its numbers are finite; else that is looked at here (not of matrices)
  std::optional<std::size_t> count = {};  ///< how many elements, where that is known
};

/// Reads accessors, each once, whatever they are: interleaved, sparse, quantised, packed.
class Accessors {
 public:
  /// Both must outlive it.
  Accessors(const Content& content, Budget& budget) : content_(content), budget_(budget) {}

  /// The numbers of accessor `index`, which exists; valid as long as this. Throws Error{bad_input} or
  /// Error{unsupported}, "FILE: accessor 3: …".
  Numbers read(int index, const Wanted& wanted);

 private:
  struct Layout {
    std::string_view bytes;  ///< from the first element on
    std::size_t stride = 0;
  };
  std::string_view view(std::size_t index, const std::string& place);
  Layout layout_of(std::size_t view_index, std::size_t offset, std::size_t element, std::size_t count,
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
