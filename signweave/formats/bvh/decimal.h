#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

/// Numbers as text in a BVH file. Part of formats/bvh, not for others.
namespace signweave::bvh {

/// Text that grows number by number. Decimals that say nothing are left out, and nothing is ever in scientific
/// notation, which not every reader of BVH knows.
class DecimalText {
 public:
  void clear() noexcept { size_ = 0; }
  std::string_view view() const noexcept { return {text_.data(), size_}; }

  void letter(char c) { *room() = c, ++size_; }
  /// `value`, finite, rounded correctly to at most `decimals` decimals.
  void fixed(double value, int decimals);
  /// A length in the file's unit: of four decimals or more the fewest that a reader takes back to the same bits of
  /// metres, or nine digits where none does.
  void length(float metres, double unit);

 private:
  char* room();

  std::vector<char> text_;
  std::size_t size_ = 0;
};

}  // namespace signweave::bvh
