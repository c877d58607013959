#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/xml.h"

/// Changing an XML text in some places and leaving every other byte alone. For eaf_edit.cpp.
namespace signweave::eaf {

/// Where an element lies in the text: "<NAME …>" is [begin, open_end), "</NAME>" is [close_begin, end).
struct Extent {
  std::size_t begin = 0;
  std::size_t open_end = 0;
  std::size_t close_begin = 0;  ///< as open_end for "<NAME/>"
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
  std::vector<Extent> extents_;  ///< by begin
};

/// Replacements in one text, none of which overlap.
class Edits {
 public:
  explicit Edits(std::string_view text) : text_(text) {}

  void replace(std::size_t begin, std::size_t end, std::string with);
  void insert(std::size_t at, std::string what) { replace(at, at, std::move(what)); }
  bool empty() const noexcept { return edits_.empty(); }
  std::string_view text() const noexcept { return text_; }
  /// [begin, end) of the text with the edits made.
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

/// Sets, adds or removes attributes of an element so that it has these; attributes that are not named stay, and so
/// does the writing of those whose value (`xml`) is the wanted one.
void edit_attributes(Edits& edits, const Extent& extent, pugi::xml_node element, const std::vector<Attribute>& wanted);

/// Gives the element `name` this text, already escaped, for content, in place of all that it holds.
void edit_content(Edits& edits, const Extent& extent, std::string_view name, std::string content);

/// One element of a list of siblings as it shall become.
struct ListItem {
  std::optional<Extent> old;        ///< where it was; none: new
  std::optional<std::string> text;  ///< its new text; none: as it was
};

/// How new elements are set among the old.
struct ListPlace {
  std::size_t head = 0;      ///< where the first goes when there was no such element
  std::string separator;     ///< line end and indentation before an element
  bool keep_places = false;  ///< the old ones stay in file order whatever their order in the list
};

/// Turns the siblings `old` into `items`: those that are in both stay where they are as far as the order allows, those
/// that are in `old` only go, with the blanks before them. True where something is inserted.
bool edit_list(Edits& edits, const std::vector<Extent>& old, const std::vector<ListItem>& items,
               const ListPlace& place);

}  // namespace signweave::eaf
