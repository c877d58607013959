// The cost of a junction beyond the copying of frames: per joint and frame of the transition against a plain slerp of
// as many joints; and whether it depends on the number of junctions. (Copying does: what fits into the caches is copied
// faster, so it is measured separately, into as much memory.) Then the same on a signer with hands, whose arms are kept
// out of the body and whose wrists and fingers are kept within limits. `--quick`: the default and the paper's, fewer
// rounds.

#include <random>

#include "bench/measure.h"
#include "signweave/choose/concatenate.h"
#include "signweave/choose/edit.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/motion/blend.h"
#include "tests/demo_database.h"

namespace {

using namespace signweave;

constexpr int kJoints = 56;
constexpr std::int64_t kSign = 60;  // frames of preparation, stroke and retraction each

std::shared_ptr<const Skeleton> chain() {
  std::vector<Joint> joints;
  for (int i = 0; i < kJoints; ++i) {
    joints.push_back(
        {.name = fmt::format("joint {}", i), .parent = i - 1, .offset = {0, 0.1f, 0}, .translated = i == 0});
  }
  return std::make_shared<const Skeleton>(std::move(joints), std::vector<Tip>{});
}

/// A recording in which every joint turns all the time.
std::shared_ptr<const MotionSource> moving(std::int64_t frames) {
  Motion motion(chain(), {100, 1}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    for (int joint = 0; joint < kJoints; ++joint) {
      const float phase = 0.05f * static_cast<float>(frame) + static_cast<float>(joint);
      const Eigen::Vector3f axis = Eigen::Vector3f(std::sin(static_cast<float>(joint)), 1.0f, 0.5f).normalized();
      motion.pose(frame).rotations[static_cast<std::size_t>(joint)] = Eigen::AngleAxisf(0.7f * std::sin(phase), axis);
    }
  }
  keep_hemisphere(motion);
  return std::make_shared<MemorySource>(std::move(motion));
}

/// Signs from the whole recording, one after another.
std::vector<MotionClip> signs(const std::shared_ptr<const MotionSource>& source, int count) {
  std::vector<MotionClip> clips;
  const std::int64_t places = source->frame_count() / (3 * kSign) - 1;
  for (int i = 0; i < count; ++i) {
    const std::int64_t begin = (i * 7) % places * 3 * kSign;
    MotionClip clip{.recording = "bench", .source = source};
    clip.whole = {begin, begin + 3 * kSign};
    clip.core = {begin + kSign, begin + 2 * kSign};
    clip.clock = {.frame_time = Seconds(0.01)};
    clip.signs.push_back({.gloss = "SIGN", .span = span_of(clip.whole, clip.clock)});
    clip.signs.back().phases.push_back({PhaseKind::stroke, span_of(clip.core, clip.clock), "Stroke", {}});
    clips.push_back(std::move(clip));
  }
  return clips;
}

/// The slerp that every transition needs at least: one per joint and frame.
class BareSlerp {
 public:
  explicit BareSlerp(std::size_t joints = kJoints) : a_(joints), b_(joints), out_(joints) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (std::vector<Eigen::Quaternionf>* side : {&a_, &b_}) {
      for (Eigen::Quaternionf& q : *side) {
        q = Eigen::Quaternionf(normal(random), normal(random), normal(random), normal(random)).normalized();
      }
    }
  }
  void frames(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      slerp(a_, b_, static_cast<float>(i + 1) / static_cast<float>(count + 1), out_);
      bench::keep(out_);
    }
  }

 private:
  std::vector<Eigen::Quaternionf> a_, b_, out_;
};

/// An utterance of so many signs, joined repeatedly into the same memory; measured against only copying its frames:
/// each sign's own and, for the transition, as many again.
class Utterance {
 public:
  Utterance(const char* method, std::shared_ptr<const MotionSource> source, int count)
      : source_(std::move(source)),
        clips_(signs(source_, count)),
        options_{.method = find_transition_method(method), .duration = Milliseconds(740)} {
    join();
    copies_.reset(source_->skeleton(), source_->rate(), used_.motion.frame_count());
    copy();
  }

  std::int64_t junctions() const noexcept { return static_cast<std::int64_t>(clips_.size()) - 1; }
  std::int64_t transition_frames() const noexcept { return 74 * junctions(); }
  void join() { used_ = concatenate(clips_, options_, std::move(used_)); }
  void copy() {
    std::int64_t at = 0;
    for (const MotionClip& clip : clips_) {
      const std::int64_t end = std::min(at + kSign + 74, copies_.frame_count());
      source_->read({clip.whole.begin, clip.whole.begin + end - at}, copies_.poses({at, end}));
      at = end;
    }
    bench::keep(copies_);
  }
  /// Seconds per junction beyond the copying, as a mean over several calls.
  double seconds_per_junction(int calls) {
    const double whole = bench::seconds_of([&] { join(); }, calls);
    const double copying = bench::seconds_of([&] { copy(); }, calls);
    return (whole - copying) / static_cast<double>(junctions());
  }

 private:
  std::shared_ptr<const MotionSource> source_;
  std::vector<MotionClip> clips_;
  ConcatenateOptions options_;
  Synthesis used_;
  Motion copies_;
};

void junction_against_slerp(const char* method, int rounds) {
  Utterance utterance(method, moving(40 * 3 * kSign), 201);
  BareSlerp slerp;
  const std::int64_t frames = utterance.transition_frames();
  std::vector<double> ours, bare, ratios;
  for (int round = 0; round < rounds; ++round) {
    ours.push_back(utterance.seconds_per_junction(1) * static_cast<double>(utterance.junctions()));
    bare.push_back(bench::seconds_of([&] { slerp.frames(frames); }));
    ratios.push_back(ours.back() / bare.back());
  }
  const double nanoseconds = 1e9 / static_cast<double>(frames * kJoints);
  bench::print(fmt::format("junction/{}/per_joint_and_frame", method), nanoseconds, "ns",
               {bench::median(ours), bench::median(bare), bench::median(ratios)}, "<= 3");
}

/// The same junctions in an utterance of 1,000 signs and in one of 10.
void long_against_short(const char* method, int rounds) {
  const auto source = moving(40 * 3 * kSign);
  Utterance many(method, source, 1000);
  Utterance few(method, source, 10);
  std::vector<double> ours, theirs, ratios;
  for (int round = 0; round < rounds; ++round) {
    ours.push_back(many.seconds_per_junction(1));
    theirs.push_back(few.seconds_per_junction(100));
    ratios.push_back(ours.back() / theirs.back());
  }
  bench::print(fmt::format("junction/{}/at_1000_signs_against_10", method), 1e6, "us",
               {bench::median(ours), bench::median(theirs), bench::median(ratios)}, "<= 1.15");
}

/// The default method between signs of the demo's signer, in the utterance of the paper's first scenario. The generated
/// frames are those between the frames that each part keeps of its own; the kept ones are copied by the retrieval.
void on_a_signer(int rounds) {
  const bench::Folder folder("junction");
  const auto database = demo_database(folder.path() / "corpus.db", 2.0);
  Edit edit;
  for (const char* text : {"BRETAGNE=VANNES", "DEMAIN=MARSEILLE", "VENDREDI=RENNES", "MATIN#2=LE MANS"}) {
    edit.replacements.push_back(parse_replacement(text));
  }
  Synthesis used = synthesize(*database, "meteo", edit).result;
  std::int64_t frames = 0;
  for (const Junction& junction : used.junctions) frames += junction.frames.size();
  const std::size_t joints = used.motion.skeleton().joint_count();
  BareSlerp slerp(joints);
  std::vector<double> ours, bare, ratios;
  for (int round = 0; round < rounds; ++round) {
    Synthesized made = synthesize(*database, "meteo", edit, {}, std::move(used));
    used = std::move(made.result);
    ours.push_back(made.timings.concatenation.count());
    bare.push_back(bench::seconds_of([&] { slerp.frames(frames); }));
    ratios.push_back(ours.back() / bare.back());
  }
  bench::print("junction/on_a_signer/per_joint_and_frame",
               1e9 / static_cast<double>(frames) / static_cast<double>(joints), "ns",
               {bench::median(ours), bench::median(bare), bench::median(ratios)}, "<= 3");
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
  const int rounds = quick ? 5 : 31;
  for (const TransitionMethod& method : transition_methods().first(quick ? 4 : transition_methods().size())) {
    const std::string name(method.name);
    junction_against_slerp(name.c_str(), rounds);
    long_against_short(name.c_str(), rounds);
  }
  on_a_signer(rounds);
  return 0;
}
