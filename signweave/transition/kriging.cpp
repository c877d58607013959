#include "signweave/transition/kriging.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

#include "signweave/transition/curve_loops.h"
#include "signweave/transition/fill.h"

namespace signweave {
namespace {

/// Covariance at a time distance, for variance 1.
double matern(double distance, double length) noexcept {
  const double r = std::sqrt(5.0) * std::abs(distance) / length;
  return (1 + r + r * r / 3) * std::exp(-r);
}

/// Correlation length of a trajectory: longer in longer gaps, whose movements are slower. Tuned on captured spans
/// (docs/decisions/transitions.md, 226). Below ten frames a second it is three frames; otherwise frames would be
/// uncorrelated.
double length_for(double seconds, double frame_time) noexcept {
  return std::max(0.3 * std::max(1.0, seconds), 3 * frame_time);
}

/// Variance of the samples' errors, in the covariance's unit: for a clean capture, per squared radian of noise, and its
/// maximum. The border itself is met regardless of the noise.
constexpr double kNoise = 1e-5;
constexpr double kNoiseBySquare = 10;
constexpr double kMostNoise = 50 * kNoise;
constexpr double kBorderNoise = 1e-9;

/// Mean noise variance of shoulders and elbows on both sides, in squared radians.
double arm_noise(const Gap& gap) noexcept {
  double sum = 0;
  int count = 0;
  for (const CaptureNoise* noise : {gap.noise_before, gap.noise_after}) {
    for (std::size_t joint = 0; joint < gap.groups->roles.size(); ++joint) {
      const JointRole role = gap.groups->roles[joint];
      if (role != JointRole::shoulder && role != JointRole::elbow) continue;
      const double deviation = noise != nullptr ? static_cast<double>(noise->rotations[joint]) : 0.0;
      sum += deviation * deviation;
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

/// Rounded to half octaves, so that gaps between many recordings have few kinds.
double noise_for(const Gap& gap) noexcept {
  const double noise = std::clamp(kNoiseBySquare * arm_noise(gap), kNoise, kMostNoise);
  return kNoise * std::exp2(std::round(2 * std::log2(noise / kNoise)) / 2);
}

/// Everything that weights depend on.
struct Kind {
  double hertz = 0;
  double pause = 0;  ///< seconds
  double noise = 0;
  std::int64_t frames = 0;
  std::size_t left = 0;
  std::size_t right = 0;
  friend bool operator==(const Kind&, const Kind&) = default;

  std::size_t hash() const noexcept {
    std::uint64_t mixed = std::bit_cast<std::uint64_t>(hertz) ^ std::rotl(std::bit_cast<std::uint64_t>(pause), 21) ^
                          std::rotl(std::bit_cast<std::uint64_t>(noise), 42);
    for (const std::uint64_t number : {static_cast<std::uint64_t>(frames), std::uint64_t{left}, std::uint64_t{right}}) {
      mixed = (mixed ^ number) * 0x9E3779B97F4A7C15u;
      mixed ^= mixed >> 29;
    }
    return static_cast<std::size_t>(mixed);
  }
};

/// The weights of one kind of gap. Written once, by the thread that claims the entry, and then only read.
struct KeptWeights {
  enum State : int { free, written, ready };
  std::atomic<int> state{free};
  Kind kind;
  std::array<float, static_cast<std::size_t>(kMostKeptFrames) * 2 * Kriging::kMostSamples> rows;  ///< [frame][sample]
};
std::array<KeptWeights, kMostKept> kept_weights;  // all zero, so that its pages are allocated on writing

/// The cache entry of a kind: its weights, or a newly claimed entry to write them to. Neither if all its entries are
/// taken.
struct CacheEntry {
  const KeptWeights* known = nullptr;
  KeptWeights* taken = nullptr;
};
CacheEntry entry_of(const Kind& kind) noexcept {
  constexpr std::size_t kLookedAt = 8;
  if (kind.frames > kMostKeptFrames) return {};
  const std::size_t first = kind.hash();
  for (std::size_t i = 0; i < kLookedAt; ++i) {
    KeptWeights& one = kept_weights[(first + i) % kMostKept];
    int state = one.state.load(std::memory_order_acquire);
    if (state == KeptWeights::ready && one.kind == kind) return {.known = &one};
    if (state == KeptWeights::free &&
        one.state.compare_exchange_strong(state, KeptWeights::written, std::memory_order_acquire)) {
      one.kind = kind;
      return {.taken = &one};
    }
  }
  return {};
}

}  // namespace

Kriging::Kriging(const Gap& gap, const GapTime& time, std::vector<double>& memory, Weights weights)
    : hertz_(gap.rate.hertz()),
      seconds_(time.seconds()),
      length_(length_for(seconds_, 1.0 / hertz_)),
      noise_(noise_for(gap)) {
  const auto wanted = std::max<std::size_t>(3, static_cast<std::size_t>(std::llround(kKrigingContext * hertz_)) + 1);
  stride_ = (wanted + kMostSamples - 1) / kMostSamples;
  const auto count = [&](const PosesView& side) {
    const auto frames = static_cast<std::size_t>(context_frames(side, gap.rate));
    return std::min(kMostSamples, (std::min(frames, wanted) + stride_ - 1) / stride_);
  };
  left_ = count(gap.before);
  right_ = count(gap.after);
  memory.resize(2 * samples() * samples() + 2 * samples());
  CacheEntry entry;
  if (weights == Weights::cached) {
    entry = entry_of({.hertz = hertz_,
                      .pause = gap.pause.count(),
                      .noise = noise_,
                      .frames = gap.count,
                      .left = left_,
                      .right = right_});
  }
  if (entry.known != nullptr) {
    rows_ = entry.known->rows.data();
    return;
  }
  solve(memory);
  if (entry.taken == nullptr) return;
  float* const rows = entry.taken->rows.data();
  for (std::int64_t frame = 0; frame < gap.count; ++frame) {
    row(time.at(frame), frame, rows + static_cast<std::size_t>(frame) * samples());
  }
  entry.taken->state.store(KeptWeights::ready, std::memory_order_release);
  rows_ = rows;
}

void Kriging::solve(std::vector<double>& memory) {
  const std::size_t n = samples();
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::Map<Eigen::MatrixXd> covariance(memory.data(), size, size);
  Eigen::Map<Eigen::MatrixXd> inverse(memory.data() + n * n, size, size);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = matern(time_of(i) - time_of(j), length_);
    }
    covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) +=
        i == 0 || i == left_ ? kBorderNoise : noise_;
  }
  // In place, without allocation.
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(covariance);
  inverse.setIdentity();
  factor.solveInPlace(inverse);
  double* sums = memory.data() + 2 * n * n;
  total_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sums[i] = inverse.row(static_cast<Eigen::Index>(i)).sum();
    total_ += sums[i];
  }
  inverse_ = memory.data() + n * n;
  sums_ = sums;
  near_ = sums + n;
}

void Kriging::row(double t, std::int64_t frame, float* out) const noexcept {
  if (rows_ != nullptr) {
    std::copy_n(rows_ + static_cast<std::size_t>(frame) * samples(), samples(), out);
    return;
  }
  const double time = t * seconds_;
  const std::size_t n = samples();
  double explained = 0;  // share explained by the samples; the unknown mean accounts for the remainder
  for (std::size_t i = 0; i < n; ++i) {
    near_[i] = matern(time - time_of(i), length_);
    explained += sums_[i] * near_[i];
  }
  const double rest = (1 - explained) / total_;
  for (std::size_t i = 0; i < n; ++i) {
    double weight = rest * sums_[i];
    for (std::size_t j = 0; j < n; ++j) weight += inverse_[i * n + j] * near_[j];
    out[i] = static_cast<float>(weight);
  }
}

void Kriging::coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
  for (std::size_t i = 0; i < left_; ++i) out[i] = sides.before[i * stride_];
  for (std::size_t i = 0; i < right_; ++i) out[left_ + i] = sides.after[i * stride_];
}

void Kriging::vectors(const GapScratch& scratch, double, float* out) const noexcept {
  const std::size_t width = 3 * scratch.taken.size();
  const auto take = [&](const std::vector<float>& seen, std::size_t samples) {
    for (std::size_t i = 0; i < samples; ++i) out = std::copy_n(seen.data() + i * stride_ * width, width, out);
  };
  take(scratch.seen[0], left_);
  take(scratch.seen[1], right_);
}

void FingerCurves::row(double t, std::int64_t, float* out) const noexcept {
  const double square = t * t;
  const double risen = 3 * square - 2 * square * t;
  const auto run = [](double since) {
    const double x = since / kRun;
    return x < 1 ? since * (1 - x) * (1 - x) : 0.0;
  };
  out[0] = static_cast<float>(1 - risen);
  out[1] = static_cast<float>(risen);
  out[2] = static_cast<float>(run(t));
  out[3] = static_cast<float>(-run(1 - t));
}

void FingerCurves::coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
  const auto seconds = static_cast<float>(sides.seconds);
  out[0] = sides.left();
  out[1] = sides.right();
  out[2] = -seconds * before.of(sides.before);
  out[3] = seconds * after.of(sides.after);
}

void FingerCurves::vectors(const GapScratch& scratch, double seconds, float* out) const noexcept {
  const std::size_t width = 3 * scratch.taken.size();
  const auto over = static_cast<float>(seconds);
  std::copy_n(scratch.seen[0].data(), width, out);
  std::copy_n(scratch.seen[1].data(), width, out + width);
  curve_loops::add_differences(before.weights(), scratch.seen[0].data(), width, -over, out + 2 * width);
  curve_loops::add_differences(after.weights(), scratch.seen[1].data(), width, over, out + 3 * width);
}

void fill_kriging(const GapJob& job, MutablePoses out) noexcept {
  const GapTime time(job.gap);
  fill_by_part(
      job, [&](const GapJob& fingers) { fill_curves(fingers, out, FingerCurves(job.gap), time); },
      [&](const GapJob& others) { fill_curves(others, out, Kriging(job.gap, time, job.scratch.numbers), time); });
}

}  // namespace signweave
