#include "signweave/xpath/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "signweave/core/text.h"
#include "signweave/xpath/evaluate.h"
#include "signweave/xpath/tokens.h"

namespace signweave::xpath {
namespace {

constexpr std::size_t kLongest = std::size_t{1} << 16;
constexpr std::size_t kDeepest = 100;
constexpr std::size_t kMostTokens = 4096;

constexpr std::array kFunctions = {"last",
                                   "position",
                                   "count",
                                   "id",
                                   "local-name",
                                   "namespace-uri",
                                   "name",
                                   "string",
                                   "concat",
                                   "starts-with",
                                   "contains",
                                   "substring-before",
                                   "substring-after",
                                   "substring",
                                   "string-length",
                                   "normalize-space",
                                   "translate",
                                   "boolean",
                                   "not",
                                   "true",
                                   "false",
                                   "lang",
                                   "number",
                                   "sum",
                                   "floor",
                                   "ceiling",
                                   "round"};
constexpr std::array kAxes = {
    "ancestor",  "ancestor-or-self",  "attribute", "child",  "descendant", "descendant-or-self",
    "following", "following-sibling", "namespace", "parent", "preceding",  "preceding-sibling",
    "self"};

template <class List>
bool holds(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

template <class List>
std::string hint(std::string_view word, const List& list) {
  return did_you_mean(word, std::vector<std::string>(list.begin(), list.end()));
}

bool is_node_test(std::string_view word) {
  return word == "node" || word == "text" || word == "comment" || word == "processing-instruction";
}

void check(std::string_view text, const std::vector<Token>& tokens) {
  if (tokens.empty()) fail(text, 0, "there is no expression; write one such as //ANNOTATION_VALUE");
  if (tokens.size() > kMostTokens) fail(text, tokens[kMostTokens].offset, "the expression is too long; shorten it");
  std::vector<const Token*> open;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    const bool before_call = i + 1 < tokens.size() && tokens[i + 1].is("(");
    const bool before_axis = i + 1 < tokens.size() && tokens[i + 1].is("::");
    if (token.is("(") || token.is("[")) {
      open.push_back(&token);
      if (open.size() > kDeepest) {
        fail(text, token.offset, fmt::format("more than {} levels of brackets; simplify it", kDeepest));
      }
    } else if (token.is(")") || token.is("]")) {
      const std::string_view partner = token.is(")") ? "(" : "[";
      if (open.empty() || !open.back()->is(partner)) {
        fail(text, token.offset, fmt::format("there is no '{}' that this closes; remove it", partner));
      }
      open.pop_back();
    } else if (token.is("$")) {
      fail(text, token.offset, "there are no variables; write the value itself");
    } else if (token.kind == Token::Kind::name && token.is_operator) {
      constexpr std::array kOperators = {"and", "or", "mod", "div"};
      if (!holds(kOperators, token.text)) {
        fail(text, token.offset,
             fmt::format("expected an operator or the end, found '{}'{}", printable(token.text),
                         hint(token.text, kOperators)));
      }
    } else if (token.kind == Token::Kind::name && before_axis) {
      if (!holds(kAxes, token.text)) {
        fail(text, token.offset,
             fmt::format("there is no axis '{}'{}", printable(token.text), hint(token.text, kAxes)));
      }
    } else if (token.kind == Token::Kind::name && before_call && !is_node_test(token.text)) {
      if (!holds(kFunctions, token.text)) {
        fail(text, token.offset,
             fmt::format("there is no function '{}'{}", printable(token.text), hint(token.text, kFunctions)));
      }
    }
  }
  if (!open.empty()) {
    fail(text, open.back()->offset,
         fmt::format("this '{}' is not closed; add '{}'", open.back()->text, open.back()->is("(") ? ")" : "]"));
  }
}

/// Checks whether one tier or one annotation is sufficient: the path begins with it, and nothing leads out of it.
class ExcerptFinder {
 public:
  explicit ExcerptFinder(const std::vector<Token>& tokens) : tokens_(tokens), end_(tokens.size()) {}

  std::optional<Excerpt> find() {
    constexpr std::array kWrappers = {"count", "string",        "boolean",        "number",
                                      "sum",   "string-length", "normalize-space"};
    if (name(0) && holds(kWrappers, tokens_[0].text) && symbol(1, "(") && closes(1) == end_ - 1) {
      at_ = 2;
      --end_;
    }
    std::optional<Excerpt> found = head();
    if (!found || !stays_inside()) return std::nullopt;
    return found;
  }

 private:
  struct Head {
    std::array<std::string_view, 2> above;  ///< the elements around it, outermost first
    std::string_view element;
    std::string_view attribute;
    semantic_db::ExcerptOf what;
  };

  bool symbol(std::size_t i, std::string_view text) const { return i < end_ && tokens_[i].is(text); }
  bool name(std::size_t i) const { return i < end_ && tokens_[i].kind == Token::Kind::name; }
  bool name(std::size_t i, std::string_view text) const { return name(i) && tokens_[i].text == text; }

  /// The index of the bracket that closes the one at `open`.
  std::size_t closes(std::size_t open) const {
    std::size_t depth = 0;
    for (std::size_t i = open; i < tokens_.size(); ++i) {
      if (tokens_[i].is("(") || tokens_[i].is("[")) ++depth;
      if ((tokens_[i].is(")") || tokens_[i].is("]")) && --depth == 0) return i;
    }
    return tokens_.size();
  }

  std::optional<Excerpt> head() {
    constexpr Head kHeads[] = {{{"ANNOTATION_DOCUMENT", ""}, "TIER", "TIER_ID", semantic_db::ExcerptOf::tier},
                               {{"", ""}, "ALIGNABLE_ANNOTATION", "ANNOTATION_ID", semantic_db::ExcerptOf::annotation},
                               {{"", ""}, "REF_ANNOTATION", "ANNOTATION_ID", semantic_db::ExcerptOf::annotation},
                               {{"annotation", "body"}, "track", "name", semantic_db::ExcerptOf::track}};
    for (const Head& head : kHeads) {
      std::size_t at = at_;
      if (symbol(at, "//")) {
        ++at;
      } else {
        bool same = !head.above[0].empty();
        for (const std::string_view above : head.above) {
          if (above.empty()) continue;
          same = same && symbol(at, "/") && name(at + 1, above);
          at += 2;
        }
        if (!same || !symbol(at, "/")) continue;
        ++at;
      }
      if (!name(at, head.element) || !symbol(at + 1, "[") || !symbol(at + 2, "@") || !name(at + 3, head.attribute)) {
        continue;
      }
      if (!symbol(at + 4, "=") || at + 5 >= end_ || tokens_[at + 5].kind != Token::Kind::literal) continue;
      if (!symbol(at + 6, "]")) continue;
      at_ = at + 7;
      return Excerpt{head.what, std::string(tokens_[at + 5].text)};
    }
    return std::nullopt;
  }

  /// Whether the rest of the path consists of steps down with predicates that only use descendants. Any doubtful form
  /// is rejected.
  bool stays_inside() const {
    std::size_t depth = 0;  // of predicates and calls
    for (std::size_t i = at_; i < end_; ++i) {
      const Token& token = tokens_[i];
      if (token.is("[")) {
        ++depth;
      } else if (token.is("]")) {
        --depth;
      } else if (token.is("(")) {
        if (i == at_ || !name(i - 1) || tokens_[i - 1].is_operator) return false;
        ++depth;
      } else if (token.is(")")) {
        --depth;
      } else if (token.is("..") || token.is("|") || token.is("$")) {
        return false;
      } else if (token.is("::")) {
        if (i == at_) return false;
        const std::string_view axis = tokens_[i - 1].text;
        if (axis != "child" && axis != "descendant" && axis != "descendant-or-self" && axis != "self" &&
            axis != "attribute") {
          return false;
        }
      } else if (token.is("/") || token.is("//")) {
        // A path from the document's root leads out of it; a relative path follows a step.
        if (depth > 0 && !ends_step(i - 1)) return false;
      } else if (depth == 0) {
        // No operator next to steps: its other operand could be anything.
        const bool step =
            token.kind == Token::Kind::name ? !token.is_operator : token.is("@") || token.is(".") || token.is("*");
        if (!step || !begins_step(i)) return false;
      } else if (token.kind == Token::Kind::name && !token.is_operator) {
        const bool call = symbol(i + 1, "(");
        if (call && (token.text == "id" || token.text == "lang")) return false;
      }
    }
    return depth == 0;
  }

  bool ends_step(std::size_t i) const {
    const Token& token = tokens_[i];
    if (token.kind == Token::Kind::name) return !token.is_operator;
    return token.is("]") || token.is(")") || token.is(".");
  }

  /// Outside predicates: after a slash, an axis or the '@' of an attribute.
  bool begins_step(std::size_t i) const {
    if (i == at_) return false;
    const Token& before = tokens_[i - 1];
    return before.is("/") || before.is("//") || before.is("::") || before.is("@");
  }

  const std::vector<Token>& tokens_;
  std::size_t end_;
  std::size_t at_ = 0;
};

}  // namespace

Expression::Expression(std::string text) : text_(std::move(text)) {
  if (text_.size() > kLongest) fail(text_.substr(0, 80), 0, "the expression is too long: at most 64 KiB");
  if (!is_utf8(text_) || text_.find('\0') != std::string::npos) {
    fail(printable(text_), 0, "the expression is not UTF-8; save or type it as UTF-8");
  }
  const std::vector<Token> tokens = tokens_of(text_);
  check(text_, tokens);
  compile_to_check(text_);
  excerpt_ = ExcerptFinder(tokens).find();
}

std::string_view name_of(Value::Kind kind) noexcept {
  constexpr std::string_view kNames[] = {"document",    "element",   "attribute", "text",   "comment",
                                         "instruction", "namespace", "string",    "number", "boolean"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace signweave::xpath
