#pragma once
#include <string_view>

namespace signweave {

/// The version of this library and its programs, MAJOR.MINOR.PATCH by Semantic Versioning. It is defined once, in
/// project() of CMakeLists.txt, from which the build generates this function.
std::string_view version() noexcept;

}  // namespace signweave
