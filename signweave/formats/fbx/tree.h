#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"

/// The bytes of an FBX file as a tree of records, the same for binary and text. Every size in the file is checked
/// against the bytes that exist. What an animation does not need (meshes, materials, pictures) is skipped.
namespace signweave::fbx {

/// A file's bytes, borrowed.
struct Source {
  std::string name;
  std::string_view bytes;
  bool binary = false;

  /// Throws Error{bad_input, "NAME:LINE: what"}, or for a binary file "NAME: byte PLACE: what".
  [[noreturn]] void fail(std::size_t place, std::string_view what) const;
};

/// One value of a record.
struct Value {
  enum class Kind : std::uint8_t { whole, real, text, array };
  Kind kind = Kind::whole;
  char type = 0;            ///< type of an array's elements: as in the file ('i', 'l', 'f', 'd', 'b'), 't' for text
  bool deflated = false;    ///< for an array
  std::uint32_t count = 0;  ///< for an array
  union {
    std::int64_t whole = 0;
    double real;
  };
  std::string_view bytes;  ///< a text, or an array as stored in the file; borrowed from the Source
};

struct Record {
  std::string_view name;
  std::size_t place = 0;  ///< where it begins in the file
  std::vector<Value> values;
  std::vector<Record> children;

  /// The first child of that name, or null.
  const Record* child(std::string_view child_name) const noexcept;
  /// A value as text, empty if there is none; as a number, `otherwise` if there is none.
  std::string_view text(std::size_t index) const noexcept;
  double number(std::size_t index, double otherwise) const noexcept;
  std::int64_t whole(std::size_t index, std::int64_t otherwise) const noexcept;
};

/// Parses a file into a tree. Throws as `fail` does, and Error{unsupported} for an unsupported version.
Record read_tree(Source& source);

/// The maximum number of records and values in one file; an animation has far fewer.
inline constexpr std::size_t kMostValues = 4'000'000;
/// The maximum nesting of records.
inline constexpr int kMostDepth = 32;

/// Whether the content of a record is needed, given its depth (0: outermost), its name and that of the enclosing
/// record.
bool matters(int depth, std::string_view name, std::string_view around) noexcept;

// For read_tree.
Record read_binary_tree(const Source& source);
Record read_text_tree(const Source& source);

}  // namespace signweave::fbx
