// Prints checksums of the program's signing, one line per case: both scenarios of the paper, edits, utterances and live
// runs, over all methods, rates, alignments and durations. A change that must not change frames leaves the text
// unchanged.
//
//     print_bits DATABASE              all cases
//     print_bits DATABASE CASE         one, given by the beginning of its line, with a checksum for each frame
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/choose/synthesizer.h"
#include "signweave/core/bytes.h"
#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/live/player.h"
#include "signweave/notation/score_json.h"

namespace {

using namespace signweave;

/// SplitMix64 (Steele, Lea and Flood 2014): the same numbers on all platforms.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t count) {
    std::uint64_t mixed = state_ += 0x9E3779B97F4A7C15u;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return static_cast<std::size_t>((mixed ^ (mixed >> 31)) % count);
  }
  bool once_in(std::size_t count) { return below(count) == 0; }
  template <class Of>
  const auto& one_of(const Of& all) {
    return all[below(std::size(all))];
  }

 private:
  std::uint64_t state_;
};

/// A checksum of bytes.
class Sum {
 public:
  template <class Value>
  void add(const Value& value) {
    static_assert(std::is_arithmetic_v<Value>);
    put(&value, sizeof value);
  }
  void add(const std::string& text) {
    add(text.size());
    put(text.data(), text.size());
  }
  void add(PoseView pose) {
    for (const Eigen::Quaternionf& rotation : pose.rotations) put(rotation.coeffs().data(), 4 * sizeof(float));
    for (const Eigen::Vector3f& translation : pose.translations) put(translation.data(), 3 * sizeof(float));
  }
  std::uint64_t value() const { return checksum(bytes_); }
  void clear() { bytes_.clear(); }

 private:
  void put(const void* from, std::size_t count) {
    const auto* bytes = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), bytes, bytes + count);
  }

  std::vector<std::byte> bytes_;
};

/// The checksums of a case's frames, and of their descriptions.
class Line {
 public:
  Line(std::string name, bool each_frame) : text_(std::move(name)), each_frame_(each_frame) {}

  void frame(std::uint64_t checksum) {
    if (each_frame_) frames_ += fmt::format("\n  {} {:016x}", count_, checksum);
    all_.add(checksum);
    block_.add(checksum);
    if (++count_ % kBlock == 0) end_block();
  }
  void say(const Sum& words) { said_ = words.value(); }
  void refuse(const Error& error) { text_ += fmt::format(" refused: {}", static_cast<int>(error.code())); }
  std::string done() {
    if (count_ % kBlock != 0) end_block();
    return fmt::format("{}: {} frames {:016x}, said {:016x}\n {}{}\n", text_, count_, all_.value(), said_, blocks_,
                       frames_);
  }

 private:
  static constexpr std::size_t kBlock = 32;
  void end_block() {
    blocks_ += fmt::format(" {:06x}", block_.value() & 0xFFFFFF);
    block_.clear();
  }

  std::string text_;
  bool each_frame_;
  std::size_t count_ = 0;
  Sum all_, block_;
  std::uint64_t said_ = 0;
  std::string blocks_, frames_;
};

void add_result(const Synthesis& made, Line& line) {
  for (std::int64_t frame = 0; frame < made.motion.frame_count(); ++frame) {
    Sum sum;
    sum.add(made.motion.pose(frame));
    for (const ScalarTrack& track : made.motion.tracks()) sum.add(track.values[static_cast<std::size_t>(frame)]);
    const FrameSource& source = made.sources[static_cast<std::size_t>(frame)];
    sum.add(source.clip);
    sum.add(source.junction);
    sum.add(source.frame);
    line.frame(sum.value());
  }
  Sum words;
  for (const Junction& junction : made.junctions) {
    words.add(junction.from);
    words.add(junction.to);
    words.add(junction.method);
    words.add(junction.frames.begin);
    words.add(junction.frames.end);
  }
  for (const PlacedSign& sign : made.signs) {
    words.add(sign.sign.gloss);
    words.add(sign.sign.span.begin.count());
    words.add(sign.sign.span.end.count());
    words.add(sign.clip);
    words.add(sign.recorded.begin.count());
  }
  line.say(words);
}

class Cases {
 public:
  Cases(const Database& database, std::string_view only) : database_(database), only_(only), base_(database) {
    for (const char* recording : {"meteo", "villes"}) {
      const AnnotationDocument document = database.document(recording);
      for (const Annotation& sign : document.find_tier("Gloss")->annotations) glosses_[recording].push_back(sign.label);
    }
    for (const auto& [recording, glosses] : glosses_) all_.insert(all_.end(), glosses.begin(), glosses.end());
  }

  void run() {
    Edit replace;
    for (const char* text : {"BRETAGNE=VANNES", "DEMAIN=MARSEILLE", "VENDREDI=RENNES", "MATIN#2=LE MANS"}) {
      replace.replacements.push_back(parse_replacement(text));
    }
    Edit swap;
    swap.swap = parse_swap("BRETAGNE..PLUIE,NUAGES#2..BROUILLARD");
    for (const TransitionMethod& method : transition_methods()) {
      file(fmt::format("scenario1 {}", method.name), {.method = &method},
           [&](const SynthesisOptions& options) { return synthesize(database_, "meteo", replace, options); });
      file(fmt::format("scenario2 {}", method.name), {.method = &method},
           [&](const SynthesisOptions& options) { return synthesize(database_, "meteo", swap, options); });
    }
    for (std::size_t i = 0; i < 50; ++i) {
      Random random(1000 + i);
      const std::string recording = random.once_in(2) ? "meteo" : "villes";
      const Edit edit = edit_of(recording, random);
      const SynthesisOptions options = options_of(random, i);
      file(fmt::format("edit {:03}", i), options,
           [&](const SynthesisOptions& given) { return synthesize(database_, recording, edit, given); });
    }
    for (std::size_t i = 0; i < 200; ++i) {
      Random random(2000 + i);
      const Utterance utterance = utterance_of(1 + random.below(8), random);
      const SynthesisOptions options = options_of(random, i);
      file(fmt::format("sign {:03}", i), options,
           [&](const SynthesisOptions& given) { return synthesize(database_, utterance, given); });
    }
    for (std::size_t i = 0; i < 50; ++i) live(i);
  }

 private:
  bool wanted(std::string_view name) const { return only_.empty() || name == only_; }

  Utterance utterance_of(std::size_t places, Random& random) {
    Utterance utterance;
    for (std::size_t i = 0; i < places; ++i) {
      Place place;
      if (random.once_in(12)) {
        place.kind = Place::Kind::piece;
        place.recording = random.once_in(2) ? "meteo" : "villes";
        const auto begin = static_cast<std::int64_t>(1000 + random.below(40'000));
        place.span = {Milliseconds(begin), Milliseconds(begin + 300 + static_cast<std::int64_t>(random.below(1500)))};
      } else {
        place.gloss.gloss = random.one_of(all_);
        place.gloss.token = random.once_in(3) ? 1 : 0;
      }
      if (i > 0 && random.once_in(6)) place.pause_before = random.once_in(2) ? kComma : kFullStop;
      utterance.places.push_back(place);
    }
    return utterance;
  }

  Edit edit_of(const std::string& recording, Random& random) {
    const std::vector<std::string>& own = glosses_.at(recording);
    const auto at = [&](std::size_t index) {
      std::size_t token = 1;
      for (std::size_t i = 0; i < index; ++i) token += own[i] == own[index] ? 1 : 0;
      return GlossRef{own[index], token};
    };
    Edit edit;
    if (random.once_in(3)) {
      const std::size_t quarter = own.size() / 4;
      const std::size_t first = random.below(quarter);
      const std::size_t second = 2 * quarter + random.below(quarter);
      edit.swap = {SignRun{at(first), at(first + random.below(quarter))},
                   SignRun{at(second), at(second + random.below(quarter))}};
      return edit;
    }
    std::size_t next = random.below(6);
    for (std::size_t i = 0, count = 1 + random.below(4); i < count && next < own.size(); ++i) {
      edit.replacements.push_back({at(next), {random.one_of(all_), 0}});
      next += 1 + random.below(6);
    }
    return edit;
  }

  static SynthesisOptions options_of(Random& random, std::size_t number) {
    static constexpr std::array<FrameRate, 5> kRates = {FrameRate{30, 1}, FrameRate{24, 1}, FrameRate{60'000, 1001},
                                                        FrameRate{120, 1}, FrameRate{100, 1}};
    static constexpr std::array kAlignments = {Alignment::automatic, Alignment::ground, Alignment::none};
    const std::span<const TransitionMethod> methods = transition_methods();
    SynthesisOptions options;
    options.method = &methods[number % methods.size()];
    if (random.once_in(2)) options.rate = random.one_of(kRates);
    options.alignment = random.one_of(kAlignments);
    if (random.once_in(3)) options.tempo = 0.6 + 0.1 * static_cast<double>(random.below(9));
    options.duration.fitted = !random.once_in(4);
    if (random.once_in(5)) options.duration.fixed = Milliseconds(static_cast<std::int64_t>(120 + random.below(900)));
    if (random.once_in(3)) {
      JunctionChoice choice;
      if (random.once_in(2)) choice.method = &random.one_of(methods);
      if (random.once_in(2)) choice.tempo = 0.5 + 0.25 * static_cast<double>(random.below(5));
      if (choice.empty()) choice.duration = Milliseconds(450);
      options.junctions.emplace(1, choice);
    }
    return options;
  }

  template <class Make>
  void file(const std::string& name, const SynthesisOptions& options, const Make& make) {
    if (!wanted(name)) return;
    Line line(name, !only_.empty());
    try {
      const Synthesis made = make(options).result;
      add_result(made, line);
      const Score read = score_from_json(json_of(made.score), name);
      if (!same_bits(synthesize(database_, read).result.motion, made.motion)) {
        throw std::runtime_error(name + ": its score, written and read, gives other frames");
      }
    } catch (const Error& error) {
      line.refuse(error);
    }
    std::fputs(line.done().c_str(), stdout);
  }

  /// A player that receives a request every few frames.
  void live(std::size_t number) {
    const std::string name = fmt::format("live {:03}", number);
    if (!wanted(name)) return;
    Line line(name, !only_.empty());
    Random random(3000 + number);
    PlayerOptions options{.synthesis = options_of(random, number),
                          .idle = random.once_in(3) ? Idle::end : Idle::living_rest,
                          .look_ahead = 1 + random.below(4)};
    options.synthesis.junctions.clear();
    options.loop = random.once_in(8);
    if (random.once_in(4)) options.recording = "villes";
    Sum words;
    try {
      Player player(base_, options);
      player.sign(utterance_of(2 + random.below(4), random));
      for (int step = 0; step < 12; ++step) {
        take(player, 20 + random.below(70), line, words);
        ask(player, random, words);
      }
    } catch (const Error& error) {
      line.refuse(error);
    }
    line.say(words);
    std::fputs(line.done().c_str(), stdout);
  }

  void ask(Player& player, Random& random, Sum& words) {
    try {
      switch (random.below(9)) {
        case 0:
          return player.sign(utterance_of(1 + random.below(4), random));
        case 1:
        case 2:
          return player.append(utterance_of(1 + random.below(3), random));
        case 3:
          return player.set_tempo(0.5 + 0.25 * static_cast<double>(random.below(5)));
        case 4:
          return player.seek(Milliseconds(static_cast<std::int64_t>(random.below(6000))));
        case 5:
          return player.set_loop(random.once_in(2));
        case 6:
          return player.stop();
        case 7:
          return player.paused() ? player.resume() : player.pause();
        default:
          return;
      }
    } catch (const Error& error) {
      words.add(static_cast<int>(error.code()));
    }
  }

  static void take(Player& player, std::size_t frames, Line& line, Sum& words) {
    for (std::size_t taken = 0; taken < frames;) {
      const std::size_t ready = player.prepare(std::min<std::size_t>(32, frames - taken));
      const StreamHeader* const header = player.header();
      if (header == nullptr) return;
      Motion room(header->skeleton, header->rate, 1);
      std::vector<float> tracks(header->tracks.size());
      std::size_t here = 0;
      for (; here < ready && taken < frames; ++here, ++taken) {
        add_events(player, words);
        if (!player.next({room.pose(0), tracks})) break;
        Sum sum;
        sum.add(PoseView(room.pose(0)));
        for (const float value : tracks) sum.add(value);
        line.frame(sum.value());
      }
      if (here == 0) break;
    }
    add_events(player, words);
  }

  static void add_events(Player& player, Sum& words) {
    while (const std::optional<PlayerEvent> event = player.take_event()) {
      words.add(static_cast<int>(event->kind));
      words.add(event->frame);
      words.add(event->place);
      words.add(event->gloss);
      words.add(event->token);
      words.add(event->recording);
      words.add(event->at.count());
    }
  }

  const Database& database_;
  std::string_view only_;
  SharedSigningCache base_;
  std::map<std::string, std::vector<std::string>> glosses_;  ///< [recording]
  std::vector<std::string> all_;
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 && count != 3) {
    std::fputs("usage: print_bits DATABASE [CASE]\n", stderr);
    return 2;
  }
  try {
    const Database database(arguments[1], kv::Access::read_only);
    Cases(database, count == 3 ? arguments[2] : "").run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "print_bits: {}\n", error.what());
    return 1;
  }
  return 0;
}
