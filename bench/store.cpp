// The motion store: engines x access modes x reads, warm, against a memcpy of the same numbers from memory.
//
// Lines "store/ENGINE/MODE/QUESTION": microseconds per read, those of the memcpy, their ratio, and the same with
// "/bytes": bytes read, bytes requested. Then random single frames against frames in order, and the engines' gets
// against a memcpy and against a plain loop over the engine's own functions.

#include <malloc.h>

#include <algorithm>

#include "bench/store_bare.h"
#include "bench/store_corpus.h"
#include "signweave/kv/kv_store.h"
#include "signweave/motion_db/motion_db.h"

namespace {

using namespace signweave;
using bench::Ask;
using bench::Corpus;
using bench::Question;

struct Options {
  double minutes = 44;
  int rounds = 11;
  double round_seconds = 0.03;
  std::vector<AccessMode> modes = {{AccessMode::Kind::full},
                                   {AccessMode::Kind::by_frame},
                                   {AccessMode::Kind::by_joint},
                                   {AccessMode::Kind::by_joint_and_frame}};
  std::vector<std::string> engines = kv::engines();
};

/// The corpus in one store, in one access mode.
class StoredCorpus {
 public:
  StoredCorpus(const std::filesystem::path& folder, const std::string& engine, AccessMode mode, const Corpus& corpus)
      : corpus_(corpus) {
    kv::create(folder, engine);
    store_ = kv::open(folder, kv::Access::read_write);
    for (std::size_t i = 0; i < corpus.motions.size(); ++i) {
      stored_.push_back(motion_db::describe(corpus.motions[i], mode, i + 1));
      motion_db::put(*store_, stored_[i], corpus.motions[i]);
    }
    store_.reset();
    store_ = kv::open(folder, kv::Access::read_only);
    snapshot_ = store_->read();
    for (const motion_db::StoredMotion& stored : stored_) {
      const auto known = std::make_shared<const motion_db::KnownMotion>(*snapshot_, stored);
      skeletons_.push_back(known->skeleton());
      sources_.push_back(std::make_unique<motion_db::StoredSource>(snapshot_, known));
    }
  }

  std::string mode() const { return to_string(stored_.front().mode); }
  std::uint64_t bytes_on_disk() const { return store_->info().bytes_on_disk; }

  Motion read(const Question& question, const Ask& ask, motion_db::ReadCost* cost = nullptr) const {
    return motion_db::read(*snapshot_, stored_[ask.motion], skeletons_[ask.motion], ask.frames, question.joints, cost);
  }
  /// Poses only; into reused memory, which belongs to `ask` until the next call.
  MutablePoses read_again(const Ask& ask) {
    const auto frames = static_cast<std::size_t>(ask.frames.size());
    const Skeleton& skeleton = *skeletons_[ask.motion];
    rotations_.resize(std::max(rotations_.size(), frames * skeleton.joint_count()));
    translations_.resize(std::max(translations_.size(), frames * skeleton.translation_count()));
    const MutablePoses poses{std::span(rotations_).first(frames * skeleton.joint_count()),
                             std::span(translations_).first(frames * skeleton.translation_count())};
    sources_[ask.motion]->read(ask.frames, poses);
    return poses;
  }
  void answer(const Question& question, const Ask& ask) {
    if (question.from_source) {
      bench::keep(read_again(ask));
    } else {
      bench::keep(read(question, ask));
    }
  }

  /// Throws if an answer differs from what was put; afterwards every record has been read once and verified.
  void check(const std::vector<Question>& questions) {
    for (std::size_t i = 0; i < corpus_.motions.size(); ++i) {
      const Ask all{i, {0, corpus_.motions[i].frame_count()}};
      require(same(read_again(all), all), "a motion");
    }
    for (const Question& question : questions) {
      for (std::size_t i = 0; i < 5; ++i) {
        const Ask& ask = question.asks[i];
        require(question.from_source ? same(read_again(ask), ask) : same(read(question, ask), ask, question.joints),
                question.name);
      }
    }
  }

 private:
  void require(bool holds, std::string_view what) const {
    if (!holds) throw std::runtime_error(fmt::format("{}: {} read differs from what was put", mode(), what));
  }
  bool same(const MutablePoses& read, const Ask& ask) const {
    const Motion should = corpus_.motions[ask.motion].slice(ask.frames);
    return std::memcmp(read.rotations.data(), should.rotations().data(), should.rotations().size_bytes()) == 0 &&
           std::memcmp(read.translations.data(), should.translations().data(), should.translations().size_bytes()) == 0;
  }
  bool same(Motion read, const Ask& ask, const JointSet& joints) const {
    const Motion should = corpus_.motions[ask.motion].slice(ask.frames);
    if (read.frame_count() != ask.frames.size()) return false;
    if (joints.empty()) return same(read.poses({0, ask.frames.size()}), ask) && read.tracks() == should.tracks();
    for (std::int64_t frame = 0; frame < ask.frames.size(); ++frame) {
      for (const JointIndex joint : joints) {
        const auto at = static_cast<std::size_t>(joint);
        if (read.pose(frame).rotations[at].coeffs() != should.pose(frame).rotations[at].coeffs()) return false;
      }
    }
    return true;
  }

  const Corpus& corpus_;
  std::vector<motion_db::StoredMotion> stored_;
  std::unique_ptr<kv::KvStore> store_;
  std::shared_ptr<const kv::ReadTransaction> snapshot_;
  std::vector<std::shared_ptr<const Skeleton>> skeletons_;
  std::vector<std::unique_ptr<motion_db::StoredSource>> sources_;
  std::vector<Eigen::Quaternionf> rotations_;
  std::vector<Eigen::Vector3f> translations_;
};

/// Seconds per call of `ours(i)` and `yardstick(i)`, i = 0, 1, …: a round has as many calls as needed to be timed
/// reliably.
template <typename Ours, typename Yardstick>
bench::Compared compare_many(const Options& options, Ours&& ours, Yardstick&& yardstick) {
  std::size_t mine = 0, other = 0;
  const double once = bench::seconds_of([&] { ours(mine++); }, 3);
  const int calls = static_cast<int>(std::clamp(options.round_seconds / once, 1.0, 20'000.0));
  return bench::compare(
      options.rounds, [&] { ours(mine++); }, [&] { yardstick(other++); }, calls);
}

void measure_question(StoredCorpus& stored, const std::string& name, AccessMode::Kind kind, const Corpus& corpus,
                      const Question& question, bench::BareCopy& copy, const Options& options) {
  const auto ask = [&](std::size_t i) -> const Ask& { return question.asks[i % question.asks.size()]; };
  const bench::Compared compared = compare_many(
      options, [&](std::size_t i) { stored.answer(question, ask(i)); }, [&](std::size_t i) { copy(question, ask(i)); });
  bench::print(fmt::format("{}/{}", name, question.name), 1e6, "us", compared, "-");
  if (question.from_source) return;
  double read = 0, asked = 0;
  const int sampled = question.asks.front().frames.size() > 5000 || kind == AccessMode::Kind::full ? 10 : 300;
  for (std::size_t i = 0; i < static_cast<std::size_t>(sampled); ++i) {
    motion_db::ReadCost cost;
    stored.read(question, ask(i), &cost);
    read += static_cast<double>(cost.bytes);
    asked += static_cast<double>(bench::bytes_asked(corpus, question, ask(i)));
  }
  bench::print(fmt::format("{}/{}/bytes", name, question.name), read / sampled, "B", asked / sampled, read / asked,
               question.fits == kind ? "<= 2" : "-");
}

/// Random single frames against single frames in order, read by `read`.
template <typename Read>
void measure_order(const std::string& name, const Corpus& corpus, const Question& random, const Options& options,
                   const Read& read) {
  Ask next{0, {0, 1}};
  const bench::Compared compared = compare_many(
      options, [&](std::size_t i) { read(random.asks[i % random.asks.size()]); },
      [&](std::size_t) {
        read(next);
        next.frames = {next.frames.end, next.frames.end + 1};
        if (next.frames.end > corpus.motions[next.motion].frame_count()) {
          next = {(next.motion + 1) % corpus.motions.size(), {0, 1}};
        }
      });
  bench::print(name, 1e9, "ns", compared, "<= 1.5");
}

void measure_modes(const std::string& engine, const Corpus& corpus, const Options& options) {
  const std::vector<Question> questions = bench::questions(corpus);
  bench::BareCopy copy(corpus);
  for (const AccessMode mode : options.modes) {
    const bench::Folder folder("store");
    std::unique_ptr<StoredCorpus> stored;
    const double seconds =
        bench::seconds_of([&] { stored = std::make_unique<StoredCorpus>(folder.path() / "db", engine, mode, corpus); });
    const std::string name = fmt::format("store/{}/{}", engine, stored->mode());
    stored->check(questions);
    fmt::print("{}/put {:.4g} s - - -\n", name, seconds);
    fmt::print("{}/disk {:.4g} MB - - -\n", name, static_cast<double>(stored->bytes_on_disk()) / 1e6);
    for (const Question& question : questions) {
      measure_question(*stored, name, mode.kind, corpus, question, copy, options);
    }
    if (mode.kind != AccessMode::Kind::by_frame) continue;
    const Question& frames = questions.back();
    measure_order(name + "/frame/random_against_in_order", corpus, frames, options,
                  [&](const Ask& ask) { bench::keep(stored->read({}, ask)); });
    measure_order(name + "/frame_again/random_against_in_order", corpus, frames, options,
                  [&](const Ask& ask) { bench::keep(stored->read_again(ask)); });
    measure_order(name + "/frame_again/memcpy_random_against_in_order", corpus, frames, options,
                  [&](const Ask& ask) { copy(frames, ask); });
  }
}

/// 16 bytes, as a record's key.
std::array<std::byte, 16> key_of(std::uint32_t number) {
  std::array<std::byte, 16> key{std::byte{'b'}};
  for (std::size_t i = 0; i < 4; ++i) key[10 + i] = static_cast<std::byte>(number >> (24 - 8 * i));
  return key;
}

/// Gets of values that fill pages, at random over as many bytes as the corpus has.
void measure_gets(const std::string& engine, const char* name, std::size_t value_size, const char* goal,
                  std::size_t total, const Options& options) {
  const bench::Folder folder("store");
  const auto count = static_cast<std::uint32_t>(total / value_size);
  Bytes memory(count * value_size);
  std::mt19937 random(1);
  for (std::size_t i = 0; i + 4 <= memory.size(); i += 4) {
    const auto word = static_cast<std::uint32_t>(random());
    std::memcpy(memory.data() + i, &word, 4);
  }
  const auto value_of = [&](std::uint32_t number) { return ByteSpan(memory).subspan(number * value_size, value_size); };
  kv::create(folder.path() / "db", engine);
  {
    const auto store = kv::open(folder.path() / "db", kv::Access::read_write);
    for (std::uint32_t number = 0; number < count;) {
      const auto change = store->write();
      for (int i = 0; i < 256 && number < count; ++i, ++number) change->put(key_of(number), value_of(number));
      change->commit();
    }
  }
  std::filesystem::copy(folder.path() / "db", folder.path() / "bare", std::filesystem::copy_options::recursive);
  const auto store = kv::open(folder.path() / "db", kv::Access::read_only);
  const auto snapshot = store->read();
  const auto bare = bench::open_bare(engine, folder.path() / "bare");
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t number = 0; number < count; ++number) order[number] = number;
  std::shuffle(order.begin(), order.end(), random);
  Bytes buffer(value_size), answer(value_size);
  const auto ours = [&](std::size_t i) {
    const std::optional<ByteSpan> value = snapshot->get(key_of(order[i % count]), buffer);
    if (!value || value->size() != value_size) throw std::runtime_error("a value has a different size");
    if (value->data() != buffer.data()) std::memcpy(buffer.data(), value->data(), value_size);
    bench::keep(buffer);
  };
  const auto theirs = [&](std::size_t i) {
    bare->get(key_of(order[i % count]), answer);
    bench::keep(answer);
  };
  for (std::uint32_t i = 0; i < count; ++i) {  // the first touch of every page, not measured
    ours(i);
    theirs(i);
    const ByteSpan is = value_of(order[i]);
    if (!std::ranges::equal(ByteSpan(buffer).first(value_size), is) || !std::ranges::equal(answer, is)) {
      throw std::runtime_error(engine + ": a value read differs from what was put");
    }
  }
  bench::print(fmt::format("store/{}/{}", engine, name), 1e9, "ns",
               compare_many(options, ours,
                            [&](std::size_t i) {
                              std::memcpy(answer.data(), value_of(order[i % count]).data(), value_size);
                              bench::keep(answer);
                            }),
               goal);
  bench::print(fmt::format("store/{}/{}/bare", engine, name), 1e9, "ns", compare_many(options, ours, theirs),
               "<= 1.15");
}

}  // namespace

int main(int count, char** arguments) {
  // A read creates a new Motion. By default, glibc returns its memory to the system after each read, and half of what
  // is measured would be page faults.
  ::mallopt(M_TRIM_THRESHOLD, 1 << 28);
  ::mallopt(M_MMAP_THRESHOLD, 1 << 25);
  try {
    Options options;
    for (int i = 1; i < count; ++i) {
      const std::string word = arguments[i];
      if (word == "--quick") {
        options.minutes = 1;
        options.rounds = 7;
        options.round_seconds = 0.001;
      } else if (word == "--engine" && i + 1 < count) {
        options.engines = {arguments[++i]};
      } else if (word == "--mode" && i + 1 < count && parse_access_mode(arguments[i + 1])) {
        options.modes = {*parse_access_mode(arguments[++i])};
      } else {
        fmt::print(stderr, "bench_store: unknown argument '{}'; available: --quick, --engine NAME and --mode MODE\n",
                   word);
        return 2;
      }
    }
    const Corpus corpus = bench::make_corpus(options.minutes);
    const Question whole{.name = "whole", .joints = {}, .fits = AccessMode::Kind::full, .from_source = true};
    std::size_t total = 0;
    std::vector<double> lengths;
    for (std::size_t i = 0; i < corpus.motions.size(); ++i) {
      total += bench::bytes_asked(corpus, whole, {i, {0, corpus.motions[i].frame_count()}});
    }
    for (const Corpus::PlacedSign& sign : corpus.signs) lengths.push_back(static_cast<double>(sign.frames.size()));
    fmt::print("store/corpus {:.1f} minutes 44 - -\n", static_cast<double>(corpus.frame_count()) / 6000);
    fmt::print("store/sign_length {:.0f} frames - - -\n", bench::median(lengths));
    for (const std::string& engine : options.engines) {
      const bool fast = engine == "lmdb";
      if (options.modes.size() == 1) {
        measure_modes(engine, corpus, options);
        continue;
      }
      measure_gets(engine, "get_4KiB", 4096 - 16, fast ? "<= 2.5" : "-", total, options);
      measure_gets(engine, "get_64KiB", 65536 - 16, fast ? "<= 1.4" : "-", total, options);
      measure_modes(engine, corpus, options);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_store: {}\n", error.what());
    return 1;
  }
  return 0;
}
