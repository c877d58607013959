#include "signweave/semantic_db/semantic_db.h"

#include "signweave/kv/sealed.h"
#include "signweave/semantic_db/keys.h"

namespace signweave::semantic_db {
namespace {

Bytes read_record(const kv::ReadTransaction& snapshot, char what, std::uint64_t generation, const std::string& where) {
  const auto record = snapshot.get(key_of(what, generation));
  if (!record) ByteReader({}, where).fail("it is missing");
  const ByteSpan content = kv::unsealed(*record, where);
  return {content.begin(), content.end()};
}

}  // namespace

void put(kv::WriteTransaction& transaction, std::uint64_t generation, const SegmentChunk& segments) {
  ByteWriter writer;
  encode(segments, writer);
  transaction.put(key_of('S', generation), kv::sealed(writer.bytes()));
}

void put_features(kv::WriteTransaction& transaction, std::uint64_t generation, const RecordingFeatures& features) {
  ByteWriter writer;
  encode(features, writer);
  transaction.put(key_of('F', generation), kv::sealed(writer.bytes()));
}

void erase(kv::WriteTransaction& transaction, std::uint64_t generation) {
  transaction.erase(key_of('F', generation));
  transaction.erase(key_of('T', generation));
  erase_document(transaction, generation);
  transaction.erase(key_of('S', generation));
}

void for_each_key(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where,
                  const std::function<void(ByteSpan key)>& see) {
  for_each_document_key(snapshot, generation, where, see);
  see(key_of('S', generation));
  for (const char what : {'F', 'T'}) {  // databases of an older layout have none
    if (snapshot.get(key_of(what, generation))) see(key_of(what, generation));
  }
}

Bytes learned_key() {
  return key_of('W');
}

void put_learned(kv::WriteTransaction& transaction, const Learned& learned) {
  ByteWriter writer;
  writer.number(kLearnedVersion);
  writer.number(learned.changes);
  encode(learned.weights, writer);
  encode(learned.durations, writer);
  writer.number(learned.phased_signs);
  writer.number(learned.unphased_signs);
  encode(learned.residuals, writer);
  transaction.put(learned_key(), kv::sealed(writer.bytes()));
}

std::optional<Learned> read_learned(const kv::ReadTransaction& snapshot) {
  const std::string where = "what was learned";
  const auto record = snapshot.get(learned_key());
  if (!record) return std::nullopt;
  ByteReader in(kv::unsealed(*record, where), where);
  if (in.number<std::uint16_t>() != kLearnedVersion) return std::nullopt;
  Learned learned;
  learned.changes = in.number<std::uint64_t>();
  learned.weights = decode_join_weights(in);
  learned.durations = decode_duration_fit(in);
  learned.phased_signs = in.number<std::uint64_t>();
  learned.unphased_signs = in.number<std::uint64_t>();
  learned.residuals = decode_residual_model(in);
  in.finish();
  return learned;
}

std::string_view kind_of(ByteSpan key) noexcept {
  if (key.size() == 1 && key[0] == std::byte{'W'}) return "weights";
  if (key.size() == 1 && key[0] == std::byte{'L'}) return "segment tables";
  if (is_document_key(key)) return "documents";
  if (key.size() != 1 + sizeof(std::uint64_t)) return {};
  if (key[0] == std::byte{'F'}) return "features";
  if (key[0] == std::byte{'T'}) return "traces";
  if (key[0] == std::byte{'I'}) return "segment tables";
  return key[0] == std::byte{'S'} ? "segments" : std::string_view{};
}

std::optional<std::uint64_t> generation_of(ByteSpan key) noexcept {
  if (kind_of(key).empty() || key.size() == 1) return std::nullopt;
  ByteReader in(key.subspan(1), "key");
  return in.number<std::uint64_t>();
}

SegmentChunk read_segments(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where) {
  const Bytes content = read_record(snapshot, 'S', generation, where + ": segments");
  ByteReader reader(content, where + ": segments");
  SegmentChunk chunk = decode_segments(reader);
  reader.finish();
  return chunk;
}

std::optional<RecordingFeatures> read_features(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                               const std::string& where) {
  if (!snapshot.get(key_of('F', generation))) return std::nullopt;
  const Bytes content = read_record(snapshot, 'F', generation, where + ": features");
  ByteReader reader(content, where + ": features");
  return decode_features(reader);
}

std::vector<TimeSpan> phase_spans(const SegmentChunk& segments) {
  std::vector<TimeSpan> spans;
  for (const SegmentRow& row : segments.rows) {
    if (row.kind == RowKind::phase) spans.push_back(row.span);
  }
  return spans;
}

}  // namespace signweave::semantic_db
