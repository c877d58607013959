#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

/// Numbers as text in a BVH file. Internal to formats/bvh.
namespace signweave::bvh {

/// Text that is built up number by number. Trailing decimals that carry no information are omitted, and scientific
/// notation is never used, because not every BVH reader accepts it.
class DecimalText {
 public:
  void clear() noexcept { size_ = 0; }
  std::string_view view() const noexcept { return {text_.data(), size_}; }

  void letter(char c) { *room() = c, ++size_; }
  /// Appends `value`, which must be finite, rounded correctly to at most `decimals` decimals.
  void fixed(double value, int decimals);
  /// Appends a length in the file's unit, with the fewest decimals (four or more) that read back to the same bits of
  /// metres, or with nine digits if no number of decimals does.
  void length(float metres, double unit);

 private:
  char* room();

  std::vector<char> text_;
  std::size_t size_ = 0;
};

}  // namespace signweave::bvh
