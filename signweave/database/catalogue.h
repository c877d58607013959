#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signweave/database/database.h"
#include "signweave/database/recording.h"
#include "signweave/kv/kv_store.h"

/// The records that list the content of a database. Internal to `database` and `backup`.
///
/// Keys: 'C' the head; 'R' + u32 slot one recording; 'P' the sweep list. Each is sealed with its checksum and begins
/// with a version byte. Recordings fill slots 0 … count − 1; a removed one is replaced by the last, so listing needs no
/// scan and adding costs the same in a small and a large database.
namespace signweave::catalogue {

/// Version of the records that are written; versions from 2 on can be read.
inline constexpr std::uint8_t kVersion = kDatabaseLayout;

/// True for keys of catalogue records.
bool is_key(ByteSpan key) noexcept;

struct Head {
  int layout = kVersion;              ///< of the stored head; a head is always written in the newest layout
  std::uint64_t changes = 0;          ///< number of commits; a reader that cached another number must read again
  std::uint64_t next_generation = 1;  ///< generations are never reused
  std::uint32_t recordings = 0;
  AccessMode access_mode;                                 ///< for motions to be stored
  float tolerance = 0;                                    ///< for motions to be stored: metres, 0 keeps every bit
  DocumentStorage documents = DocumentStorage::document;  ///< for annotation to be stored
};

/// Motions that a crash may have left behind, or that are to be erased because no recording refers to them.
using SweepList = std::vector<motion_db::StoredMotion>;

/// Return the key of the head, and of the recording in a slot.
Bytes head_key();
Bytes slot_key(std::uint32_t slot);

Head read_head(const kv::ReadTransaction& snapshot);
void write_head(kv::WriteTransaction& transaction, const Head& head);

RecordingInfo read_recording(const kv::ReadTransaction& snapshot, std::uint32_t slot);
void write_recording(kv::WriteTransaction& transaction, std::uint32_t slot, const RecordingInfo& info);
/// Moves an entry byte by byte, even if it is damaged.
void move_recording(kv::WriteTransaction& transaction, std::uint32_t from, std::uint32_t to);
void erase_recording(kv::WriteTransaction& transaction, std::uint32_t slot);

SweepList read_sweep_list(const kv::ReadTransaction& snapshot);
void write_sweep_list(kv::WriteTransaction& transaction, const SweepList& list);

}  // namespace signweave::catalogue
