#include "signweave/semantic_db/documents.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "signweave/kv/sealed.h"
#include "signweave/semantic_db/document_cut.h"
#include "signweave/semantic_db/keys.h"

namespace signweave {

std::string_view name_of(DocumentStorage storage) noexcept {
  return storage == DocumentStorage::node ? "node" : "document";
}

std::optional<DocumentStorage> parse_document_storage(std::string_view name) noexcept {
  for (const DocumentStorage one : {DocumentStorage::document, DocumentStorage::node}) {
    if (name == name_of(one)) return one;
  }
  return std::nullopt;
}

}  // namespace signweave

namespace signweave::semantic_db {
namespace {

// Keys: a letter, the generation and, if there are several records, a u32 number.
constexpr char kWhole = 'D';          // the text, in `document` storage
constexpr char kSpecification = 'X';  // of ANVIL
constexpr char kDirectory = 'N';      // in `node` storage: the directory
constexpr char kFrame = 'T';   // 0: the text between the tiers; n: the text between the annotations of tier n - 1
constexpr char kPiece = 'A';   // one annotation
constexpr char kBucket = 'B';  // maps ids to pieces

constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kIdsPerBucket = 64;

/// A record and its key.
struct Made {
  Bytes key;
  Bytes content;  ///< not sealed yet
};

struct DirectoryTier {
  std::string name;
  std::uint32_t first_piece = 0;
  std::uint32_t pieces = 0;
};

struct Directory {
  bool exact = false;
  std::uint32_t pieces = 0;
  std::uint32_t buckets = 0;  ///< a power of two, or 0
  std::string around;
  std::string closing;
  std::vector<DirectoryTier> tiers;
};

std::size_t bucket_of(std::string_view id, std::uint32_t buckets) {
  return static_cast<std::size_t>(checksum(bytes_of(id)) & (buckets - 1));
}

/// All records of a document in `node` storage.
std::vector<Made> node_records(std::uint64_t generation, std::string_view text) {
  const Cut cut = cut_document(text);
  const auto pieces = static_cast<std::uint32_t>(cut.pieces.size());
  const auto buckets = static_cast<std::uint32_t>(
      pieces == 0 ? 0 : std::bit_ceil((cut.pieces.size() + kIdsPerBucket - 1) / kIdsPerBucket));
  std::vector<Made> records;

  ByteWriter directory;
  directory.number(kVersion);
  directory.number(static_cast<std::uint8_t>(cut.exact ? 1 : 0));
  directory.number(pieces);
  directory.number(buckets);
  directory.text(cut.around);
  directory.text(cut.closing);
  directory.number(static_cast<std::uint32_t>(cut.tiers.size()));
  for (const CutTier& tier : cut.tiers) {
    directory.text(tier.name);
    directory.number(static_cast<std::uint32_t>(tier.first_piece));
    directory.number(static_cast<std::uint32_t>(tier.pieces));
  }
  records.push_back({key_of(kDirectory, generation), directory.take()});

  ByteWriter between;
  std::size_t at = 0;
  for (const CutTier& tier : cut.tiers) {
    between.text(text.substr(at, tier.begin - at));
    at = tier.end;
  }
  between.text(text.substr(at));
  records.push_back({key_of(kFrame, generation, 0), between.take()});

  for (std::size_t t = 0; t < cut.tiers.size(); ++t) {
    const CutTier& tier = cut.tiers[t];
    ByteWriter frame;
    frame.number(static_cast<std::uint32_t>(tier.tag_end - tier.begin));
    at = tier.begin;
    for (std::size_t i = tier.first_piece; i < tier.first_piece + tier.pieces; ++i) {
      frame.text(text.substr(at, cut.pieces[i].begin - at));
      at = cut.pieces[i].end;
    }
    frame.text(text.substr(at, tier.end - at));
    records.push_back({key_of(kFrame, generation, t + 1), frame.take()});
  }

  std::vector<ByteWriter> lists(buckets);
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    const CutPiece& piece = cut.pieces[i];
    const ByteSpan bytes = bytes_of(text.substr(piece.begin, piece.end - piece.begin));
    records.push_back({key_of(kPiece, generation, i), Bytes(bytes.begin(), bytes.end())});
    if (piece.id.empty()) continue;
    ByteWriter& list = lists[bucket_of(piece.id, buckets)];
    list.text(piece.id);
    list.number(static_cast<std::uint32_t>(i));
  }
  for (std::size_t b = 0; b < lists.size(); ++b) records.push_back({key_of(kBucket, generation, b), lists[b].take()});
  return records;
}

/// A document in `node` storage; only requested parts are read.
class Nodes {
 public:
  Nodes(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where)
      : snapshot_(snapshot), generation_(generation), where_(where + ": annotation document") {
    ByteReader in(record(key_of(kDirectory, generation)), where_);
    const auto version = in.number<std::uint8_t>();
    if (version != kVersion) {
      throw Error(ErrorCode::unsupported,
                  fmt::format("{}: stored by a later version of signweave; use that one", where_));
    }
    directory_.exact = in.number<std::uint8_t>() != 0;
    directory_.pieces = in.number<std::uint32_t>();
    directory_.buckets = in.number<std::uint32_t>();
    directory_.around = in.text();
    directory_.closing = in.text();
    std::uint64_t pieces = 0;
    for (std::size_t n = in.count(12); n > 0; --n) {
      DirectoryTier tier{.name = in.text()};
      tier.first_piece = in.number<std::uint32_t>();
      tier.pieces = in.number<std::uint32_t>();
      if (tier.first_piece != pieces) in.fail("its tiers do not follow each other");
      pieces += tier.pieces;
      directory_.tiers.push_back(std::move(tier));
    }
    if (pieces != directory_.pieces) in.fail("its annotations are not those of its tiers");
    if ((directory_.buckets & (directory_.buckets - 1)) != 0 || (directory_.buckets == 0) != (pieces == 0)) {
      in.fail("an impossible index");
    }
    in.finish();
  }

  const Directory& directory() const noexcept { return directory_; }

  std::string whole() const {
    std::string text;
    const Bytes between_bytes = copy(key_of(kFrame, generation_, 0));
    ByteReader between(between_bytes, where_);
    for (std::size_t t = 0; t < directory_.tiers.size(); ++t) {
      text += between.text();
      append_tier(t, text);
    }
    text += between.text();
    between.finish();
    return text;
  }

  /// Index of the tier with this name, or the number of tiers.
  std::size_t find_tier(std::string_view name) const noexcept {
    const auto at = std::ranges::find(directory_.tiers, name, &DirectoryTier::name);
    return static_cast<std::size_t>(at - directory_.tiers.begin());
  }

  /// The tier of a piece.
  std::size_t tier_of(std::uint32_t piece) const noexcept {
    // The last tier whose first piece is not after it; tiers without pieces begin where their successor begins.
    const auto after = std::ranges::upper_bound(directory_.tiers, piece, {}, &DirectoryTier::first_piece);
    return static_cast<std::size_t>(after - directory_.tiers.begin()) - 1;
  }

  std::optional<std::uint32_t> find(std::string_view id) const {
    if (directory_.buckets == 0 || id.empty()) return std::nullopt;
    ByteReader in(record(key_of(kBucket, generation_, bucket_of(id, directory_.buckets))), where_);
    while (in.left() > 0) {
      const auto size = in.number<std::uint32_t>();
      const bool same = text_of(in.take(size)) == id;
      const auto piece = in.number<std::uint32_t>();
      if (!same) continue;
      if (piece >= directory_.pieces) in.fail("an annotation that does not exist");
      return piece;
    }
    return std::nullopt;
  }

  std::string_view piece(std::uint32_t number) const { return text_of(record(key_of(kPiece, generation_, number))); }

  void append_tier(std::size_t tier, std::string& text) const {
    const Bytes frame_bytes = copy(key_of(kFrame, generation_, tier + 1));
    ByteReader frame(frame_bytes, where_);
    frame.number<std::uint32_t>();
    const DirectoryTier& from = directory_.tiers[tier];
    for (std::uint32_t i = 0; i < from.pieces; ++i) {
      text += frame.text();
      text += piece(from.first_piece + i);
    }
    text += frame.text();
    frame.finish();
  }

  std::string opening_tag(std::size_t tier) const {
    ByteReader frame(record(key_of(kFrame, generation_, tier + 1)), where_);
    const auto size = frame.number<std::uint32_t>();
    const std::string first = frame.text();
    if (size > first.size()) frame.fail("a tag longer than the text");
    return first.substr(0, size);
  }

 private:
  /// Borrowed from the store until the snapshot ends or, with some engines, the next record is read.
  ByteSpan record(const Bytes& key) const {
    const auto found = snapshot_.get(key, buffer_);
    if (!found) ByteReader({}, where_).fail("a part of it is missing");
    return kv::unsealed(*found, where_);
  }
  Bytes copy(const Bytes& key) const {
    const ByteSpan content = record(key);
    return {content.begin(), content.end()};
  }

  const kv::ReadTransaction& snapshot_;
  std::uint64_t generation_;
  std::string where_;
  Directory directory_;
  mutable Bytes buffer_;
};

std::string read_whole(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where) {
  const auto record = snapshot.get(key_of(kWhole, generation));
  if (!record) ByteReader({}, where + ": annotation document").fail("it is missing");
  return std::string(text_of(kv::unsealed(*record, where + ": annotation document")));
}

StoredAnnotation annotation_at(std::string_view text, const CutTier& tier, const CutPiece& piece) {
  return {tier.name, piece.id, std::string(text.substr(piece.begin, piece.end - piece.begin))};
}

}  // namespace

void put_document(kv::WriteTransaction& transaction, std::uint64_t generation, std::string_view text,
                  std::string_view specification, DocumentStorage storage) {
  if (!specification.empty()) {
    transaction.put(key_of(kSpecification, generation), kv::sealed(bytes_of(specification)));
  }
  if (storage == DocumentStorage::document) {
    transaction.put(key_of(kWhole, generation), kv::sealed(bytes_of(text)));
    return;
  }
  for (const Made& one : node_records(generation, text)) transaction.put(one.key, kv::sealed(one.content));
}

void erase_document(kv::WriteTransaction& transaction, std::uint64_t generation) {
  transaction.erase(key_of(kWhole, generation));
  transaction.erase(key_of(kSpecification, generation));
  transaction.erase(key_of(kDirectory, generation));
  // Numbers are contiguous, so this works even if the directory is damaged.
  for (const char what : {kFrame, kPiece, kBucket}) {
    for (std::size_t i = 0; transaction.erase(key_of(what, generation, i)); ++i) {
    }
  }
}

void for_each_document_key(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where,
                           const std::function<void(ByteSpan key)>& see) {
  if (snapshot.get(key_of(kSpecification, generation))) see(key_of(kSpecification, generation));
  if (storage_of(snapshot, generation) == DocumentStorage::document) {
    see(key_of(kWhole, generation));
    return;
  }
  const Directory directory = Nodes(snapshot, generation, where).directory();
  see(key_of(kDirectory, generation));
  for (std::size_t i = 0; i <= directory.tiers.size(); ++i) see(key_of(kFrame, generation, i));
  for (std::size_t i = 0; i < directory.pieces; ++i) see(key_of(kPiece, generation, i));
  for (std::size_t i = 0; i < directory.buckets; ++i) see(key_of(kBucket, generation, i));
}

DocumentStorage storage_of(const kv::ReadTransaction& snapshot, std::uint64_t generation) {
  return snapshot.get(key_of(kDirectory, generation)) ? DocumentStorage::node : DocumentStorage::document;
}

std::string read_document(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where) {
  if (storage_of(snapshot, generation) == DocumentStorage::document) return read_whole(snapshot, generation, where);
  return Nodes(snapshot, generation, where).whole();
}

std::string read_specification(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                               const std::string& where) {
  const auto record = snapshot.get(key_of(kSpecification, generation));
  if (!record) return {};
  return std::string(text_of(kv::unsealed(*record, where + ": specification of the annotation document")));
}

std::optional<StoredAnnotation> read_annotation(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                                std::string_view id, const std::string& where) {
  if (storage_of(snapshot, generation) == DocumentStorage::node) {
    const Nodes nodes(snapshot, generation, where);
    const std::optional<std::uint32_t> piece = nodes.find(id);
    if (!piece) return std::nullopt;
    const DirectoryTier& tier = nodes.directory().tiers[nodes.tier_of(*piece)];
    return StoredAnnotation{tier.name, std::string(id), std::string(nodes.piece(*piece))};
  }
  const std::string text = read_whole(snapshot, generation, where);
  const Cut cut = cut_document(text);
  for (const CutTier& tier : cut.tiers) {
    for (std::size_t i = tier.first_piece; i < tier.first_piece + tier.pieces && !id.empty(); ++i) {
      if (cut.pieces[i].id == id) return annotation_at(text, tier, cut.pieces[i]);
    }
  }
  return std::nullopt;
}

std::vector<StoredAnnotation> read_tier(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                        std::string_view tier, const std::string& where) {
  std::string text;
  const bool in_nodes = storage_of(snapshot, generation) == DocumentStorage::node;
  std::size_t first = 0;
  if (in_nodes) {
    const Nodes nodes(snapshot, generation, where);
    const std::size_t place = nodes.find_tier(tier);
    if (place == nodes.directory().tiers.size()) return {};
    first = nodes.directory().tiers[place].first_piece;
    text = nodes.directory().around;
    nodes.append_tier(place, text);
    text += nodes.directory().closing;
  } else {
    text = read_whole(snapshot, generation, where);
  }
  const Cut cut = cut_document(text);
  const auto found = std::ranges::find(cut.tiers, tier, &CutTier::name);
  std::vector<StoredAnnotation> list;
  for (std::size_t i = 0; found != cut.tiers.end() && i < found->pieces; ++i) {
    list.push_back(annotation_at(text, *found, cut.pieces[found->first_piece + i]));
    // ANVIL's elements are numbered over the whole document.
    if (in_nodes && text.starts_with("<annotation")) list.back().id = fmt::format("a{}", first + i + 1);
  }
  return list;
}

std::optional<std::string> read_excerpt(const kv::ReadTransaction& snapshot, std::uint64_t generation, ExcerptOf what,
                                        std::string_view name, const std::string& where) {
  if (storage_of(snapshot, generation) == DocumentStorage::document) return std::nullopt;
  const Nodes nodes(snapshot, generation, where);
  const Directory& directory = nodes.directory();
  const bool anvil = directory.closing.ends_with("</annotation>");
  if (!directory.exact || anvil != (what == ExcerptOf::track)) return std::nullopt;
  std::string text = directory.around;
  if (what != ExcerptOf::annotation) {
    const std::size_t tier = nodes.find_tier(name);
    if (tier < directory.tiers.size()) nodes.append_tier(tier, text);
  } else if (const std::optional<std::uint32_t> piece = nodes.find(name)) {
    text += nodes.opening_tag(nodes.tier_of(*piece));
    text += nodes.piece(*piece);
    text += "</TIER>";
  }
  return text + directory.closing;
}

std::string fault_of_document(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where) {
  const std::string text = read_document(snapshot, generation, where);
  if (storage_of(snapshot, generation) == DocumentStorage::document) return {};
  for (const Made& one : node_records(generation, text)) {
    const auto record = snapshot.get(one.key);
    if (record && std::ranges::equal(kv::unsealed(*record, where), one.content)) continue;
    return fmt::format("{}: the records of its annotations are not those of its document; import it again", where);
  }
  return {};
}

bool is_document_key(ByteSpan key) noexcept {
  if (key.empty()) return false;
  const char what = static_cast<char>(key[0]);
  const std::size_t plain = 1 + sizeof(std::uint64_t);
  if (key.size() == plain) return what == kWhole || what == kSpecification || what == kDirectory;
  return key.size() == plain + sizeof(std::uint32_t) && (what == kFrame || what == kPiece || what == kBucket);
}

}  // namespace signweave::semantic_db
