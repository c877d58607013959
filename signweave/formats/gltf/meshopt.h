#pragma once

#include <string>
#include <string_view>

#include "signweave/formats/gltf/content.h"

namespace signweave::gltf {

/// Throws Error{bad_input} if a packed view has a stride, count, mode or filter that the extension does not define.
/// `place` is the prefix of an error's text.
void require_unpackable(const PackedView& view, const std::string& place);

/// The bytes of such a view (count times stride), unpacked and filtered. Throws Error{bad_input} if they are damaged.
std::string unpacked(const PackedView& view, std::string_view bytes, const std::string& place);

}  // namespace signweave::gltf
