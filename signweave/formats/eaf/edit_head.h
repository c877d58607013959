#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/parse.h"
#include "signweave/formats/eaf/splice.h"

/// The parts of eaf_edit.cpp that concern everything but tiers and slots.
namespace signweave::eaf {

/// A file that is being changed.
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

  /// Line end and indentation.
  std::string separator(std::size_t depth) const { return line + std::string(depth * 4, ' '); }
  std::vector<Extent> extents_of(const std::vector<pugi::xml_node>& nodes) const;
  /// An element's text with some attributes set.
  std::string with_attributes(pugi::xml_node element, const std::vector<Attribute>& attributes) const;
  /// Where an element of this name goes among the root's children when there is none yet.
  std::size_t place_at_root(std::string_view name) const;
  void insert_at_root(std::string_view name, std::string text);
  /// Turns "<NAME/>" into "<NAME></NAME>" where something is inserted into it, and gives the end tag a line of its own.
  void open_up(Edits& into, const Extent& extent, std::string_view name, std::size_t depth) const;
};

void edit_root(EditContext& context);
void edit_header(EditContext& context);
/// Tier types, and the languages, constraints and vocabularies that only the changed document refers to.
void edit_types(EditContext& context);

}  // namespace signweave::eaf
