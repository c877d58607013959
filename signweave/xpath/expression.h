#pragma once

#include <optional>
#include <string>

#include "signweave/semantic_db/documents.h"

/// XPath 1.0 over annotation documents (docs/xpath.md).
namespace signweave::xpath {

/// The part of a document that tells everything that an expression asks for.
struct Excerpt {
  semantic_db::ExcerptOf what;
  std::string name;
  friend bool operator==(const Excerpt&, const Excerpt&) = default;
};

/// An expression that has been looked through: its words are XPath's, its functions are those that there are. Throws
/// QueryError (query/parse.h), with a caret under the place and a hint, where they are not; for more than 64 KiB or 100
/// levels of nesting, too.
class Expression {
 public:
  explicit Expression(std::string text);

  const std::string& text() const noexcept { return text_; }
  /// None where the whole document must be looked at.
  const std::optional<Excerpt>& excerpt() const noexcept { return excerpt_; }

 private:
  std::string text_;
  std::optional<Excerpt> excerpt_;
};

/// One thing that an expression gives: a node of the document, or a value.
struct Value {
  enum class Kind { document, element, attribute, text, comment, instruction, name_space, string, number, boolean };
  Kind kind = Kind::string;
  std::string name;   ///< of an element or attribute, with its prefix
  std::string value;  ///< as XPath's string() gives it
  std::string xml;    ///< of a node, as XML; else as `value`
  friend bool operator==(const Value&, const Value&) = default;
};

/// "element", "number", …
std::string_view name_of(Value::Kind kind) noexcept;

}  // namespace signweave::xpath
