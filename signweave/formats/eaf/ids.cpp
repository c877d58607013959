#include "signweave/formats/eaf/ids.h"

namespace signweave::eaf {
namespace {

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

}  // namespace

/// The number of an id that consists of the prefix and a number in canonical form ("ts07" is a different id from
/// "ts7"); kMissing for any other.
std::size_t Ids::number_of(std::string_view id) const noexcept {
  if (prefix_.empty() || !id.starts_with(prefix_)) return kMissing;
  const std::string_view digits = id.substr(prefix_.size());
  if (digits.empty() || digits.size() > 9 || (digits.front() == '0' && digits.size() > 1)) return kMissing;
  std::size_t number = 0;
  for (const char c : digits) {
    if (!is_digit(c)) return kMissing;
    number = 10 * number + static_cast<std::size_t>(c - '0');
  }
  return number;
}

bool Ids::add(std::string_view id, std::size_t place) {
  if (prefix_.empty() && others_.empty()) {
    std::size_t letters = id.size();
    while (letters > 0 && is_digit(id[letters - 1])) --letters;
    if (letters < id.size()) prefix_ = id.substr(0, letters);
  }
  const std::size_t number = number_of(id);
  // A number far beyond the count of ids would use memory out of proportion to the file.
  if (number == kMissing || number > 8 * expected_ + 1024) return others_.emplace(id, place).second;
  if (number >= numbered_.size()) numbered_.resize(number + number / 2 + 16, kMissing);
  if (numbered_[number] != kMissing) return false;
  numbered_[number] = place;
  return true;
}

std::size_t Ids::find(std::string_view id) const {
  const std::size_t number = number_of(id);
  if (number < numbered_.size() && numbered_[number] != kMissing) return numbered_[number];
  if (others_.empty()) return kMissing;
  const auto found = others_.find(id);
  return found == others_.end() ? kMissing : found->second;
}

}  // namespace signweave::eaf
