#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace signweave::gltf {

/// The parts of a glTF file's JSON from which a motion is read; everything else (materials, pictures, unknown extras
/// and extensions) is skipped while parsing, so that neither its depth nor its size matters.
///
/// Throws Error{bad_input, "FILE:LINE: …"} if the text is not JSON, is nested deeper than any glTF, or has more values
/// than fit a small multiple of the text.
nlohmann::json parse_wanted(const std::string& file, std::string_view text);

/// Checks the parsed JSON against the glTF specification: the kinds and number of values, and that the nodes, accessors
/// and so on that it refers to exist. Integers written as 1.0 become integers; a channel that moves nothing known gets
/// the path "ignored". Throws Error{bad_input, "FILE: animation 0, channel 3: …"}.
void check_against_gltf(const std::string& file, nlohmann::json& json);

}  // namespace signweave::gltf
