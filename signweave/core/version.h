#pragma once
#include <string_view>

namespace signweave {

/// The version of this library and its programs, MAJOR.MINOR.PATCH by Semantic Versioning. It is stated once, in the
/// project() of CMakeLists.txt; the build generates this function from there.
std::string_view version() noexcept;

}  // namespace signweave
