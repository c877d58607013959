#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "app/server/api.h"
#include "signweave/live/frame_codec.h"
#include "signweave/motion/motion.h"

namespace signweave::server {

/// An answer in the format `frames`.
struct Frames {
  nlohmann::json head;
  std::vector<Pose> poses;
  std::vector<std::vector<float>> tracks;
};

inline Frames frames_in(const ApiResponse& response) {
  EXPECT_EQ(response.content_type, "application/vnd.signweave.frames") << response.body.substr(0, 300);
  std::uint32_t length = 0;
  std::memcpy(&length, response.body.data(), 4);
  Frames frames{.head = nlohmann::json::parse(response.body.substr(4, length)), .poses = {}, .tracks = {}};
  const FrameShape shape{.joints = frames.head["joints"].size(),
                         .translations = frames.head["translated"].size(),
                         .tracks = frames.head["tracks"].size()};
  const std::size_t size = bytes_of(shape);
  EXPECT_EQ(frames.head["frame_bytes"], size);
  std::span<const std::byte> left(reinterpret_cast<const std::byte*>(response.body.data()), response.body.size());
  left = left.subspan(4 + length);
  while (!left.empty()) {
    std::uint16_t count = 0;
    std::memcpy(&count, left.data() + 2, 2);
    const std::size_t bytes = kMessageHeaderBytes + count * size;
    if (left.size() < bytes) {
      ADD_FAILURE() << "it ends within a message";
      break;
    }
    EXPECT_EQ(decode_header(left.first(bytes), shape).first_frame, frames.poses.size());
    for (std::size_t i = 0; i < count; ++i) {
      Pose pose;
      pose.rotations.resize(shape.joints);
      pose.translations.resize(shape.translations);
      std::vector<float> tracks(shape.tracks);
      decode(left.subspan(kMessageHeaderBytes + i * size, size), {pose.view(), tracks});
      frames.poses.push_back(std::move(pose));
      frames.tracks.push_back(std::move(tracks));
    }
    left = left.subspan(bytes);
  }
  EXPECT_EQ(frames.head["frames"], frames.poses.size());
  return frames;
}

}  // namespace signweave::server
