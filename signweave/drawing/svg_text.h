#pragma once

#include <string>
#include <string_view>

/// Text in drawings. Part of formats, not for others.
namespace signweave {

/// A text of any script as it may stand in an element or attribute of an SVG: markup escaped, control characters made
/// blanks, bytes that are no UTF-8 made question marks.
std::string svg_text(std::string_view text);

/// About how wide a text is, in its font's size: nothing here knows the font that a viewer takes.
double svg_ems(std::string_view text);

}  // namespace signweave
