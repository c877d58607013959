#include "signweave/kv/old_values.h"

namespace signweave::kv {

void OldValues::keep(std::uint64_t number, ByteSpan key, std::optional<ByteSpan> value) {
  Old old{.until = number, .value = {}};
  if (value) old.value.emplace(value->begin(), value->end());
  const auto at = values_.try_emplace(std::string(text_of(key))).first;
  at->second.push_back(std::move(old));
  order_.push_back({number, &at->first});
}

const std::optional<Bytes>* OldValues::find(ByteSpan key, std::uint64_t snapshot) const {
  if (order_.empty()) return nullptr;
  const auto at = values_.find(text_of(key));
  if (at == values_.end()) return nullptr;
  for (const Old& old : at->second) {
    if (old.until > snapshot) return &old.value;
  }
  return nullptr;
}

std::vector<std::optional<Bytes>> OldValues::forget(std::uint64_t oldest) {
  std::vector<std::optional<Bytes>> forgotten;
  while (!order_.empty() && order_.front().number <= oldest) {
    const auto at = values_.find(*order_.front().key);
    forgotten.push_back(std::move(at->second.front().value));
    at->second.pop_front();
    if (at->second.empty()) values_.erase(at);
    order_.pop_front();
  }
  return forgotten;
}

}  // namespace signweave::kv
