// Packing: finds, for each joint and run of frames, the smallest form that gives the same bits.

#include <algorithm>
#include <bit>
#include <numeric>

#include "signweave/motion_db/compact.h"
#include "signweave/motion_db/compact_layout.h"

namespace signweave::motion_db {

namespace {

bool same_bits(float a, float b) noexcept {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// Larger whole numbers are not used: their products with a step are not exact.
constexpr float kMostSteps = 2'097'152.0f;

/// Returns the multiple of a step that equals a value to the bit, if there is one.
struct Multiple {
  std::int32_t steps = 0;
  bool is = false;
};
Multiple multiple_of(float value, float step, float inverse) noexcept {
  const float steps = value * inverse;
  if (!(std::fabs(steps) < kMostSteps)) return {};
  const auto whole = static_cast<std::int32_t>(std::lrintf(steps));
  return {whole, same_bits(static_cast<float>(whole) * step, value)};
}

/// The range of multiples over a run: base, and the number of bits above it.
struct Range {
  std::int32_t base = 0;
  std::uint32_t width = 0;
};
Range range_of(std::span<const std::int32_t> steps) noexcept {
  const auto [low, high] = std::ranges::minmax(steps);
  return {low, static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(high - low)))};
}

/// Finds the coarsest grid that contains all numbers over a run.
struct Gridded {
  bool found = false;
  int level = 0;
};
/// `values` is [number][frame]; `steps` receives the multiples.
Gridded find_grid(std::span<const float> values, std::span<std::int32_t> steps) noexcept {
  for (int level = kCoarsestLevel; level >= 0; --level) {
    const float step = step_of(level);
    const float inverse = 1.0f / step;
    bool all = true;
    for (std::size_t i = 0; i < values.size() && all; ++i) {
      const Multiple multiple = multiple_of(values[i], step, inverse);
      steps[i] = multiple.steps;
      all = multiple.is;
    }
    if (all) return {true, level};
  }
  return {};
}

constexpr std::size_t kMostFrames = static_cast<std::size_t>(kRunFrames);

/// A joint's packed rotations over a run.
struct PackedRotation {
  bool raw = true;
  std::uint8_t level = 0;
  Dropped dropped;
  std::array<Range, 3> ranges;
  std::array<std::int32_t, 3 * kMostFrames> steps{};  ///< [stored number][frame]
};

PackedRotation pack_rotation(std::span<const Eigen::Quaternionf> values) {
  PackedRotation packed;
  const std::size_t frames = values.size();
  std::array<float, 3 * kMostFrames> kept{};
  for (const int component : {3, 0, 1, 2}) {
    const Dropped dropped{component, std::signbit(values[0].coeffs()[component])};
    bool restores = true;
    for (std::size_t t = 0; t < frames && restores; ++t) {
      const auto& q = values[t].coeffs();
      for (int i = 0; i < 3; ++i) kept[static_cast<std::size_t>(i) * frames + t] = q[kept_component(dropped, i)];
      const Eigen::Quaternionf back = restored(dropped, kept[t], kept[frames + t], kept[2 * frames + t]);
      restores = same_bits(back.coeffs()[component], q[component]);
    }
    if (!restores) continue;
    const Gridded grid = find_grid(std::span(kept).first(3 * frames), packed.steps);
    if (!grid.found) continue;
    packed.raw = false;
    packed.level = static_cast<std::uint8_t>(grid.level);
    packed.dropped = dropped;
    for (std::size_t i = 0; i < 3; ++i) {
      packed.ranges[i] = range_of(std::span<const std::int32_t>(packed.steps).subspan(i * frames, frames));
    }
    return packed;
  }
  return packed;
}

/// One packed component of a translation over a run.
struct PackedNumber {
  bool raw = true;
  std::uint8_t level = 0;
  Range range;
  std::array<std::int32_t, kMostFrames> steps{};
};

PackedNumber pack_number(std::span<const float> values) {
  PackedNumber packed;
  const Gridded grid = find_grid(values, packed.steps);
  if (!grid.found) return packed;
  packed.raw = false;
  packed.level = static_cast<std::uint8_t>(grid.level);
  packed.range = range_of(std::span<const std::int32_t>(packed.steps).first(values.size()));
  return packed;
}

/// A run, packed joint by joint and number by number.
struct PackedRun {
  FrameRange frames;
  std::vector<PackedRotation> rotations;   ///< [joint]; one element in a packet of one joint
  std::vector<PackedNumber> translations;  ///< [translation][3]
};

/// Writes four bit streams, interleaved word by word.
class LaneWriter {
 public:
  explicit LaneWriter(std::size_t bytes) : bytes_(bytes) {}
  void put(std::size_t lane, std::uint64_t bit, std::uint32_t width, std::uint32_t value) {
    for (std::uint32_t done = 0; done < width;) {
      const std::uint64_t at = bit + done;
      const auto shift = static_cast<std::uint32_t>(at % 32);
      const std::uint32_t count = std::min(width - done, 32 - shift);
      const std::size_t word = (static_cast<std::size_t>(at / 32) * kLanes + lane) * 4;
      std::uint32_t bits = loaded<std::uint32_t>(bytes_.data() + word);
      bits |= (value >> done) << shift;
      std::memcpy(bytes_.data() + word, &bits, sizeof bits);
      done += count;
    }
  }
  const Bytes& bytes() const noexcept { return bytes_; }

 private:
  Bytes bytes_;
};

/// Packs a packet's part of the motion.
class Packer {
 public:
  Packer(const Motion& motion, const Record& packet)
      : motion_(motion), packet_(packet), counts_(packet, width_of(motion.skeleton(), packet)) {}
  Bytes packed();

 private:
  Eigen::Quaternionf rotation(std::int64_t frame, std::size_t at) const {
    return motion_.pose(frame).rotations[counts_.one_joint ? packet_.part : at];
  }
  Eigen::Vector3f translation(std::int64_t frame, std::size_t at) const {
    return motion_.pose(frame).translations[counts_.one_joint ? *motion_.skeleton().translation_of(packet_.part) : at];
  }
  PackedRun pack_run(FrameRange frames) const;
  std::vector<std::uint16_t> order_of(std::span<const PackedRun> runs) const;
  void write_run(const PackedRun& run, ByteWriter& out) const;
  void write_raw(const PackedRun& run, ByteWriter& out) const;

  const Motion& motion_;
  const Record& packet_;
  Counts counts_;
  std::vector<std::uint16_t> order_;  ///< [place] joint
};

PackedRun Packer::pack_run(FrameRange frames) const {
  PackedRun run{.frames = frames, .rotations = {}, .translations = {}};
  const auto count = static_cast<std::size_t>(frames.size());
  std::array<Eigen::Quaternionf, kMostFrames> rotations;
  for (std::size_t joint = 0; joint < counts_.rotations; ++joint) {
    for (std::size_t t = 0; t < count; ++t) rotations[t] = rotation(frames.begin + static_cast<std::int64_t>(t), joint);
    run.rotations.push_back(pack_rotation(std::span(rotations).first(count)));
  }
  for (std::size_t at = 0; at < counts_.translations; ++at) {
    std::array<PackedNumber, 3> numbers;
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<float, kMostFrames> values{};
      for (std::size_t t = 0; t < count; ++t) {
        values[t] = translation(frames.begin + static_cast<std::int64_t>(t), at)[static_cast<Eigen::Index>(c)];
      }
      numbers[c] = pack_number(std::span(values).first(count));
    }
    // The three components of a translation are stored raw together, or none of them.
    const bool raw = numbers[0].raw || numbers[1].raw || numbers[2].raw;
    for (PackedNumber& number : numbers) {
      if (raw) number = PackedNumber{};
      run.translations.push_back(number);
    }
  }
  return run;
}

/// Groups joints whose numbers need similar numbers of bits, because those of a group have one width. Each group begins
/// with the joint that needs most and takes those that widen it least.
std::vector<std::uint16_t> Packer::order_of(std::span<const PackedRun> runs) const {
  std::vector<std::uint16_t> left(counts_.rotations);
  std::iota(left.begin(), left.end(), std::uint16_t{0});
  // [joint][run][stored number]
  const auto width = [&](std::size_t joint, std::size_t at) {
    return runs[at / 3].rotations[joint].ranges[at % 3].width;
  };
  const std::size_t widths = runs.size() * 3;
  std::vector<std::uint32_t> total(counts_.rotations, 0);
  for (std::size_t joint = 0; joint < total.size(); ++joint) {
    for (std::size_t i = 0; i < widths; ++i) total[joint] += width(joint, i);
  }
  std::stable_sort(left.begin(), left.end(), [&](std::uint16_t a, std::uint16_t b) { return total[a] > total[b]; });
  std::vector<std::uint16_t> order;
  std::vector<std::uint32_t> most(widths);
  const auto drops_w = [](const PackedRun& run, std::size_t joint) {
    return run.rotations[joint].dropped.component == 3;
  };
  constexpr std::uint32_t kExchangeWaste = 2;
  // In skeletons with very many joints only those with similar needs are examined.
  constexpr std::size_t kLookAhead = 128;
  while (!left.empty()) {
    std::ranges::fill(most, 0);
    for (std::size_t lane = 0; lane < kLanes && !left.empty(); ++lane) {
      std::size_t best = 0;
      std::uint32_t least = 0;
      for (std::size_t i = 0; i < std::min(left.size(), kLookAhead) && lane > 0; ++i) {
        // Wasted bits: the group's widening, and what the joint leaves unused.
        std::uint32_t waste = 0;
        for (std::size_t at = 0; at < widths; ++at) {
          const std::uint32_t own = width(left[i], at);
          waste += own > most[at] ? (own - most[at]) * static_cast<std::uint32_t>(lane) : most[at] - own;
        }
        // A group in which w was dropped everywhere unpacks faster: that is worth a few bits.
        for (const PackedRun& run : runs) {
          const bool alike = drops_w(run, left[i]) == drops_w(run, order.back());
          waste += alike ? 0 : kExchangeWaste;
        }
        if (i > 0 && waste >= least) continue;
        least = waste;
        best = i;
      }
      const std::uint16_t joint = left[best];
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
      order.push_back(joint);
      for (std::size_t at = 0; at < widths; ++at) most[at] = std::max(most[at], width(joint, at));
    }
  }
  return order;
}

void Packer::write_raw(const PackedRun& run, ByteWriter& out) const {
  for (std::size_t place = 0; place < order_.size(); ++place) {
    if (run.rotations[order_[place]].raw) out.number(static_cast<std::uint16_t>(order_[place]));
  }
  for (std::size_t at = 0; at < counts_.translations; ++at) {
    if (run.translations[3 * at].raw) out.number(static_cast<std::uint16_t>(at));
  }
  for (std::int64_t frame = run.frames.begin; frame < run.frames.end; ++frame) {
    for (const std::uint16_t joint : order_) {
      if (!run.rotations[joint].raw) continue;
      const Eigen::Quaternionf q = rotation(frame, joint);
      for (const float value : q.coeffs()) out.number(value);
    }
    for (std::size_t at = 0; at < counts_.translations; ++at) {
      if (!run.translations[3 * at].raw) continue;
      const Eigen::Vector3f v = translation(frame, at);
      for (const float value : v) out.number(value);
    }
  }
}

void Packer::write_run(const PackedRun& run, ByteWriter& out) const {
  const std::size_t in_group = counts_.in_group();
  const auto frames = static_cast<std::size_t>(run.frames.size());
  bool wide = false;
  std::size_t raw_rotations = 0;
  std::size_t raw_translations = 0;
  for (const PackedRotation& rotation : run.rotations) {
    raw_rotations += rotation.raw ? 1 : 0;
    for (const Range& range : rotation.ranges) {
      wide = wide || range.base != static_cast<std::int16_t>(range.base);
    }
  }
  for (std::size_t at = 0; at < counts_.translations; ++at) raw_translations += run.translations[3 * at].raw ? 1 : 0;

  // The widths of the groups, and the position of each group's bits in a row.
  std::vector<std::array<std::uint32_t, 3>> rotation_widths(counts_.rotation_groups());
  std::vector<std::uint32_t> translation_widths(counts_.translation_groups());
  for (std::size_t place = 0; place < order_.size(); ++place) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& most = rotation_widths[place / in_group][i];
      most = std::max(most, run.rotations[order_[place]].ranges[i].width);
    }
  }
  for (std::size_t i = 0; i < run.translations.size(); ++i) {
    std::uint32_t& most = translation_widths[i / in_group];
    most = std::max(most, run.translations[i].range.width);
  }
  std::uint32_t row_bits = 0;
  for (const auto& widths : rotation_widths) row_bits += widths[0] + widths[1] + widths[2];
  for (const std::uint32_t width : translation_widths) row_bits += width;

  out.number(row_bits);
  out.number(static_cast<std::uint16_t>(wide ? 1 : 0));
  out.number(static_cast<std::uint16_t>(raw_rotations));
  out.number(static_cast<std::uint16_t>(raw_translations));
  LaneWriter lanes(stream_bytes(row_bits, counts_.rows(frames)));
  std::uint64_t bit = 0;
  const auto put = [&](std::size_t place, std::size_t frame, std::uint32_t width, std::uint32_t value) {
    if (counts_.one_joint) {
      lanes.put(frame % kLanes, frame / kLanes * row_bits + bit, width, value);
    } else {
      lanes.put(place % kLanes, frame * std::uint64_t{row_bits} + bit, width, value);
    }
  };
  const PackedRotation none;
  for (std::size_t group = 0; group < rotation_widths.size(); ++group) {
    const auto at = [&](std::size_t lane) -> const PackedRotation& {
      const std::size_t place = group * in_group + lane;
      return place < order_.size() ? run.rotations[order_[place]] : none;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t lane = 0; lane < in_group; ++lane) {
        const std::int32_t base = at(lane).ranges[i].base;
        if (wide) {
          out.number(base);
        } else {
          out.number(static_cast<std::int16_t>(base));
        }
        for (std::size_t frame = 0; frame < frames && !at(lane).raw; ++frame) {
          put(lane, frame, rotation_widths[group][i],
              static_cast<std::uint32_t>(at(lane).steps[i * frames + frame] - base));
        }
      }
      bit += rotation_widths[group][i];
    }
    for (std::size_t lane = 0; lane < in_group; ++lane) out.number(at(lane).level);
    for (std::size_t lane = 0; lane < in_group; ++lane) {
      const Dropped dropped = at(lane).dropped;
      out.number(static_cast<std::uint8_t>(dropped.component | (dropped.negative ? 4 : 0)));
    }
    const auto& widths = rotation_widths[group];
    out.number(static_cast<std::uint16_t>(widths[0] | widths[1] << 5 | widths[2] << 10));
  }
  const PackedNumber no_number;
  for (std::size_t group = 0; group < translation_widths.size(); ++group) {
    const auto at = [&](std::size_t lane) -> const PackedNumber& {
      const std::size_t i = group * in_group + lane;
      return i < run.translations.size() ? run.translations[i] : no_number;
    };
    for (std::size_t lane = 0; lane < in_group; ++lane) {
      out.number(at(lane).range.base);
      for (std::size_t frame = 0; frame < frames && !at(lane).raw; ++frame) {
        put(lane, frame, translation_widths[group],
            static_cast<std::uint32_t>(at(lane).steps[frame] - at(lane).range.base));
      }
    }
    bit += translation_widths[group];
    for (std::size_t lane = 0; lane < in_group; ++lane) out.number(at(lane).level);
    out.number(static_cast<std::uint8_t>(translation_widths[group]));
  }
  write_raw(run, out);
  out.raw(lanes.bytes());
}

Bytes Packer::packed() {
  const Runs runs(packet_.frames);
  const auto run_at = [&](std::int64_t run) { return pack_run(frames_of_run(run, packet_.frames)); };
  // The order is chosen from a sample of the runs, so that a packet of any length is packed in little memory.
  constexpr std::int64_t kMostLookedAt = 64;
  const std::int64_t stride = (runs.end - runs.first + kMostLookedAt - 1) / kMostLookedAt;
  std::vector<PackedRun> some;
  for (std::int64_t run = runs.first; run < runs.end; run += stride) some.push_back(run_at(run));
  order_ = order_of(some);
  ByteWriter out;
  ByteWriter body;
  if (!counts_.one_joint) {
    for (const std::uint16_t joint : order_) out.number(joint);
  }
  const std::size_t before = counts_.order_bytes() + 4 * runs.count();
  for (std::int64_t run = runs.first; run < runs.end; ++run) {
    out.number(static_cast<std::uint32_t>(before + body.size()));
    if (stride == 1) {
      write_run(some[static_cast<std::size_t>(run - runs.first)], body);
    } else {
      write_run(run_at(run), body);
    }
  }
  out.raw(body.bytes());
  out.raw(Bytes(kPadding));
  return out.take();
}

}  // namespace

Bytes pack(const Motion& motion, const Record& packet) {
  return Packer(motion, packet).packed();
}

}  // namespace signweave::motion_db
