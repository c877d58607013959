#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace signweave::gltf {

/// True for what holds its bytes itself: "data:application/octet-stream;base64,AAAA".
bool is_data_uri(std::string_view uri);

/// The bytes of such. `place` stands before an error's text. Throws Error{bad_input}.
std::string data_of_uri(const std::string& place, std::string_view uri);

/// The file that a relative URI means, in `folder` or below. Throws Error{bad_input} where it would lie elsewhere, or
/// where `folder` is empty.
std::filesystem::path path_of_uri(const std::string& place, std::string_view uri, const std::filesystem::path& folder);

}  // namespace signweave::gltf
