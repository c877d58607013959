#include "signweave/core/bytes.h"

#include <xxhash.h>

namespace signweave {

std::uint64_t checksum(ByteSpan bytes) noexcept {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace signweave
