#pragma once

#include <string>
#include <string_view>

/// Text in drawings. Internal to drawing.
namespace signweave {

/// Escapes a text of any script for an element or attribute of an SVG: markup is escaped, control characters become
/// blanks, and bytes that are not UTF-8 become question marks.
std::string svg_text(std::string_view text);

/// The approximate width of a text in ems; the viewer's font is not known here.
double svg_ems(std::string_view text);

}  // namespace signweave
