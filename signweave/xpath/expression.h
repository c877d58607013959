#pragma once

#include <optional>
#include <string>

#include "signweave/semantic_db/documents.h"

/// XPath 1.0 over annotation documents (docs/xpath.md).
namespace signweave::xpath {

/// The part of a document that is sufficient to evaluate an expression.
struct Excerpt {
  semantic_db::ExcerptOf what;
  std::string name;
  friend bool operator==(const Excerpt&, const Excerpt&) = default;
};

/// A checked expression: it uses only words and functions of XPath. Throws SyntaxError (core/syntax_error.h), with a
/// caret under the error and a hint, if it does not, and for more than 64 KiB or 100 levels of nesting.
class Expression {
 public:
  explicit Expression(std::string text);

  const std::string& text() const noexcept { return text_; }
  /// nullopt if the whole document is needed.
  const std::optional<Excerpt>& excerpt() const noexcept { return excerpt_; }

 private:
  std::string text_;
  std::optional<Excerpt> excerpt_;
};

/// One result of an expression: a node of the document, or a value.
struct Value {
  enum class Kind { document, element, attribute, text, comment, instruction, name_space, string, number, boolean };
  Kind kind = Kind::string;
  std::string name;   ///< for an element or attribute, with its prefix
  std::string value;  ///< as XPath's string() returns it
  std::string xml;    ///< for a node, its XML; else as `value`
  friend bool operator==(const Value&, const Value&) = default;
};

/// "element", "number", …
std::string_view name_of(Value::Kind kind) noexcept;

}  // namespace signweave::xpath
