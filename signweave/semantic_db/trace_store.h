#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "signweave/features/hand_trace.h"
#include "signweave/features/phase_features.h"
#include "signweave/kv/kv_store.h"

namespace signweave::semantic_db {

/// Stores the hands' trace of a document's recording beside its features; instead of what was. `erase` erases it too.
void put_trace(kv::WriteTransaction& transaction, std::uint64_t generation, const HandTrace& trace);

void erase_trace(kv::WriteTransaction& transaction, std::uint64_t generation);

/// As it was put; none where there is none, or another version measured. Throws Error{corrupt}, in which `where` names
/// the recording.
std::optional<HandTrace> read_trace(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                    const std::string& where, const Pause& pause = {});

/// What `read_features` (semantic_db.h) gives of all at once.
std::optional<RecordingFeatures> read_features(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                               const std::string& where, const Pause& pause);

}  // namespace signweave::semantic_db
