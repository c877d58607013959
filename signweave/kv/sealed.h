#pragma once

#include <string>

#include "signweave/core/bytes.h"

namespace signweave::kv {

/// Returns a record: the checksum (u64 XXH3) of the content, followed by the content.
Bytes sealed(ByteSpan content);

/// Returns the content of a sealed record. Throws Error{corrupt} naming `where` if the checksum does not match.
ByteSpan unsealed(ByteSpan record, const std::string& where);

}  // namespace signweave::kv
