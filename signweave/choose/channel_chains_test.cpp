#include "signweave/choose/channel_chains.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace signweave {
namespace {

// The fingers had a clip of their own before, so a stream composes their lane apart.
TEST(ChannelChains, WhatAPartShowsWithItsParentIsHeldWithIt) {
  const std::vector<MotionClip> clips(3);
  const ChannelParts parts{.clips = {}, .holds = {{.channel = Channel::right, .from = 0, .until = 1}}};
  std::vector<ChannelStart> starts;
  for (const Channel channel :
       {Channel::body, Channel::left, Channel::right, Channel::tracks, Channel::right_fingers}) {
    starts.push_back({.channel = channel, .links = {{.clip = 0, .held_until = {}, .first = 0, .last = 0}}});
  }
  const std::vector<ChannelChain> chains = channel_chains(parts, clips, clips.size(), starts);
  const auto links_of = [&](Channel channel) {
    return std::ranges::find(chains, channel, &ChannelChain::channel)->links;
  };
  for (const Channel channel : {Channel::right, Channel::right_fingers}) {
    const std::vector<ChannelLink> links = links_of(channel);
    ASSERT_EQ(links.size(), 2u) << name_of(channel);
    EXPECT_EQ(links[0].held_until, 1u) << name_of(channel);
    EXPECT_EQ(links[1].clip, 2u) << name_of(channel);
  }
  EXPECT_EQ(links_of(Channel::left).size(), 3u);
}

}  // namespace
}  // namespace signweave
