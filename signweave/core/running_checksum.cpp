#include "signweave/core/running_checksum.h"

#include <xxhash.h>

#include <new>

namespace signweave {
namespace {

XXH3_state_t* state_of(void* state) noexcept {
  return static_cast<XXH3_state_t*>(state);
}

}  // namespace

RunningChecksum::RunningChecksum() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_64bits_reset(state_of(state_.get()));
}

void RunningChecksum::add(ByteSpan bytes) noexcept {
  XXH3_64bits_update(state_of(state_.get()), bytes.data(), bytes.size());
}

std::uint64_t RunningChecksum::value() const noexcept {
  return XXH3_64bits_digest(state_of(state_.get()));
}

void RunningChecksum::Free::operator()(void* state) const noexcept {
  XXH3_freeState(state_of(state));
}

}  // namespace signweave
