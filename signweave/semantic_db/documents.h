#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/kv/kv_store.h"

namespace signweave {

/// How annotation documents are stored (the paper's two ways, section 4.1). Each gives the same answers and the same
/// bytes back.
enum class DocumentStorage : std::uint8_t {
  document = 0,  ///< the text in one record: fast to store                            (stored on disk: never renumber)
  node = 1,      ///< every annotation a record: one of them, or one tier, is read without the others
};

/// "document", "node".
std::string_view name_of(DocumentStorage storage) noexcept;
/// The storage of this name, or none.
std::optional<DocumentStorage> parse_document_storage(std::string_view name) noexcept;

/// An annotation as its document has it.
struct StoredAnnotation {
  std::string tier;  ///< name
  std::string id;    ///< EAF: its ANNOTATION_ID. ANVIL: "aN" for the n-th element of the file
  std::string xml;   ///< its element (ANNOTATION, el), byte for byte
  friend bool operator==(const StoredAnnotation&, const StoredAnnotation&) = default;
};

}  // namespace signweave

/// Annotation documents on a key-value store. A document lies under a generation in one of two ways; which of them, its
/// records tell, so both may stand side by side (docs/store.md).
namespace signweave::semantic_db {

/// Stores a document's bytes, and those of its specification where it has one. What lay under the generation must have
/// been erased. In the caller's transaction.
void put_document(kv::WriteTransaction& transaction, std::uint64_t generation, std::string_view text,
                  std::string_view specification, DocumentStorage storage);

/// Erases a document, stored in either way or in both. Doing it twice is harmless.
void erase_document(kv::WriteTransaction& transaction, std::uint64_t generation);

/// Calls see(key) for the key of each record of a document, in whichever way it is stored. Throws Error{corrupt} where
/// the record that tells how many there are is damaged; `where` names the recording in that error.
void for_each_document_key(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where,
                           const std::function<void(ByteSpan key)>& see);

/// How a document is stored; `document` where there is none.
DocumentStorage storage_of(const kv::ReadTransaction& snapshot, std::uint64_t generation);

/// The bytes as they were put. Throws Error{corrupt} where a record is missing or its checksum is wrong; `where` names
/// the recording in that error.
std::string read_document(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);
/// Its specification, empty where it has none.
std::string read_specification(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);

/// One annotation by its id; none where there is none. In `node` storage three records are read, however long the
/// document is. Throws likewise.
std::optional<StoredAnnotation> read_annotation(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                                std::string_view id, const std::string& where);

/// The annotations of a tier in the order of the document; none where there is no such tier.
std::vector<StoredAnnotation> read_tier(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                        std::string_view tier, const std::string& where);

/// A part of a document that answers like the whole one as long as it is asked about that part only: the elements
/// around it and nothing else beside it.
enum class ExcerptOf {
  tier,        ///< EAF's, by its name
  annotation,  ///< EAF's, by its id
  track,       ///< ANVIL's, by its name
};
/// The excerpt with what bears the name; only what is around where nothing does. No answer where a part cannot stand
/// for the whole: in `document` storage, in a document of the other format, and where the document itself is such
/// (Cut).
std::optional<std::string> read_excerpt(const kv::ReadTransaction& snapshot, std::uint64_t generation, ExcerptOf what,
                                        std::string_view name, const std::string& where);

/// That the records of a document are what it would be stored as; empty where they are, else what is wrong.
std::string fault_of_document(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);

/// True for the keys of these records.
bool is_document_key(ByteSpan key) noexcept;

}  // namespace signweave::semantic_db
