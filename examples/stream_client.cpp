// Signs typed glosses on a server (`signweave serve`) and writes the stream it sends as BVH:
//
//   stream_client http://127.0.0.1:8080 [--database NAME] [--token T] [--rate FPS] [--tempo F] -o OUT.bvh [GLOSS…]
//
// Without a GLOSS, lines are read from standard input, and each is appended as it is typed. The utterance is printed
// with the chosen tokens: given to `signweave sign`, it produces the same motion (docs/stream.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <deque>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "signweave/core/error.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/live/frame_codec.h"
#include "signweave/notation/utterance.h"

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using nlohmann::json;
using namespace signweave;

struct Options {
  std::string host, port = "80", database, token, out;
  std::vector<std::string> glosses;
  json open = {{"type", "open"}, {"pace", "fast"}, {"idle", "end"}, {"batch", 60}};
};

/// An empty motion with the skeleton and frame rate of a header.
Motion empty_motion(const json& header) {
  const auto vector = [](const json& v) { return Eigen::Vector3f(v.at(0), v.at(1), v.at(2)); };
  std::vector<Joint> joints;
  for (const json& joint : header.at("joints")) {
    joints.push_back({.name = joint.at("name"), .parent = joint.at("parent"), .offset = vector(joint.at("offset"))});
  }
  for (const std::size_t joint : header.at("translated")) joints.at(joint).translated = true;
  std::vector<Tip> tips;
  for (const json& tip : header.at("tips")) tips.push_back({tip.at("joint"), vector(tip.at("offset"))});
  const FrameRate rate{header.at("rate_fraction").at(0), header.at("rate_fraction").at(1)};
  return {std::make_shared<const Skeleton>(std::move(joints), std::move(tips)), rate};
}

class Client {
 public:
  Client(asio::io_context& io, const Options& options) : stream_(io) {
    asio::connect(stream_.next_layer(), asio::ip::tcp::resolver(io).resolve(options.host, options.port));
    stream_.set_option(beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
      if (!options.token.empty()) request.set(beast::http::field::authorization, "Bearer " + options.token);
    }));
    beast::websocket::response_type response;
    beast::error_code failed;
    stream_.handshake(response, options.host + ":" + options.port,
                      "/api/stream" + (options.database.empty() ? "" : "?database=" + options.database), failed);
    if (failed == beast::websocket::error::upgrade_declined) throw std::runtime_error(response.body());
    if (failed) throw beast::system_error(failed);
    stream_.read_message_max(64 << 20);
    send(options.open);
    read_next();
  }

  /// Signs this after everything sent so far. Its places are recorded here too: events only number them.
  void append(const std::string& glosses) {
    const Utterance utterance = parse_utterance(glosses);
    signed_.places.insert(signed_.places.end(), utterance.places.begin(), utterance.places.end());
    send({{"type", "append"}, {"utterance", glosses}});
  }
  /// Ends the input: once everything is signed, `run` of the context ends.
  void no_more() {
    no_more_ = true;
    close_when_done();
  }

  const Motion& motion() const { return motion_; }
  const Utterance& utterance() const { return signed_; }

 private:
  void send(const json& message) {
    waiting_.push_back(message.dump());
    ++unanswered_;
    if (waiting_.size() == 1) write_next();
  }
  void write_next() {
    stream_.text(true);
    stream_.async_write(asio::buffer(waiting_.front()), [this](beast::error_code failed, std::size_t) {
      if (failed) throw beast::system_error(failed);
      waiting_.pop_front();
      if (!waiting_.empty()) write_next();
    });
  }
  void read_next() {
    stream_.async_read(buffer_, [this](beast::error_code failed, std::size_t) {
      if (failed && done_) return;
      if (failed == beast::websocket::error::closed) throw std::runtime_error(stream_.reason().reason.c_str());
      if (failed) throw beast::system_error(failed);
      const auto data = buffer_.cdata();
      if (stream_.got_binary())
        take_frames({static_cast<const std::byte*>(data.data()), data.size()});
      else
        take(json::parse(beast::buffers_to_string(data)));
      buffer_.consume(buffer_.size());
      close_when_done();
      read_next();
    });
  }

  void take(const json& message) {
    const std::string type = message.at("type");
    if (type == "header") {
      motion_ = empty_motion(message);
      tracks_.resize(message.at("tracks").size());
      for (const json& declaration : message.at("declarations")) {
        std::cerr << "stream_client: " << declaration.at("value").get<std::string>() << '\n';
      }
    } else if (type == "ok") {
      --unanswered_;
      end_ = -1;
    } else if (type == "error") {
      throw std::runtime_error(message.at("message").get<std::string>());
    } else if (type == "place") {
      Place& place = signed_.places.at(message.at("place"));
      if (place.kind == Place::Kind::gloss) place.gloss = {message.at("gloss"), message.at("token")};
    } else if (type == "end") {
      end_ = message.at("frame");
    } else if (type == "notice") {
      std::cerr << "stream_client: " << message.at("text").get<std::string>() << '\n';
    }
  }
  void take_frames(std::span<const std::byte> message) {
    const Skeleton& skeleton = motion_.skeleton();
    const FrameShape shape{skeleton.joint_count(), skeleton.translation_count(), tracks_.size()};
    const MessageHeader header = decode_header(message, shape);
    if (std::cmp_not_equal(header.first_frame, motion_.frame_count())) throw std::runtime_error("frames are missing");
    for (std::size_t i = 0; i < header.frames; ++i) {
      decode(message.subspan(kMessageHeaderBytes + i * bytes_of(shape), bytes_of(shape)), {motion_.append(), tracks_});
    }
  }
  void close_when_done() {
    const bool ended = signed_.places.empty() || motion_.frame_count() == end_;
    if (done_ || !no_more_ || unanswered_ > 0 || !ended) return;
    done_ = true;
    stream_.async_close(beast::websocket::close_code::normal, [](beast::error_code) {});
  }

  beast::websocket::stream<asio::ip::tcp::socket> stream_;
  beast::flat_buffer buffer_;
  std::deque<std::string> waiting_;  // to be written; the first one is being written
  int unanswered_ = 0;
  bool no_more_ = false, done_ = false;
  std::int64_t end_ = -1;  // the frame after the last, once it is known
  Utterance signed_;
  Motion motion_;
  std::vector<float> tracks_;  // of one frame; BVH cannot store them
};

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("Signs glosses on a server and writes the stream as BVH.");
    std::string url;
    app.add_option("url", url, "URL of the server: http://127.0.0.1:8080")->required();
    app.add_option("gloss", options.glosses, "an utterance; without one, lines of standard input");
    app.add_option("-o", options.out, "the BVH file")->required();
    app.add_option("--database", options.database, "the database, if the server has several");
    app.add_option("--token", options.token, "the access token of the server");
    const auto ask = [&](const char* field) { return [&options, field](auto value) { options.open[field] = value; }; };
    app.add_option_function<std::string>("--rate", ask("rate"), "frames per second");
    app.add_option_function<double>("--tempo", ask("tempo"), "0.25 to 4");
    CLI11_PARSE(app, argc, argv);
    const std::string server = url.substr(url.starts_with("http://") ? 7 : 0);
    options.host = server.substr(0, server.find_first_of(":/"));
    if (const auto colon = server.find(':'); colon != server.npos)
      options.port = std::to_string(std::stoi(server.substr(colon + 1)));
    asio::io_context io;
    Client client(io, options);
    if (!options.glosses.empty()) {
      client.append(fmt::format("{}", fmt::join(options.glosses, " ")));
      client.no_more();
    } else {
      std::thread([&] {
        for (std::string line; std::getline(std::cin, line);) {
          if (!line.empty()) asio::post(io, [&client, line] { client.append(line); });
        }
        asio::post(io, [&] { client.no_more(); });
      }).detach();
    }
    io.run();
    bvh::write(options.out, client.motion(), bvh::default_layout(client.motion().skeleton()));
    std::cout << to_string(client.utterance()) << '\n';
    std::cerr << client.motion().frame_count() << " frames\n";
  } catch (const std::exception& error) {
    std::cerr << "stream_client: " << error.what() << '\n';
    return 1;
  }
}
