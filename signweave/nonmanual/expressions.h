#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/nonmanual/curve.h"

/// Expressions by name: what brows, lids, cheeks, mouth and head do in "brows up" or "neg".
namespace signweave {

// When a marker of the brows begins and ends relative to the signs that it covers: the medians of 84 markers in
// elicited ASL (quartiles −170 to +37 ms and −102 to +128 ms).
inline constexpr Milliseconds kMarkerBegin{-80};
inline constexpr Milliseconds kMarkerEnd{22};

/// A named movement, and when it begins and ends relative to what it accompanies.
struct NamedExpression {
  Curve curve;                        ///< its name is the expression's
  Milliseconds begin = kMarkerBegin;  ///< from the begin of the first stroke, or from the end of the last
  Milliseconds end = kMarkerEnd;      ///< from the end of the last stroke
  bool at_end = false;                ///< `begin` counts from the end of the last stroke, as for a blink
  friend bool operator==(const NamedExpression&, const NamedExpression&) = default;
};
using Expressions = std::vector<NamedExpression>;  ///< each name once

/// The built-in expressions (docs/non-manuals.md).
const Expressions& built_in_expressions();

/// The built-in expressions and those of a file, which replace built-in ones of the same name. Each line is
/// NAME,WHAT,VALUE: an ARKit name and its weight; begin_ms, end_ms, onset_ms, offset_ms; at_end (1 or 0); amount;
/// merge; head_pitch, head_yaw, head_roll, head_pitch_swing, head_yaw_swing, head_roll_swing (degrees), head_hertz,
/// head_delay_ms, head_onset_ms, head_offset_ms. The lines of one name need not be adjacent. A first line
/// "name,what,value", empty lines and lines that begin with # are skipped. Throws Error{bad_input, "FILE:LINE: …"},
/// Error{not_found}, Error{io}.
Expressions read_expressions(const std::filesystem::path& path);
/// The same from text; `file` is its name in errors.
Expressions read_expressions_text(const std::string& file, std::string_view text);

/// The expression of a name, compared in Unicode NFC. Throws Error{not_found, "there is no expression 'brow up'; did
/// you mean brows up?"}.
const NamedExpression& find_expression(const Expressions& all, std::string_view name);

/// The expression over signs, whose strokes are in `strokes`; `begin` and `end` are added to its own. It is at
/// least as long as onset and offset together.
TimedCurve over(const NamedExpression& expression, TimeSpan strokes, Milliseconds begin = Milliseconds(0),
                Milliseconds end = Milliseconds(0));

}  // namespace signweave
