#pragma once

#include <cstddef>
#include <cstdint>

#include "signweave/core/bytes.h"

namespace signweave::semantic_db {

// One letter for the kind of record, then the generation: 'D' document, 'S' segments, 'F' features, 'I' segment table.
// Records that exist once per database have a key of the letter alone: 'W' learned weights, 'L' list of the segment
// tables.

inline Bytes key_of(char what, std::uint64_t generation) {
  ByteWriter key;
  key.number(what);
  key.number(generation);
  return key.take();
}

/// The key of one of several records with that letter.
inline Bytes key_of(char what, std::uint64_t generation, std::size_t number) {
  ByteWriter key;
  key.number(what);
  key.number(generation);
  key.number(static_cast<std::uint32_t>(number));
  return key.take();
}

inline Bytes key_of(char what) {
  ByteWriter key;
  key.number(what);
  return key.take();
}

}  // namespace signweave::semantic_db
