#pragma once

#include <string>

#include "signweave/core/bytes.h"

namespace signweave::kv {

/// A record with its checksum in front: u64 XXH3 of what follows.
Bytes sealed(ByteSpan content);

/// The content of a sealed record. Throws Error{corrupt} naming `where` where the checksum does not fit.
ByteSpan unsealed(ByteSpan record, const std::string& where);

}  // namespace signweave::kv
