#pragma once

#include <string>
#include <vector>

namespace signweave::calls {

/// The help of the parameter `signing_space`.
inline constexpr const char* kSigningSpaceHelp = "in .svg: the signer's heights and zones behind each figure";

/// Throws Error{bad_input} if a signing space is to be drawn and none of the files is a contact sheet.
void check_signing_space(bool wanted, const std::vector<std::string>& paths);

}  // namespace signweave::calls
