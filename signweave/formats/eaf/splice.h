#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/xml.h"

/// Changes parts of an XML text and leaves every other byte alone. For edit.cpp.
namespace signweave::eaf {

/// The position of an element in the text: "<NAME …>" is [begin, open_end), "</NAME>" is [close_begin, end).
struct Extent {
  std::size_t begin = 0;
  std::size_t open_end = 0;
  std::size_t close_begin = 0;  ///< equal to open_end for "<NAME/>"
  std::size_t end = 0;
  bool self_closing() const noexcept { return end == open_end; }
};

/// The extents of all elements of a text. Borrows the Xml.
class Extents {
 public:
  explicit Extents(const Xml& xml);
  Extent of(pugi::xml_node element) const;

 private:
  const Xml& xml_;
  std::vector<Extent> extents_;  ///< sorted by begin
};

/// Non-overlapping replacements in one text.
class Edits {
 public:
  explicit Edits(std::string_view text) : text_(text) {}

  void replace(std::size_t begin, std::size_t end, std::string with);
  void insert(std::size_t at, std::string what) { replace(at, at, std::move(what)); }
  bool empty() const noexcept { return edits_.empty(); }
  std::string_view text() const noexcept { return text_; }
  /// [begin, end) of the text with the edits applied.
  std::string apply(std::size_t begin, std::size_t end) const;

 private:
  struct Edit {
    std::size_t begin;
    std::size_t end;
    std::string with;
  };
  std::string_view text_;
  std::vector<Edit> edits_;
};

/// Sets, adds or removes attributes of an element so that it has these. Attributes that are not named stay, and those
/// that already have the wanted value (`xml`) keep their spelling.
void edit_attributes(Edits& edits, const Extent& extent, pugi::xml_node element, const std::vector<Attribute>& wanted);

/// Replaces the content of the element `name` with this text, already escaped.
void edit_content(Edits& edits, const Extent& extent, std::string_view name, std::string content);

/// The wanted state of one element of a list of siblings.
struct ListItem {
  std::optional<Extent> old;        ///< its old position; none: new
  std::optional<std::string> text;  ///< its new text; none: unchanged
};

/// How new elements are inserted among the old.
struct ListPlace {
  std::size_t head = 0;      ///< position of the first one if there was no such element
  std::string separator;     ///< line end and indentation before an element
  bool keep_places = false;  ///< the old ones stay in file order whatever their order in the list
};

/// Turns the siblings `old` into `items`: those in both stay where they are as far as the order allows; those only in
/// `old` are removed, with the blanks before them. True if something was inserted.
bool edit_list(Edits& edits, const std::vector<Extent>& old, const std::vector<ListItem>& items,
               const ListPlace& place);

}  // namespace signweave::eaf
