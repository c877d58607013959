#include <algorithm>
#include <cmath>

#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/bvh/euler.h"

namespace signweave::bvh {
namespace {

constexpr std::uint8_t kVersion = 1;  ///< of the stored form

bool has_duplicates(const std::vector<Channel>& channels) noexcept {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (std::find(channels.begin(), channels.begin() + static_cast<std::ptrdiff_t>(i), channels[i]) !=
        channels.begin() + static_cast<std::ptrdiff_t>(i)) {
      return true;
    }
  }
  return false;
}

bool is_unit(double unit) noexcept {
  return std::isfinite(unit) && unit > 0;
}

}  // namespace

bool has_positions_then_rotations(const std::vector<Channel>& channels) noexcept {
  return channels.size() == 6 &&
         std::is_partitioned(channels.begin(), channels.end(), [](Channel channel) { return !is_rotation(channel); }) &&
         !is_rotation(channels[2]) && is_rotation(channels[3]);
}

Layout default_layout(const Skeleton& skeleton) {
  Layout layout;
  for (const Joint& joint : skeleton.joints()) {
    std::vector<Channel> channels;
    if (joint.translated) channels = {Channel::x_position, Channel::y_position, Channel::z_position};
    channels.insert(channels.end(), {Channel::z_rotation, Channel::x_rotation, Channel::y_rotation});
    layout.channels.push_back(std::move(channels));
  }
  return layout;
}

namespace {

/// A rotation of all axes moves the content of one column to others, so a joint with some positions or rotations gets
/// all three.
void widen(std::vector<Channel>& channels) {
  const auto some = [&](bool rotations) {
    return std::any_of(channels.begin(), channels.end(), [&](Channel c) { return is_rotation(c) == rotations; });
  };
  const auto add = [&](std::initializer_list<Channel> all, std::ptrdiff_t at) {
    for (const Channel channel : all) {
      if (std::find(channels.begin(), channels.end(), channel) != channels.end()) continue;
      channels.insert(channels.begin() + at++, channel);
    }
  };
  if (some(false)) {  // after the last position, before what follows
    const auto last = std::find_if(channels.rbegin(), channels.rend(), [](Channel c) { return !is_rotation(c); });
    add({Channel::x_position, Channel::y_position, Channel::z_position}, last.base() - channels.begin());
  }
  if (some(true)) {
    add({Channel::z_rotation, Channel::x_rotation, Channel::y_rotation}, std::ssize(channels));
  }
}

}  // namespace

Layout with(Layout layout, const LayoutChanges& changes) {
  if (changes.up && *changes.up != layout.up) {
    for (std::vector<Channel>& channels : layout.channels) widen(channels);
  }
  if (changes.order) {
    for (std::vector<Channel>& channels : layout.channels) {
      std::erase_if(channels, is_rotation);
      channels.insert(channels.end(), changes.order->begin(), changes.order->end());
    }
    layout.root_columns = RootColumns::declared;
  }
  if (changes.up) layout.up = *changes.up;
  if (changes.unit) layout.unit = layout.root_unit = *changes.unit;
  return layout;
}

bool fits(const Layout& layout, const Skeleton& skeleton) noexcept {
  if (layout.channels.size() != skeleton.joint_count()) return false;
  if (!is_unit(layout.unit) || !is_unit(layout.root_unit)) return false;
  std::size_t count = 0;
  for (std::size_t i = 0; i < layout.channels.size(); ++i) {
    const std::vector<Channel>& channels = layout.channels[i];
    const bool moves = std::any_of(channels.begin(), channels.end(), [](Channel c) { return !is_rotation(c); });
    if (skeleton.joints()[i].translated && !moves) return false;
    if (has_duplicates(channels)) return false;
    count += channels.size();
  }
  if (layout.root_columns == RootColumns::rotation_first && !has_positions_then_rotations(layout.channels[0])) {
    return false;
  }
  return count > 0;
}

// Stored form: version u8 · up u8 · mirrored u8 · root columns u8 · unit f64 · root unit f64 · frame time text · joints
// u32 · for each joint: channels u8, then each u8.
void encode(const Layout& layout, ByteWriter& out) {
  out.number(kVersion);
  out.number(layout.up);
  out.number(static_cast<std::uint8_t>(layout.mirrored ? 1 : 0));
  out.number(layout.root_columns);
  out.number(layout.unit);
  out.number(layout.root_unit);
  out.text(layout.frame_time);
  out.number(static_cast<std::uint32_t>(layout.channels.size()));
  for (const std::vector<Channel>& channels : layout.channels) {
    out.number(static_cast<std::uint8_t>(channels.size()));
    for (const Channel channel : channels) out.number(channel);
  }
}

Layout decode_layout(ByteReader& in) {
  if (in.number<std::uint8_t>() != kVersion) in.fail("a BVH layout of an unknown version");
  Layout layout;
  const auto flag = [&](const char* what) {
    const auto value = in.number<std::uint8_t>();
    if (value > 1) in.fail(what);
    return value == 1;
  };
  layout.up = flag("an unknown up axis") ? UpAxis::z : UpAxis::y;
  layout.mirrored = flag("an unknown handedness");
  layout.root_columns = flag("an unknown root order") ? RootColumns::rotation_first : RootColumns::declared;
  layout.unit = in.number<double>();
  layout.root_unit = in.number<double>();
  if (!is_unit(layout.unit) || !is_unit(layout.root_unit)) in.fail("a unit that is not a length");
  layout.frame_time = in.text();
  layout.channels.resize(in.count(1));
  for (std::vector<Channel>& channels : layout.channels) {
    const auto count = in.number<std::uint8_t>();
    if (count > 6) in.fail("more than six channels");
    for (std::uint8_t i = 0; i < count; ++i) {
      const auto channel = in.number<std::uint8_t>();
      if (channel > 5) in.fail("an unknown channel");
      channels.push_back(static_cast<Channel>(channel));
    }
    if (has_duplicates(channels)) in.fail("a channel twice");
  }
  return layout;
}

}  // namespace signweave::bvh
