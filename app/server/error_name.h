#pragma once

#include <string_view>

#include "signweave/core/error.h"

namespace signweave::server {

/// What clients are told of a kind of fault, over HTTP and on streams: "not_found".
std::string_view name_of(ErrorCode code) noexcept;

}  // namespace signweave::server
