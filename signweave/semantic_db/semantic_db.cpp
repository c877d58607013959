#include "signweave/semantic_db/semantic_db.h"

#include <map>

#include "signweave/kv/sealed.h"

namespace signweave::semantic_db {
namespace {

// Key: one letter for what the record is ('D' document, 'S' segments, 'F' features), then the generation. The weights
// are of all documents, and their key is the letter 'W' alone.
Bytes key_of(char what, std::uint64_t generation) {
  ByteWriter key;
  key.number(what);
  key.number(generation);
  return key.take();
}

Bytes weights_key() {
  ByteWriter key;
  key.number('W');
  return key.take();
}

Bytes read_record(const kv::ReadTransaction& snapshot, char what, std::uint64_t generation, const std::string& where) {
  const auto record = snapshot.get(key_of(what, generation));
  if (!record) ByteReader({}, where).fail("it is missing");
  const ByteSpan content = kv::unsealed(*record, where);
  return {content.begin(), content.end()};
}

}  // namespace

void put(kv::WriteTransaction& transaction, std::uint64_t generation, std::string_view document,
         const SegmentChunk& segments) {
  transaction.put(key_of('D', generation), kv::sealed(bytes_of(document)));
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
  transaction.erase(key_of('D', generation));
  transaction.erase(key_of('S', generation));
}

void put_weights(kv::WriteTransaction& transaction, const StoredWeights& weights) {
  ByteWriter writer;
  writer.number(kWeightsVersion);
  writer.number(weights.changes);
  encode(weights.weights, writer);
  transaction.put(weights_key(), kv::sealed(writer.bytes()));
}

std::optional<StoredWeights> read_weights(const kv::ReadTransaction& snapshot) {
  const std::string where = "weights of the selection";
  const auto record = snapshot.get(weights_key());
  if (!record) return std::nullopt;
  ByteReader in(kv::unsealed(*record, where), where);
  if (in.number<std::uint16_t>() != kWeightsVersion) return std::nullopt;
  StoredWeights stored;
  stored.changes = in.number<std::uint64_t>();
  stored.weights = decode_join_weights(in);
  in.finish();
  return stored;
}

std::string_view kind_of(ByteSpan key) noexcept {
  if (key.size() == 1 && key[0] == std::byte{'W'}) return "weights";
  if (key.size() != 1 + sizeof(std::uint64_t)) return {};
  if (key[0] == std::byte{'D'}) return "documents";
  if (key[0] == std::byte{'F'}) return "features";
  return key[0] == std::byte{'S'} ? "segments" : std::string_view{};
}

std::optional<std::uint64_t> generation_of(ByteSpan key) noexcept {
  if (kind_of(key).empty() || key.size() == 1) return std::nullopt;
  ByteReader in(key.subspan(1), "key");
  return in.number<std::uint64_t>();
}

std::string read_document(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where) {
  const Bytes content = read_record(snapshot, 'D', generation, where + ": annotation document");
  return std::string(text_of(content));
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

namespace signweave {

Sign sign_at(const SegmentTable& table, RowId row) {
  const SegmentRow& from = table.row(row);
  Sign sign{.gloss = table.labels()[from.text],
            .span = from.span,
            .phases = {},
            .hand = from.hand,
            .signer = {},
            .tier = table.tiers()[from.tier],
            .annotation = {},
            .inferred = from.inferred};
  for (const RowId child : table.children(row)) {
    const SegmentRow& phase = table.row(child);
    if (phase.kind == RowKind::phase) sign.phases.push_back({phase.phase, phase.span, table.labels()[phase.text], {}});
  }
  return sign;
}

std::vector<Sign> signs_of(const SegmentTable& table, std::uint32_t recording) {
  std::vector<Sign> signs;
  const SegmentTable::RowRange rows = table.recording_rows(recording);
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (table.row(row).kind == RowKind::sign) signs.push_back(sign_at(table, row));
  }
  return signs;
}

std::vector<std::vector<std::size_t>> phase_places_of(const SegmentTable& table, std::uint32_t recording) {
  const SegmentTable::RowRange rows = table.recording_rows(recording);
  std::vector<std::size_t> places(rows.size());  // [row]
  std::size_t phases = 0;
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (table.row(row).kind == RowKind::phase) places[row - rows.begin] = phases++;
  }
  std::vector<std::vector<std::size_t>> of_signs;
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (table.row(row).kind != RowKind::sign) continue;
    of_signs.emplace_back();
    for (const RowId child : table.children(row)) {
      if (table.row(child).kind == RowKind::phase) of_signs.back().push_back(places[child - rows.begin]);
    }
  }
  return of_signs;
}

std::vector<Sign> main_signs_of(const SegmentTable& table, std::uint32_t recording) {
  std::map<std::string, std::vector<Sign>> tiers;
  for (Sign& sign : signs_of(table, recording)) tiers[sign.tier].push_back(std::move(sign));
  std::vector<Sign> main;
  for (auto& [tier, signs] : tiers) {
    if (signs.size() > main.size()) main = std::move(signs);
  }
  return main;
}

}  // namespace signweave
