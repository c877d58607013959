// docs/stream.md is correct: its examples are read and written by the code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "app/server/control_message.h"
#include "app/server/stream_text.h"

namespace signweave::server {
namespace {

using Json = nlohmann::ordered_json;

/// The blocks of the document marked as ```json KIND.
std::vector<std::string> blocks(const std::string& kind) {
  std::ifstream file(SIGNWEAVE_SOURCE_DIR "/docs/stream.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string fence = "```json " + kind + "\n";
  std::vector<std::string> found;
  for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at + 1)) {
    const std::size_t begin = at + fence.size();
    found.push_back(text.substr(begin, text.find("```", begin) - begin));
  }
  return found;
}

std::vector<std::string> lines(const std::string& kind) {
  std::vector<std::string> result;
  for (const std::string& block : blocks(kind)) {
    std::istringstream in(block);
    for (std::string line; std::getline(in, line);) result.push_back(line);
  }
  return result;
}

TEST(StreamDocument, EveryControlMessageIsShownAndRead) {
  std::set<Control> shown;
  for (const std::string& line : lines("client")) {
    EXPECT_NO_THROW(shown.insert(parse_control(line).control)) << line;
  }
  EXPECT_EQ(shown.size(), static_cast<std::size_t>(Control::ping) + 1);
}

/// The server's message for the values of an example.
std::string said(const Json& example) {
  const std::string type = example["type"];
  const std::string id = example.contains("id") ? example["id"].dump() : "";
  if (type == "ok") return ok_text(id, example["frame"]);
  if (type == "score") return score_text(id, std::nullopt, example["frame"]);
  if (type == "error") {
    for (int code = 0; code <= static_cast<int>(ErrorCode::cancelled); ++code) {
      if (name_of(static_cast<ErrorCode>(code)) == example["code"]) {
        return error_text(static_cast<ErrorCode>(code), example["message"].get<std::string>(), id);
      }
    }
    return "no such code";
  }
  PlayerEvent event{.frame = example["frame"], .at = Milliseconds(example["ms"].get<int>())};
  if (type == "place") {
    event.kind = PlayerEvent::Kind::place;
    event.place = example["place"];
    event.clip = example["clip"];
    event.gloss = example["gloss"];
    event.token = example["token"];
    event.recording = example["recording"];
  } else {
    event.kind = type == "rest"   ? PlayerEvent::Kind::rest
                 : type == "end"  ? PlayerEvent::Kind::end
                 : type == "seek" ? PlayerEvent::Kind::seek
                                  : PlayerEvent::Kind::notice;
    event.text = example.value("text", "");
    event.code = example.value("code", "");
  }
  return event_text(event);
}

TEST(StreamDocument, AnEventIsJsonWhateverItsTexts) {
  for (const std::string text : {"MATIN", "", "a \"quoted\" \\ one", "line\nand tab\t", "MÉTÉO 手話", "\x01"}) {
    const PlayerEvent event{.kind = PlayerEvent::Kind::place, .gloss = text, .recording = text, .text = text};
    const auto json = nlohmann::json::parse(event_text(event));
    EXPECT_EQ(json["gloss"], text);
    EXPECT_EQ(json["recording"], text);
    EXPECT_EQ(json.value("text", ""), text);
  }
  const PlayerEvent event{.text = "no UTF-8: \xff"};
  EXPECT_EQ(nlohmann::json::parse(event_text(event))["text"], "no UTF-8: \uFFFD");
}

TEST(StreamDocument, EveryAnswerIsAsDocumented) {
  std::set<std::string> shown;
  for (const std::string& line : lines("server")) {
    const Json example = Json::parse(line);
    EXPECT_EQ(said(example), example.dump()) << line;
    shown.insert(example["type"]);
  }
  EXPECT_EQ(shown, (std::set<std::string>{"ok", "score", "error", "place", "rest", "end", "seek", "notice"}));
}

TEST(StreamDocument, TheHeaderIsAsDocumented) {
  const StreamHeader header{
      .skeleton = std::make_shared<const Skeleton>(
          std::vector<Joint>{{.name = "Hips", .translated = true},
                             {.name = "Spine", .parent = 0, .offset = Eigen::Vector3f(0, 0.5f, 0)}},
          std::vector<Tip>{{.joint = 1, .offset = Eigen::Vector3f(0, 0.25f, 0)}}),
      .rate = {60, 1},
      .tracks = {},
      .layout_from = "meteo",
      .declarations = {{"signweave:placeholder", "synthetic motion: placeholder shapes, not LSF"}}};
  ASSERT_EQ(blocks("header").size(), 1u);
  EXPECT_EQ(Json::parse(header_text(header, {.database = "demo", .pace = Pace::live})),
            Json::parse(blocks("header").front()));
}

TEST(StreamDocument, TheBytesAreAsDocumented) {
  EXPECT_EQ(kMessageHeaderBytes, 16u);
  EXPECT_EQ(bytes_of({.joints = 2, .translations = 1, .tracks = 3}), 12u + 3 * 4u + 2 * 8u);
  std::vector<std::byte> bytes(16);
  encode(MessageHeader{.frames = 0x0102, .left_out = 0x03040506, .first_frame = 0x0708090a0b0c0d0e}, bytes);
  const std::vector<int> expected = {1, 0, 2, 1, 6, 5, 4, 3, 14, 13, 12, 11, 10, 9, 8, 7};
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << i;
}

}  // namespace
}  // namespace signweave::server
