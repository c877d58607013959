#pragma once

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

/// Part of formats/eaf, not for others.
namespace signweave::eaf {

/// Places by id. ELAN numbers its ids ("ts17", "a42"), so nearly all are found by their number, without hashing; any
/// other id is as good, only slower. The ids are borrowed.
class Ids {
 public:
  /// Room for so many; a hint.
  void reserve(std::size_t count) { expected_ = count; }

  /// False, and nothing changed, where the id is known.
  bool add(std::string_view id, std::size_t place);
  /// The place of an id; kMissing where it is not known.
  std::size_t find(std::string_view id) const;
  static constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

 private:
  std::size_t number_of(std::string_view id) const noexcept;

  std::size_t expected_ = 0;
  std::string_view prefix_;            ///< of the first id that ended with a number
  std::vector<std::size_t> numbered_;  ///< [number], of ids that are the prefix and a number
  std::unordered_map<std::string_view, std::size_t> others_;
};

}  // namespace signweave::eaf
