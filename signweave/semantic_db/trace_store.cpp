#include "signweave/semantic_db/trace_store.h"

#include "signweave/kv/sealed.h"
#include "signweave/semantic_db/keys.h"

namespace signweave::semantic_db {

void put_trace(kv::WriteTransaction& transaction, std::uint64_t generation, const HandTrace& trace) {
  ByteWriter writer;
  encode(trace, writer);
  transaction.put(key_of('T', generation), kv::sealed(writer.bytes()));
}

void erase_trace(kv::WriteTransaction& transaction, std::uint64_t generation) {
  transaction.erase(key_of('T', generation));
}

std::optional<HandTrace> read_trace(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                    const std::string& where, const Pause& pause) {
  const auto record = snapshot.get(key_of('T', generation));
  if (!record) return std::nullopt;
  const std::string what = where + ": trace of the hands";
  ByteReader reader(kv::unsealed(*record, what), what);
  if (pause) pause();
  return decode_trace(reader, pause);
}

std::optional<RecordingFeatures> read_features(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                               const std::string& where, const Pause& pause) {
  const auto record = snapshot.get(key_of('F', generation));
  if (!record) return std::nullopt;
  const std::string what = where + ": features";
  ByteReader reader(kv::unsealed(*record, what), what);
  if (pause) pause();
  return decode_features(reader, pause);
}

}  // namespace signweave::semantic_db
