#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/xpath/expression.h"

namespace signweave::xpath {

struct EvaluateLimits {
  std::optional<std::size_t> limit;  ///< maximum number of values
  std::optional<std::chrono::steady_clock::time_point> deadline;
};

/// The values of an expression over one document, in document order. The document's text is parsed as the annotation
/// readers parse it, and nothing but this text is used: entities are not expanded, no file is opened. `name` names the
/// document in errors. Throws SyntaxError for errors found only by evaluation, such as count('a'); Error{bad_input} for
/// a text that is not XML; Error{cancelled} when the deadline has passed.
std::vector<Value> evaluate(const Expression& expression, const std::string& name, std::string_view document,
                            const EvaluateLimits& limits = {});

/// Throws SyntaxError if the expression does not match the grammar of XPath.
void compile_to_check(const std::string& expression);

}  // namespace signweave::xpath
