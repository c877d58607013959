// From an utterance to a score, from the score to a part of its frames, and the same signing as a stream.
//
//   score DATABASE UTTERANCE SCORE.json PART.bvh
#include <signweave/signweave.h>

#include <fstream>
#include <iostream>
#include <vector>

int main(int argc, char** argv) {
  using namespace signweave;
  if (argc != 5) {
    std::cerr << "usage: score DATABASE UTTERANCE SCORE.json PART.bvh\n";
    return 2;
  }
  try {
    const Database database(argv[1], kv::Access::read_only);
    const Utterance utterance = parse_utterance(argv[2], words_of(database));

    // 1. Sign, and keep what was decided: two kilobytes a sign, and no frames.
    const Synthesized made = synthesize(database, utterance);
    std::ofstream(argv[3]) << json_of(made.result.score);
    std::cout << to_string(made.result.score);

    // 2. Render a part of it, later or elsewhere: here the last clip, from the middle of the junction before it on.
    OpenScore open(database, score_from_json(read_file(argv[3]), argv[3]));
    const Clip& last = open.score().clips.back();
    const std::int64_t begin = open.score().clips.size() > 1 ? (last.at.begin + (&last - 1)->at.end) / 2 : 0;
    Motion part;
    open.render({begin, open.score().frames}, part);
    const RecordingInfo source = *database.info(open.score().skeleton.recording);
    bvh::write(argv[4], part,
               source.motion_facts.layout ? *source.motion_facts.layout : bvh::default_layout(part.skeleton()));
    std::cout << part.frame_count() << " of " << open.score().frames << " frames in " << argv[4] << '\n';

    // 3. Stream it: frame by frame in the bytes that a client reads, with events that name the clips of the score.
    SharedSigningCache cache(database);
    Player player(cache, {.idle = Idle::end});
    player.sign(utterance);
    std::size_t frames = 0;
    std::vector<std::byte> message;
    while (player.prepare(Player::kMostReady) > 0) {
      const StreamHeader& header = *player.header();
      Motion room(header.skeleton, header.rate, 1);
      std::vector<float> tracks(header.tracks.size());
      message.resize(kMessageHeaderBytes + bytes_of(header.shape()));
      const auto report_events = [&] {
        while (const std::optional<PlayerEvent> event = player.take_event()) {
          if (event->kind != PlayerEvent::Kind::place) continue;
          std::cout << "frame " << event->frame << ": place " << event->place << ", " << event->gloss << ", clip "
                    << event->clip << '\n';
        }
      };
      for (report_events(); player.next({room.pose(0), tracks}); report_events()) {
        encode(MessageHeader{.frames = 1, .first_frame = frames}, std::span(message).first(kMessageHeaderBytes));
        encode(FrameView{room.pose(0), tracks}, std::span(message).subspan(kMessageHeaderBytes));
        ++frames;  // here it would be sent
      }
    }
    std::cout << frames << " frames streamed, " << message.size() << " bytes each\n";
  } catch (const Error& error) {
    std::cerr << "score: " << error.what() << '\n';
    return 1;
  }
}
