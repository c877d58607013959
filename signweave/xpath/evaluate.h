#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/xpath/expression.h"

namespace signweave::xpath {

struct EvaluateLimits {
  std::optional<std::size_t> limit;  ///< at most so many values
  std::optional<std::chrono::steady_clock::time_point> deadline;
};

/// What an expression gives over one document, in the document's order. The document's text is read as the readers of
/// annotation read it; nothing but this text is looked at: entities stay the letters that they are, no file is opened.
/// `name` stands for the document in errors. Throws QueryError for what only evaluating tells, such as count('a');
/// Error{bad_input} for a text that is no XML, Error{cancelled} when the time is over.
std::vector<Value> evaluate(const Expression& expression, const std::string& name, std::string_view document,
                            const EvaluateLimits& limits = {});

/// Throws QueryError where the expression is not XPath's grammar.
void compile_to_check(const std::string& expression);

}  // namespace signweave::xpath
