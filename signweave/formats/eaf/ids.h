#pragma once

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

/// Internal to formats/eaf.
namespace signweave::eaf {

/// A map from ids to positions. ELAN numbers its ids ("ts17", "a42"), so nearly all are found by their number, without
/// hashing; other ids also work, only more slowly. The ids are borrowed.
class Ids {
 public:
  /// The expected number of ids; a hint.
  void reserve(std::size_t count) { expected_ = count; }

  /// Returns false and changes nothing if the id is already present.
  bool add(std::string_view id, std::size_t place);
  /// The position of an id; kMissing if it is not present.
  std::size_t find(std::string_view id) const;
  static constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

 private:
  std::size_t number_of(std::string_view id) const noexcept;

  std::size_t expected_ = 0;
  std::string_view prefix_;            ///< of the first id that ended with a number
  std::vector<std::size_t> numbered_;  ///< [number], for ids that are the prefix and a number
  std::unordered_map<std::string_view, std::size_t> others_;
};

}  // namespace signweave::eaf
