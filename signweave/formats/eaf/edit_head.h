#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/parse.h"
#include "signweave/formats/eaf/splice.h"

/// The parts of edit.cpp that deal with everything except tiers and slots.
namespace signweave::eaf {

/// A file that is being edited.
struct EditContext {
  EditContext(const Xml& source, const FileParts& parts, const CheckedDocument& wanted);

  const Xml& xml;
  const FileParts& old;
  const CheckedDocument& checked;
  const AnnotationDocument& now;  ///< the checked document
  Extents extents;
  Edits edits;
  std::string line;  ///< the file's line end
  bool inserted_at_root = false;

  /// A line end followed by indentation.
  std::string separator(std::size_t depth) const { return line + std::string(depth * 4, ' '); }
  std::vector<Extent> extents_of(const std::vector<pugi::xml_node>& nodes) const;
  /// An element's text with the given attributes set.
  std::string with_attributes(pugi::xml_node element, const std::vector<Attribute>& attributes) const;
  /// The position of a new element of this name among the root's children when there is none yet.
  std::size_t place_at_root(std::string_view name) const;
  void insert_at_root(std::string_view name, std::string text);
  /// Turns "<NAME/>" into "<NAME></NAME>" when something is inserted into it, and puts the end tag on its own line.
  void open_up(Edits& into, const Extent& extent, std::string_view name, std::size_t depth) const;
};

void edit_root(EditContext& context);
void edit_header(EditContext& context);
/// Edits tier types, and the languages, constraints and vocabularies to which only the changed document refers.
void edit_types(EditContext& context);

}  // namespace signweave::eaf
