#include "app/server/control_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace signweave::server {
namespace {

using ::testing::HasSubstr;

TEST(ControlMessage, OpenTakesEveryOption) {
  const ControlMessage message = parse_control(
      R"({"type": "open", "rate": "30000/1001", "batch": 60, "pace": "fast", "idle": "end", "look_ahead": 5,
          "loop": true, "recording": "meteo", "transition": "overlap", "duration": 400, "tempo": 1.5,
          "align": "ground", "strict": true, "id": 7})");
  EXPECT_EQ(message.control, Control::open);
  EXPECT_EQ(message.id, "7");
  EXPECT_EQ(message.open.batch, 60u);
  EXPECT_EQ(message.open.pace, Pace::fast);
  EXPECT_EQ(message.open.player.idle, Idle::end);
  EXPECT_EQ(message.open.player.look_ahead, 5u);
  EXPECT_TRUE(message.open.player.loop);
  EXPECT_EQ(message.open.player.recording, "meteo");
  EXPECT_EQ(message.open.player.synthesis.method, find_transition_method("overlap"));
  EXPECT_EQ(message.open.player.synthesis.duration.fixed, Milliseconds(400));
  EXPECT_EQ(message.open.player.synthesis.tempo, 1.5);
  EXPECT_EQ(message.open.player.synthesis.rate, (FrameRate{30'000, 1'001}));
  EXPECT_EQ(message.open.player.synthesis.alignment, Alignment::ground);
  EXPECT_TRUE(message.open.player.synthesis.strict);
}

TEST(ControlMessage, EveryOtherTypeIsRead) {
  EXPECT_EQ(parse_control(R"({"type":"sign","utterance":"DEMAIN MATIN"})").utterance.places.size(), 2u);
  EXPECT_EQ(parse_control(R"({"type":"append","utterance":"PLUIE"})").control, Control::append);
  EXPECT_EQ(parse_control(R"({"type":"seek","ms":1500})").at, Milliseconds(1'500));
  EXPECT_EQ(parse_control(R"({"type":"tempo","value":0.5})").tempo, 0.5);
  EXPECT_TRUE(parse_control(R"({"type":"loop","value":true})").loop);
  EXPECT_EQ(parse_control(R"({"type":"pause"})").control, Control::pause);
  EXPECT_EQ(parse_control(R"({"type":"resume"})").control, Control::resume);
  EXPECT_EQ(parse_control(R"({"type":"stop","id":"a"})").id, "\"a\"");
  EXPECT_EQ(parse_control(R"({"type":"ping"})").control, Control::ping);
}

struct MessageCase {
  const char* text;
  const char* says;
  const char* id = "";
};

TEST(ControlMessage, ErrorsContainTheId) {
  const MessageCase cases[] = {
      {"", "not JSON"},
      {"{", "not JSON"},
      {"[1]", "is a JSON object"},
      {"\"sign\"", "is a JSON object"},
      {R"({"type":"sign","utterance":"A"} x)", "not JSON"},
      {"{\"type\":\"sign\",\"utterance\":\"\xff\"}", "not JSON"},
      {R"({"id":1})", "needs a \"type\"", "1"},
      {R"({"type":3})", "needs a \"type\""},
      {R"({"type":"sing","id":"x"})", "did you mean ping or sign?", "\"x\""},
      {R"({"type":"sign","id":2})", "'sign' needs a field 'utterance'", "2"},
      {R"({"type":"sign","utterence":"A"})", "did you mean utterance?"},
      {R"({"type":"sign","utterance":7})", "'utterance' must be a string"},
      {R"({"type":"sign","utterance":""})", "utterance:1:"},
      {R"({"type":"pause","ms":1})", "'pause' has no field 'ms'"},
      {R"({"type":"seek","ms":-1})", "'ms' must be a number"},
      {R"({"type":"seek","ms":1e400})", "not JSON"},
      {R"({"type":"tempo","value":3})", "0.25 to 2"},
      {R"({"type":"loop","value":1})", "true or false"},
      {R"({"type":"open","batch":0})", "1 to 600"},
      {R"({"type":"open","batch":601})", "1 to 600"},
      {R"({"type":"open","batch":1.5})", "whole number"},
      {R"({"type":"open","batch":18446744073709551615})", "1 to 600"},
      {R"({"type":"open","strict":"yes"})", "true or false"},
      {R"({"type":"open","pace":"slow"})", "one of live, fast"},
      {R"({"type":"open","look_ahead":17})", "1 to 16"},
      {R"({"type":"open","rate":0})", "1 to 2000 frames per second"},
      {R"({"type":"open","transition":"jump"})", "available: taught"},
      {R"({"type":"open","duration":"soon"})", "fitted, corpus"},
      {R"({"type":"ping","id":{"a":1}})", "'id' must be a string or a number"},
  };
  for (const MessageCase& one : cases) {
    try {
      parse_control(one.text);
      ADD_FAILURE() << one.text;
    } catch (const ControlError& error) {
      EXPECT_THAT(error.what(), HasSubstr(one.says)) << one.text;
      EXPECT_EQ(error.id, one.id) << one.text;
    }
  }
}

TEST(ControlMessage, DeepNestingNeedsNoStack) {
  const std::string deep = R"({"type":"ping","id":)" + std::string(60'000, '[');
  EXPECT_THROW(parse_control(deep), ControlError);
}

}  // namespace
}  // namespace signweave::server
