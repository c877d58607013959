#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "signweave/core/text_reader.h"
#include "signweave/formats/bvh/bvh.h"

/// The HIERARCHY half of a BVH file. Part of formats/bvh, not for others.
namespace signweave::bvh {

/// Joints as in the file: its units, its axes.
struct Hierarchy {
  std::vector<Joint> joints;                   ///< depth first, as in the file
  std::vector<Tip> tips;                       ///< in file order
  std::vector<std::vector<Channel>> channels;  ///< [joint]
  std::size_t channel_count = 0;               ///< numbers a frame
};

/// How a channel is written: [Channel].
inline constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                                  "Xrotation", "Yrotation", "Zrotation"};

/// Lengths and angles past this are no measurements, and would not survive the arithmetic.
inline constexpr double kLargest = 1e9;

/// True where a word is this keyword; upper and lower case are one.
bool is_keyword(std::string_view word, std::string_view keyword) noexcept;

/// A number of the file within ±kLargest.
double checked_number(TextReader& reader, std::string_view what);

/// Reads from HIERARCHY to the brace that closes the root; nesting costs no stack. Throws Error{bad_input}.
Hierarchy read_hierarchy(TextReader& reader, std::vector<Notice>& notices);

}  // namespace signweave::bvh
