// Streams as their clients see them, over real sockets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "app/server/test_server.h"
#include "signweave/notation/score_json.h"

namespace signweave::server {
namespace {

using testing::Answer;
using testing::Client;
using testing::get;
using ::testing::HasSubstr;
using testing::StreamClient;
using testing::StreamMessage;
using testing::TestServer;
using namespace std::chrono_literals;

constexpr std::string_view kFastOpen = R"({"type":"open","pace":"fast","idle":"end","batch":60,"rate":60})";

TEST(Stream, HeaderThenFramesThenTheEnd) {
  const TestServer server;
  StreamClient client(server.port());
  ASSERT_EQ(client.answer.status, 101);
  client.say(kFastOpen);
  client.say(R"({"type":"sign","utterance":"DEMAIN MATIN","id":"first"})");
  const nlohmann::json header = client.next("header");
  EXPECT_EQ(header["database"], "demo");
  EXPECT_EQ(header["rate"], 60.0);
  EXPECT_EQ(header["joints"][0]["parent"], -1);
  EXPECT_EQ(header["translated"][0], 0);
  EXPECT_THAT(header["declarations"].dump(), HasSubstr("placeholder"))
      << "every client must be informed of what it sees";
  const FrameShape shape{.joints = header["joints"].size(),
                         .translations = header["translated"].size(),
                         .tracks = header["tracks"].size()};
  EXPECT_EQ(header["frame_bytes"], bytes_of(shape));
  std::uint64_t expected = 0;
  std::size_t places = 0;
  for (;;) {
    const StreamMessage message = client.next();
    if (message.opcode == 1) {
      const nlohmann::json json = message.json();
      if (json["type"] == "end") break;
      ASSERT_EQ(json["type"], "place");
      EXPECT_GE(json["frame"], expected) << "an event comes before its frame";
      ++places;
      continue;
    }
    ASSERT_EQ(message.opcode, 2u);
    const auto* bytes = reinterpret_cast<const std::byte*>(message.bytes.data());
    const MessageHeader frames = decode_header({bytes, message.bytes.size()}, shape);
    EXPECT_EQ(frames.first_frame, expected);
    EXPECT_EQ(frames.left_out, 0u);
    expected += frames.frames;
  }
  EXPECT_EQ(places, 2u);
  EXPECT_GT(expected, 60u);
}

TEST(Stream, ReturnsTheScoreOfWhatItShows) {
  const TestServer server;
  StreamClient client(server.port());
  client.say(R"({"type":"score","id":1})");
  EXPECT_EQ(client.next("score"), nlohmann::json::parse(R"({"type":"score","frame":0,"score":null,"id":1})"));
  client.say(kFastOpen);
  client.say(R"({"type":"sign","utterance":"DEMAIN MATIN"})");
  const nlohmann::json first = client.next("place");
  client.say(R"({"type":"score"})");
  const nlohmann::json live = client.next("score");
  const Score score = score_from_json(live["score"].dump(), "stream");
  EXPECT_GE(live["score_frame"], live["frame"]) << "nothing was left out before it";
  const Clip& clip = score.clips.at(first["clip"].get<std::size_t>() - live["first_clip"].get<std::size_t>());
  EXPECT_EQ(clip.source.recording, first["recording"]);
  EXPECT_EQ(clip.signs.front().gloss, "DEMAIN");
}

TEST(Stream, PacedFramesArriveAtTheirTime) {
  const TestServer server;
  StreamClient client(server.port());
  client.say(R"({"type":"open","rate":100})");
  client.say(R"({"type":"sign","utterance":"DEMAIN MATIN PLUIE"})");
  ASSERT_TRUE(client.next_frames());
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(client.next_frames());
  const auto took = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(took, 400ms);
  EXPECT_LT(took, 5s) << "a slow machine may be late, but catches up";
}

TEST(Stream, ErrorsAreAnsweredAndTheStreamContinues) {
  const TestServer server;
  StreamClient client(server.port());
  client.say(kFastOpen);
  EXPECT_EQ(client.next("ok")["frame"], 0);
  const auto says = [&](std::string_view message, std::string_view code, std::string_view text) {
    client.say(message);
    nlohmann::json error = client.next("error");
    EXPECT_EQ(error["code"], code) << message;
    EXPECT_THAT(error["message"].get<std::string>(), HasSubstr(std::string(text))) << message;
    return error;
  };
  says("no JSON", "bad_input", "not JSON");
  says(R"({"type":"sing"})", "bad_input", "did you mean ping or sign?");
  EXPECT_EQ(says(R"({"type":"sign","utterance":"DEMAINN","id":5})", "not_found", "DEMAIN")["id"], 5);
  const nlohmann::json missing = says(R"({"type":"append","utterance":"demain"})", "not_found", "DEMAIN");
  EXPECT_EQ(missing["missing"], nlohmann::json::parse(R"([{"gloss":"demain","matches":["DEMAIN"],"folds":true}])"));
  EXPECT_EQ(missing["suggestion"], "DEMAIN");
  says(R"({"type":"sign","utterance":"DEMAINN","missing":"fold"})", "not_found", "DEMAIN");
  says(R"({"type":"sign","utterance":"DEMAIN","missing":"guess"})", "bad_input", "must be one of explain, fold");
  says(R"({"type":"open"})", "conflict", "must come first");
  client.client.send(StreamClient::frame(2, "bytes"));
  EXPECT_EQ(client.next("error")["code"], "bad_input");
  client.say(R"({"type":"ping","id":"still there"})");
  EXPECT_EQ(client.next("ok")["id"], "still there");
  client.say(R"({"type":"sign","utterance":"DEMAIN"})");
  EXPECT_TRUE(client.next_frames());
}

TEST(Stream, SpellingIsFoldedIfRequested) {
  const TestServer server;
  StreamClient client(server.port());
  client.say(kFastOpen);
  client.say(R"({"type":"sign","utterance":"demain","missing":"fold","id":1})");
  EXPECT_THAT(client.next("notice")["text"].get<std::string>(), HasSubstr("'demain'"));
  EXPECT_EQ(client.next("place")["gloss"], "DEMAIN");
}

TEST(Stream, PausesAndResumes) {
  const TestServer server;
  StreamClient client(server.port());
  client.say(R"({"type":"open","rate":200})");
  client.say(R"({"type":"sign","utterance":"DEMAIN"})");
  ASSERT_TRUE(client.next_frames());
  client.say(R"({"type":"pause","id":"p"})");
  nlohmann::json ok;
  while (ok["id"] != "p") ok = client.next("ok");
  client.say(R"({"type":"ping","id":"q"})");
  const StreamMessage next = client.next();
  ASSERT_EQ(next.opcode, 1u) << "no frame while it pauses";
  EXPECT_EQ(next.json()["id"], "q");
  client.say(R"({"type":"resume"})");
  EXPECT_EQ(client.next_frames()->first_frame, ok["frame"]) << "no frame is lost by a pause";
}

class StreamSending : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Stream, StreamSending, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "IoUring" : "CallEach"; });

TEST_P(StreamSending, StreamsDueTogetherEachReceiveTheirOwnFrames) {
  const TestServer server({.threads = 1, .io_uring = GetParam()});
  std::vector<StreamClient> clients;
  for (int i = 0; i < 12; ++i) {
    clients.emplace_back(server.port());
    clients.back().say(R"({"type":"open","rate":)" + std::to_string(150 + 250 * (i % 3)) + R"(,"loop":true})");
    clients.back().say(R"({"type":"sign","utterance":"DEMAIN MATIN"})");
  }
  std::vector<std::size_t> places(clients.size());
  // The frames received by each, and the frame after the last one. Some may be dropped, because fast streams fill their
  // buffers while slow ones are read; a header counts all dropped so far.
  std::vector<std::uint64_t> got(clients.size()), next(clients.size());
  for (int round = 0; round < 200; ++round) {
    for (std::size_t i = 0; i < clients.size(); ++i) {
      StreamMessage message = clients[i].next();
      std::optional<std::uint64_t> event;
      for (; message.opcode == 1; message = clients[i].next()) {
        const nlohmann::json json = message.json();
        if (json["type"] != "place") continue;
        ++places[i];
        event = json["frame"];
      }
      ASSERT_EQ(message.opcode, 2u);
      const auto* bytes = reinterpret_cast<const std::byte*>(message.bytes.data());
      std::uint64_t first = 0;
      std::uint32_t left_out = 0;
      std::memcpy(&left_out, bytes + 4, sizeof left_out);
      std::memcpy(&first, bytes + 8, sizeof first);
      ASSERT_EQ(first, got[i]++ + left_out);
      if (event) {
        EXPECT_LE(next[i], *event);
        EXPECT_LE(*event, first) << "an event comes before its frame";
      }
      next[i] = first + 1;
    }
  }
  for (std::size_t i = 0; i < places.size(); i += 3) EXPECT_GE(places[i], 1u) << "200 frames are long enough for one";
  const std::string metrics = get(server.port(), "/metrics").body;
  EXPECT_TRUE(GetParam() || metrics.find("\nsignweave_messages_by_io_uring_total 0\n") != std::string::npos);
}

TEST_P(StreamSending, OnlyASlowClientLosesFrames) {
  ServerOptions options{.threads = 1, .io_uring = GetParam()};
  options.limits.send_buffer = 16 * 1024;
  const TestServer server(options);
  StreamClient slow(server.port(), {}, {}, 4'096);
  slow.say(R"({"type":"open","rate":400,"batch":4})");
  slow.say(R"({"type":"sign","utterance":"DEMAIN MATIN"})");
  StreamClient good(server.port());
  good.say(R"({"type":"open","rate":100})");
  good.say(R"({"type":"sign","utterance":"MATIN PLUIE"})");
  // A server that waited for the slow client, which reads nothing yet, would send nothing to the good one either.
  std::uint64_t got = 0;
  for (int i = 0; i < 150; ++i) {
    const auto frames = good.next_frames();
    ASSERT_TRUE(frames);
    ASSERT_EQ(frames->first_frame, got + frames->left_out);
    got += frames->frames;
  }
  // The slow client reads again: received and dropped frames together are complete.
  std::uint64_t received = 0;
  MessageHeader last;
  while (last.left_out == 0) {
    const auto frames = slow.next_frames();
    ASSERT_TRUE(frames);
    EXPECT_EQ(frames->first_frame, received + frames->left_out);
    received += frames->frames;
    last = *frames;
  }
  EXPECT_GT(last.left_out, 0u);
  const std::string metrics = get(server.port(), "/metrics").body;
  EXPECT_THAT(metrics, Not(HasSubstr("signweave_frames_left_out_total 0\n")));
}

TEST(Stream, AClientThatNeverReadsIsClosedAtALimit) {
  ServerOptions options;
  options.limits.control_rate = 1e6;
  options.limits.unread_bytes = 32 * 1024;
  options.limits.send_buffer = 8 * 1024;
  const TestServer server(options);
  StreamClient client(server.port(), {}, {}, 4'096);
  const std::string ping = R"({"type":"ping","id":")" + std::string(200, 'x') + "\"}";
  bool open = true;
  for (int i = 0; open && i < 20'000; ++i) open = client.say(ping);
  EXPECT_FALSE(open);
  EXPECT_EQ(get(server.port(), "/health").status, 200);
}

TEST(Stream, MessagesBeyondTheRateAreReadLater) {
  ServerOptions options;
  options.limits.control_rate = 20;
  const TestServer server(options);
  StreamClient client(server.port());
  for (int i = 0; i < 30; ++i) client.say(R"({"type":"ping","id":)" + std::to_string(i) + "}");
  for (int i = 0; i < 30; ++i) {
    const nlohmann::json ok = client.next("ok");
    ASSERT_FALSE(ok.is_null()) << i;
    EXPECT_EQ(ok["id"], i);
  }
}

TEST(Stream, AClientThatClosesAndReadsNothingIsDropped) {
  ServerOptions options;
  options.limits.send_buffer = 8 * 1024;
  options.limits.close_time = 300ms;
  const TestServer server(options);
  StreamClient client(server.port(), {}, {}, 4'096);
  client.say(R"({"type":"open","rate":2000,"batch":600,"recording":"meteo"})");
  client.say(R"({"type":"sign","utterance":"DEMAIN MATIN"})");
  std::this_thread::sleep_for(500ms);
  client.client.send(StreamClient::frame(8, std::string("\x03\xe8", 2)));
  std::string metrics;
  for (int i = 0; metrics.find("\nsignweave_streams 0\n") == std::string::npos && i < 100; ++i) {
    std::this_thread::sleep_for(50ms);
    metrics = get(server.port(), "/metrics").body;
  }
  EXPECT_THAT(metrics, HasSubstr("\nsignweave_streams 0\n"));
}

TEST(Stream, AnOversizeMessageEndsOnlyItsStream) {
  ServerOptions options;
  options.limits.control_bytes = 1'024;
  const TestServer server(options);
  StreamClient other(server.port());
  StreamClient client(server.port());
  client.say(R"({"type":"ping","id":")" + std::string(2'000, 'x') + "\"}");
  StreamMessage message = client.next();
  EXPECT_EQ(message.opcode, 8u);
  ASSERT_GE(message.bytes.size(), 2u);
  EXPECT_EQ(static_cast<unsigned char>(message.bytes[0]) * 256 + static_cast<unsigned char>(message.bytes[1]), 1009);
  other.say(R"({"type":"ping"})");
  EXPECT_EQ(other.next("ok")["type"], "ok");
}

TEST(Stream, BrokenFramesEndOnlyTheirStream) {
  const TestServer server;
  StreamClient other(server.port());
  const std::string unmasked("\x81\x02{}", 4);
  const std::string reserved("\xf1\x80\0\0\0\0", 6);
  const std::string long_ping("\x89\xfe\x01\x00\0\0\0\0", 8);
  const std::string huge("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14);
  for (const std::string& bytes : {unmasked, reserved, long_ping, huge, std::string("\x8b\x80\0\0\0\0", 6)}) {
    StreamClient client(server.port());
    client.client.send(bytes);
    const unsigned opcode = client.next().opcode;
    EXPECT_TRUE(opcode == 8 || opcode == 0) << opcode;
  }
  other.say(R"({"type":"ping"})");
  EXPECT_EQ(other.next("ok")["type"], "ok");
}

TEST(Stream, ASilentClientIsPingedAndThenClosed) {
  ServerOptions options;
  options.limits.silence = 300ms;
  const TestServer server(options);
  StreamClient half_open(server.port());
  std::thread silent(
      [&] { EXPECT_THAT(half_open.client.read_all(), HasSubstr("\x89")) << "a ping, and then the end"; });
  StreamClient living(server.port());
  std::thread later([&] {
    std::this_thread::sleep_for(1s);
    living.say(R"({"type":"ping"})");
  });
  const nlohmann::json answer = living.next("ok");
  EXPECT_FALSE(answer.is_null()) << "a client that answers pings stays connected";
  later.join();
  silent.join();
}

TEST(Stream, SelectsOneOfSeveralDatabases) {
  const kv::TestFolder folder;
  std::filesystem::copy(testing::demo_folder(), folder / "other.db", std::filesystem::copy_options::recursive);
  const TestServer server({}, {testing::demo_folder(), folder / "other.db"});
  EXPECT_EQ(StreamClient(server.port()).answer.status, 400);
  EXPECT_EQ(StreamClient(server.port(), "?database=none").answer.status, 404);
  EXPECT_EQ(StreamClient(server.port(), "?databas=demo").answer.status, 400);
  for (const char* name : {"demo", "other"}) {
    StreamClient client(server.port(), std::string("?database=") + name);
    client.say(kFastOpen);
    client.say(R"({"type":"sign","utterance":"DEMAIN"})");
    EXPECT_EQ(client.next("header")["database"], name);
  }
}

TEST(Stream, RequiresTheServersOwnOriginAndToken) {
  const std::string token = "0123456789abcdef";
  const TestServer server({.token = token, .allowed_origins = {"https://signs.example.org"}});
  EXPECT_EQ(StreamClient(server.port()).answer.status, 401);
  EXPECT_EQ(StreamClient(server.port(), "?token=wrong").answer.status, 401);
  EXPECT_EQ(StreamClient(server.port(), "?token=" + token).answer.status, 101);
  const std::string bearer = "Authorization: Bearer " + token + "\r\n";
  EXPECT_EQ(StreamClient(server.port(), {}, bearer).answer.status, 101);
  EXPECT_EQ(StreamClient(server.port(), {}, bearer + "Origin: https://evil.example\r\n").answer.status, 403);
  EXPECT_EQ(StreamClient(server.port(), {}, bearer + "Origin: https://signs.example.org\r\n").answer.status, 101);
  EXPECT_EQ(StreamClient(server.port(), {}, bearer + "Origin: http://localhost\r\n").answer.status, 101);
}

}  // namespace
}  // namespace signweave::server
