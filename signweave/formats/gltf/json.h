#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace signweave::gltf {

/// The parts of a glTF file's JSON that a motion is read from; all else (materials, pictures, foreign extras and
/// extensions) is passed over while parsing, so that neither its depth nor its size matters.
///
/// Throws Error{bad_input, "FILE:LINE: …"} for what is no JSON, is nested deeper than any glTF, or has more values than
/// fit a small multiple of the text.
nlohmann::json parse_wanted(const std::string& file, std::string_view text);

/// Holds what was parsed against what glTF says: kinds of values, how many, and numbers of nodes, accessors and the
/// like that exist. Whole numbers written as 1.0 become whole; a channel that moves nothing that is known gets the path
/// "ignored". Throws Error{bad_input, "FILE: animation 0, channel 3: …"}.
void check_against_gltf(const std::string& file, nlohmann::json& json);

}  // namespace signweave::gltf
