#pragma once

#include <cstddef>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"

namespace signweave::eaf {

/// The XML of one annotation file as a tree with line numbers. For formats/eaf, formats/anvil and xpath.
///
/// Encodings: UTF-8 (with or without a byte order mark), UTF-16 and UTF-32 (recognized by the mark, or by the zero
/// bytes of "<"), and ISO-8859-1 if the XML declaration says so. Entities defined by a DOCTYPE are not expanded:
/// "&lol;" stays these five characters, so an entity-expansion bomb is harmless.
class Xml {
 public:
  /// Parses `bytes`, which must outlive this object. `name` is the file name in errors, `wanted` for what to give
  /// instead. Throws Error{bad_input, "NAME:LINE: …"} for text that is empty, binary, truncated or not XML.
  Xml(std::string name, std::string_view bytes, std::string_view wanted = "an EAF file as ELAN saves it");
  Xml(const Xml&) = delete;
  Xml& operator=(const Xml&) = delete;

  pugi::xml_node root() const { return document_.document_element(); }
  const pugi::xml_document& document() const noexcept { return document_; }
  const std::string& name() const noexcept { return name_; }
  /// The text as UTF-8: the bytes themselves, or the result of their conversion. Offsets of nodes point into it.
  std::string_view text() const noexcept { return text_; }
  /// True if the bytes were not UTF-8.
  bool converted() const noexcept { return !converted_.empty(); }
  /// True if the text contains numeric character references ("&#10;").
  bool has_references() const noexcept { return has_references_; }
  /// From 1; 0 if the node has no position.
  std::size_t line_of(pugi::xml_node node) const;

  /// An attribute's value, empty if missing. Valid as long as this object.
  std::string_view attribute(pugi::xml_node node, const char* name) const;
  /// An attribute that must be present and not empty.
  std::string_view required(pugi::xml_node node, const char* name) const;
  /// All text directly inside a node, including blanks.
  std::string content(pugi::xml_node node) const;

  [[noreturn]] void fail(pugi::xml_node node, std::string_view what) const;
  Notice notice(pugi::xml_node node, std::string_view what) const;

 private:
  [[noreturn]] void fail_at(std::size_t offset, std::string_view what) const;
  void decode(std::string_view bytes, std::string_view wanted);
  const std::vector<std::size_t>& line_starts() const;
  std::size_t line_at(std::size_t offset) const;
  std::string where(pugi::xml_node node) const;

  std::string name_;
  std::string converted_;  ///< if the bytes were not UTF-8
  std::string_view text_;
  bool has_references_ = false;                   ///< numeric, to characters; they may name half a surrogate pair
  mutable std::vector<std::size_t> line_starts_;  ///< computed when a line is first needed: most files need none
  pugi::xml_document document_;
  mutable pugi::xml_node last_node_;  ///< whose attribute was last requested
  mutable pugi::xml_attribute last_attribute_;
};

/// XML cannot hold control characters, written out or as references; the parser accepts them, and would cut a label at
/// &#0;. Throws Error{bad_input, "NAME:LINE: …"} if there is one.
void refuse_control_characters(const Xml& xml);

/// Escapes `text` for XML between tags or in a quoted attribute. Throws Error{bad_input} for what XML cannot hold:
/// bytes that are not UTF-8, and control characters; `what` names the text.
std::string escaped(std::string_view text, std::string_view what);

}  // namespace signweave::eaf
