#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "signweave/features/hand_trace.h"
#include "signweave/features/phase_features.h"
#include "signweave/kv/kv_store.h"

namespace signweave::semantic_db {

/// Stores the hands' trace of a recording with its features; replaces an earlier trace. `erase` erases it too.
void put_trace(kv::WriteTransaction& transaction, std::uint64_t generation, const HandTrace& trace);

void erase_trace(kv::WriteTransaction& transaction, std::uint64_t generation);

/// The trace as it was put; nullopt if there is none, or another version measured it. Throws Error{corrupt}; `where`
/// names the recording in it.
std::optional<HandTrace> read_trace(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                    const std::string& where, const Pause& pause = {});

/// The same as `read_features` of semantic_db.h, calling `pause` regularly.
std::optional<RecordingFeatures> read_features(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                               const std::string& where, const Pause& pause);

}  // namespace signweave::semantic_db
