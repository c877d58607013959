#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/kv/kv_store.h"

namespace signweave {

/// How annotation documents are stored (the two methods of the paper, section 4.1). Both give the same answers and
/// return the same bytes.
enum class DocumentStorage : std::uint8_t {
  document = 0,  ///< the text in one record: fast to store                            (stored on disk: never renumber)
  node = 1,      ///< every annotation is a record: one of them, or one tier, is read without the others
};

/// "document", "node".
std::string_view name_of(DocumentStorage storage) noexcept;
/// The storage with this name, or nullopt.
std::optional<DocumentStorage> parse_document_storage(std::string_view name) noexcept;

/// An annotation as its document contains it.
struct StoredAnnotation {
  std::string tier;  ///< name
  std::string id;    ///< EAF: its ANNOTATION_ID. ANVIL: "aN" for the n-th element of the file
  std::string xml;   ///< its element (ANNOTATION, el), byte for byte
  friend bool operator==(const StoredAnnotation&, const StoredAnnotation&) = default;
};

}  // namespace signweave

/// Annotation documents on a key-value store. A document is stored under a generation by one of two methods; its
/// records identify the method, so one database may contain both (docs/store.md).
namespace signweave::semantic_db {

/// Stores a document's bytes, and those of its specification if it has one, in the caller's transaction. Any earlier
/// document of the generation must have been erased.
void put_document(kv::WriteTransaction& transaction, std::uint64_t generation, std::string_view text,
                  std::string_view specification, DocumentStorage storage);

/// Erases a document, whichever method stored it. Idempotent.
void erase_document(kv::WriteTransaction& transaction, std::uint64_t generation);

/// Calls see(key) for the key of each record of a document, whichever method stored it. Throws Error{corrupt} if the
/// record with the number of records is damaged; `where` names the recording in that error.
void for_each_document_key(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where,
                           const std::function<void(ByteSpan key)>& see);

/// How a document is stored; `document` if there is none.
DocumentStorage storage_of(const kv::ReadTransaction& snapshot, std::uint64_t generation);

/// The bytes as they were put. Throws Error{corrupt} if a record is missing or its checksum is wrong; `where` names the
/// recording in that error.
std::string read_document(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);
/// Its specification; empty if it has none.
std::string read_specification(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);

/// The annotation with an id, or nullopt. In `node` storage three records are read, whatever the document's length.
/// Throws as `read_document`.
std::optional<StoredAnnotation> read_annotation(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                                std::string_view id, const std::string& where);

/// The annotations of a tier in document order; empty if there is no such tier.
std::vector<StoredAnnotation> read_tier(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                        std::string_view tier, const std::string& where);

/// A part of a document that gives the same answers as the whole document to queries about that part only: its elements
/// and the elements around it.
enum class ExcerptOf {
  tier,        ///< of EAF, by name
  annotation,  ///< of EAF, by id
  track,       ///< of ANVIL, by name
};
/// The excerpt with the elements of that name; only the surrounding elements if there are none. Returns nullopt if a
/// part cannot replace the whole: in `document` storage, for a document of the other format, and for a document that is
/// not exact (Cut).
std::optional<std::string> read_excerpt(const kv::ReadTransaction& snapshot, std::uint64_t generation, ExcerptOf what,
                                        std::string_view name, const std::string& where);

/// Checks that the records of a document are those it would be stored as. Returns an empty string if they are, else a
/// description of the fault.
std::string fault_of_document(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);

/// Whether a key is that of such a record.
bool is_document_key(ByteSpan key) noexcept;

}  // namespace signweave::semantic_db
