#include "signweave/kv/sealed.h"

namespace signweave::kv {

Bytes sealed(ByteSpan content) {
  ByteWriter writer;
  writer.number(checksum(content));
  writer.raw(content);
  return writer.take();
}

ByteSpan unsealed(ByteSpan record, const std::string& where) {
  ByteReader reader(record, where);
  const auto expected = reader.number<std::uint64_t>();
  const ByteSpan content = reader.take(reader.left());
  if (checksum(content) != expected) reader.fail("its checksum does not fit");
  return content;
}

}  // namespace signweave::kv
