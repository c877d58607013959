#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace signweave::gltf {

/// True for a URI that contains its bytes: "data:application/octet-stream;base64,AAAA".
bool is_data_uri(std::string_view uri);

/// The bytes of a data URI. `place` is the prefix of an error's text. Throws Error{bad_input}.
std::string data_of_uri(const std::string& place, std::string_view uri);

/// The file that a relative URI refers to, in `folder` or below. Throws Error{bad_input} if it would lie elsewhere, or
/// if `folder` is empty.
std::filesystem::path path_of_uri(const std::string& place, std::string_view uri, const std::filesystem::path& folder);

}  // namespace signweave::gltf
