#include "app/server/frames_answer.h"

#include <algorithm>
#include <cstring>

#include "app/server/stream_text.h"
#include "signweave/live/frame_codec.h"

namespace signweave::server {
namespace {

constexpr std::int64_t kFramesOfAMessage = 600;

std::string head_text(const Motion& motion, const FramesHead& head) {
  StreamHeader header{.skeleton = motion.shared_skeleton(),
                      .rate = motion.rate(),
                      .tracks = {},
                      .layout_from = head.recording,
                      .declarations = head.declarations};
  for (const ScalarTrack& track : motion.tracks()) header.tracks.push_back(track.name);
  nlohmann::ordered_json document =
      nlohmann::ordered_json::parse(header_text(header, {.database = head.database, .character = head.character}));
  document["type"] = "frames";
  document["frames"] = motion.frame_count();
  document["origin_ms"] = head.origin_ms;
  document["rig"] = head.rig;
  if (!head.report.is_null()) document["report"] = head.report;
  return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::span<std::byte> bytes_at(std::string& text, std::size_t at, std::size_t size) {
  return {reinterpret_cast<std::byte*>(text.data()) + at, size};
}

}  // namespace

std::string frames_text(const Motion& motion, const FramesHead& head) {
  const std::string head_json = head_text(motion, head);
  const FrameShape shape{motion.skeleton().joint_count(), motion.skeleton().translation_count(),
                         motion.tracks().size()};
  const std::size_t frame_bytes = bytes_of(shape);
  const std::int64_t frames = motion.frame_count();
  const std::int64_t messages = (frames + kFramesOfAMessage - 1) / kFramesOfAMessage;
  std::size_t at = 4 + head_json.size();
  std::string text(
      at + static_cast<std::size_t>(messages) * kMessageHeaderBytes + static_cast<std::size_t>(frames) * frame_bytes,
      '\0');
  const auto length = static_cast<std::uint32_t>(head_json.size());
  for (int i = 0; i < 4; ++i) text[static_cast<std::size_t>(i)] = static_cast<char>(length >> (8 * i) & 0xFF);
  std::memcpy(text.data() + 4, head_json.data(), head_json.size());
  std::vector<float> tracks(shape.tracks);
  for (std::int64_t first = 0; first < frames; first += kFramesOfAMessage) {
    const std::int64_t count = std::min(kFramesOfAMessage, frames - first);
    encode(MessageHeader{.frames = static_cast<std::uint16_t>(count),
                         .left_out = 0,
                         .first_frame = static_cast<std::uint64_t>(first)},
           bytes_at(text, at, kMessageHeaderBytes));
    at += kMessageHeaderBytes;
    for (std::int64_t frame = first; frame < first + count; ++frame) {
      for (std::size_t track = 0; track < tracks.size(); ++track) {
        tracks[track] = motion.tracks()[track].values[static_cast<std::size_t>(frame)];
      }
      encode(FrameView{motion.pose(frame), tracks}, bytes_at(text, at, frame_bytes));
      at += frame_bytes;
    }
  }
  return text;
}

}  // namespace signweave::server
