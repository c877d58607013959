#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "signweave/core/text.h"
#include "signweave/core/text_reader.h"
#include "signweave/formats/bvh.h"
#include "signweave/formats/bvh_euler.h"
#include "signweave/formats/bvh_guess.h"
#include "signweave/formats/bvh_hierarchy.h"
#include "signweave/formats/bvh_space.h"

namespace signweave::bvh {
namespace {

constexpr std::size_t kBytesPerReport = std::size_t{1} << 20;
/// Joints times frames that a file with hardly any channels may hold: 64 MiB of poses.
constexpr std::size_t kFreePoses = std::size_t{1} << 22;

/// What stands between HIERARCHY and the numbers.
struct MotionHeader {
  std::int64_t frames = 0;
  std::string frame_time;
  SnappedRate rate;
};

/// "Frames: 12" as key and value.
struct Entry {
  std::string key;
  std::string value;
};

Entry read_entry(TextReader& reader, std::string_view expected) {
  std::string line(reader.word());
  if (line.empty()) reader.fail(fmt::format("the file ends here, expected '{}'", expected));
  line += ' ';
  line += reader.rest_of_line();
  const std::size_t colon = line.find(':');
  Entry entry;
  if (colon != std::string::npos) {
    for (const char c : line.substr(0, colon)) {
      if (c != ' ' && c != '\t') entry.key += c;
    }
    entry.value = trimmed(std::string_view(line).substr(colon + 1));
  } else {
    entry.value = trimmed(line);
  }
  return entry;
}

MotionHeader read_header(TextReader& reader, std::vector<Notice>& notices) {
  const std::string_view word = reader.word();
  if (word == "}") reader.fail("a '}' too many after the root joint; remove it");
  if (is_keyword(word, "ROOT")) {
    reader.fail("a second ROOT; a file holds one skeleton here, so split it into one file per skeleton");
  }
  if (word.empty()) reader.fail("the file ends before MOTION; it holds a skeleton but no frames");
  if (!is_keyword(word, "MOTION")) reader.fail(fmt::format("expected MOTION, found '{}'", printable(word)));

  MotionHeader header;
  const Entry frames = read_entry(reader, "Frames: N");
  if (!is_keyword(frames.key, "Frames")) {
    reader.fail(fmt::format("expected 'Frames: N', found '{}'", printable(frames.key + " " + frames.value)));
  }
  const char* const end = frames.value.data() + frames.value.size();
  const auto [at, error] = std::from_chars(frames.value.data(), end, header.frames);
  if (error != std::errc() || at != end || header.frames < 0) {
    reader.fail(fmt::format("expected a whole number of frames, found '{}'", printable(frames.value)));
  }
  if (header.frames == 0) reader.fail("Frames: 0; a recording needs at least one frame, export it again");

  const Entry time = read_entry(reader, "Frame Time: SECONDS");
  if (!is_keyword(time.key, "FrameTime")) {
    reader.fail(fmt::format("expected 'Frame Time: SECONDS', found '{}'", printable(time.key + " " + time.value)));
  }
  const std::optional<SnappedRate> rate = snap_frame_time(time.value);
  if (!rate) {
    reader.fail(fmt::format("'{}' is no frame time; write the seconds of a frame, such as 0.008333 for 120 a second",
                            printable(time.value)));
  }
  header.frame_time = time.value;
  header.rate = *rate;
  if (rate->snapped) {
    notices.push_back(
        reader.notice(fmt::format("frame time {} taken as {} frames a second", time.value, to_string(rate->rate))));
  }
  return header;
}

/// The root's channels as its columns are to be read: with rotation_first the declared rotations, then the positions.
std::vector<Channel> root_columns(const std::vector<Channel>& declared, RootColumns order, const TextReader& reader) {
  if (order == RootColumns::declared) return declared;
  if (!has_positions_then_rotations(declared)) {
    reader.fail(
        "the root's columns can be read rotation first only where CHANNELS names three positions, then three "
        "rotations; leave --root-order away");
  }
  std::vector<Channel> columns(declared.begin() + 3, declared.end());
  columns.insert(columns.end(), declared.begin(), declared.begin() + 3);
  return columns;
}

/// Watches for an exporter's fault: CHANNELS says positions, then rotations, but the columns hold a rotation and then
/// the root's OFFSET.
class PermutedRoot {
 public:
  PermutedRoot(const std::vector<Channel>& declared, const Eigen::Vector3f& offset)
      : declared_(declared), offset_(offset.cast<double>()) {
    suspect_ = has_positions_then_rotations(declared) && !offset.isZero(0);
  }

  /// One number of the root in one frame.
  void see(std::size_t column, double value) noexcept {
    if (!suspect_) return;
    const double offset = offset_[axis_of(declared_[column % 3])];
    const bool equal = std::abs(value - offset) <= 1e-5 * std::max(1.0, std::abs(offset));
    if (column < 3) positions_move_ = positions_move_ || !equal;
    if (column >= 3 && !equal) suspect_ = false;
  }
  bool found() const noexcept { return suspect_ && positions_move_; }

 private:
  const std::vector<Channel>& declared_;
  Eigen::Vector3d offset_;
  bool suspect_ = false;
  bool positions_move_ = false;
};

/// Reads the numbers of all frames into a motion that is still in the file's units and axes.
class FrameReader {
 public:
  FrameReader(TextReader& reader, const Hierarchy& hierarchy, const MotionHeader& header, const ReadOptions& options)
      : reader_(reader),
        hierarchy_(hierarchy),
        frames_(header.frames),
        options_(options),
        root_columns_(root_columns(hierarchy.channels[0], options.root_columns, reader)),
        permuted_(hierarchy.channels[0], hierarchy.joints[0].offset) {}

  /// Each number takes two bytes at least, so a wrong count of frames never reserves more than the file can fill.
  std::int64_t frames_to_reserve() const {
    const std::size_t left = reader_.total_bytes() - std::min(reader_.total_bytes(), reader_.bytes_read());
    std::size_t most = left / (2 * hierarchy_.channel_count) + 1;
    if (is_sparse()) most = std::min(most, kFreePoses / hierarchy_.joints.size() + 1);
    return std::min(frames_, static_cast<std::int64_t>(most));
  }

  void read(Motion& motion) {
    for (std::int64_t frame = 0; frame < frames_; ++frame) {
      check_size(frame);
      if (reader_.peek().empty()) fail_short(frame, 0);
      const std::size_t line = reader_.line();
      if (frame > 0 && line == last_line_) note_odd_line(line);
      read_pose(motion.append(), frame);
      if (reader_.line() != line) note_odd_line(line);
      last_line_ = reader_.line();
      report();
    }
    if (!reader_.peek().empty()) fail_long();
  }

  bool root_is_permuted() const noexcept { return permuted_.found(); }
  /// The first line that does not hold exactly one frame; 0 where there is none.
  std::size_t odd_line() const noexcept { return odd_line_; }

 private:
  void read_pose(MutablePoseView pose, std::int64_t frame) {
    std::size_t translation = 0;
    std::size_t read = 0;
    for (std::size_t joint = 0; joint < hierarchy_.joints.size(); ++joint) {
      Eigen::Vector3f position = hierarchy_.joints[joint].offset;
      Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
      const std::vector<Channel>& channels = joint == 0 ? root_columns_ : hierarchy_.channels[joint];
      for (std::size_t column = 0; column < channels.size(); ++column, ++read) {
        if (reader_.peek().empty()) fail_short(frame, read);
        const double value = checked_number(reader_, "a number of a frame");
        const int axis = axis_of(channels[column]);
        if (joint == 0) permuted_.see(column, value);
        if (!is_rotation(channels[column])) {
          position[axis] = static_cast<float>(value);
        } else if (value != 0) {
          turn(rotation, axis, value * (std::numbers::pi / 180));
        }
      }
      pose.rotations[joint] = rotation.normalized().cast<float>();
      if (hierarchy_.joints[joint].translated) pose.translations[translation++] = position;
    }
  }

  /// So many joints without channels that a few numbers would become gigabytes of joints at rest.
  bool is_sparse() const noexcept { return hierarchy_.joints.size() > 16 * hierarchy_.channel_count; }

  void check_size(std::int64_t frame) const {
    if (is_sparse() && static_cast<std::size_t>(frame) * hierarchy_.joints.size() > kFreePoses) {
      reader_.fail(fmt::format("{} joints have only {} channels; leave out the joints that do not move",
                               hierarchy_.joints.size(), hierarchy_.channel_count));
    }
  }

  void note_odd_line(std::size_t line) noexcept {
    if (odd_line_ == 0) odd_line_ = line;
  }
  std::string odd_line_hint() const {
    if (odd_line_ == 0) return {};
    return fmt::format(" (line {} is the first that does not hold the {} numbers of one frame)", odd_line_,
                       hierarchy_.channel_count);
  }

  [[noreturn]] void fail_short(std::int64_t whole, std::size_t numbers) {
    const std::string part =
        numbers == 0 ? "" : fmt::format(" and {} of {} numbers", numbers, hierarchy_.channel_count);
    reader_.fail(fmt::format(
        "the file ends after {} whole frames{}, but Frames: says {}{}; write 'Frames: {}' or restore the rest of it",
        whole, part, frames_, odd_line_hint(), whole));
  }

  [[noreturn]] void fail_long() {
    const std::string word(reader_.word());
    const std::size_t line = reader_.line();
    std::uint64_t numbers = 0;
    for (std::string_view rest = word; !rest.empty(); rest = reader_.word()) ++numbers;
    const std::uint64_t more = numbers / hierarchy_.channel_count;
    const std::uint64_t part = numbers % hierarchy_.channel_count;
    const std::uint64_t whole = static_cast<std::uint64_t>(frames_) + more;
    const std::string rest = part == 0 ? "" : fmt::format(" and {} numbers more", part);
    throw Error(ErrorCode::bad_input,
                fmt::format("{}:{}: numbers are left over after frame {}: the data has {} frames{}, but Frames: says "
                            "{}{}; write 'Frames: {}' or remove what is too much",
                            reader_.name(), line, frames_, whole, rest, frames_, odd_line_hint(), whole));
  }

  void report() {
    if (!options_.progress || reader_.bytes_read() < reported_ + kBytesPerReport) return;
    reported_ = reader_.bytes_read();
    if (reader_.total_bytes() == 0) return;
    options_.progress(std::min(1.0, static_cast<double>(reported_) / static_cast<double>(reader_.total_bytes())));
  }

  TextReader& reader_;
  const Hierarchy& hierarchy_;
  std::int64_t frames_;
  const ReadOptions& options_;
  std::vector<Channel> root_columns_;
  PermutedRoot permuted_;
  std::size_t last_line_ = 0;
  std::size_t odd_line_ = 0;
  std::size_t reported_ = 0;
};

void check(const ReadOptions& options) {
  for (const std::optional<double>& unit : {options.unit, options.root_unit}) {
    if (unit && !(*unit >= 1e-6 && *unit <= 1e6)) {
      throw Error(ErrorCode::bad_input, fmt::format("a unit of {} metres; give one between 1e-6 and 1e6", *unit));
    }
  }
}

/// Fills in what the file does not say: as told, else as guessed, and then with a notice.
void settle_space(const Motion& motion, const ReadOptions& options, Layout& layout, const std::string& name,
                  std::vector<Notice>& notices) {
  layout.mirrored = options.mirror;
  layout.root_columns = options.root_columns;
  if (options.up && options.unit) {
    layout.up = *options.up;
    layout.unit = *options.unit;
  } else {
    const Guess guess = guess_space(motion, options.up);
    layout.up = guess.up;
    layout.unit = options.unit.value_or(guess.unit);
    const std::string up = fmt::format("up axis {}{}", layout.up == UpAxis::z ? "z" : "y",
                                       options.up || guess.up_certain ? "" : " (the body gives no clear answer)");
    const std::string unit =
        !guess.unit_plausible
            ? fmt::format("unit cm, which makes the body {:.3g} m tall and may well be wrong,", guess.stature)
            : fmt::format("unit {} (stature {:.2f} m{})", unit_name(layout.unit), guess.stature,
                          guess.unit_certain ? "" : ", which is unusual");
    std::string text;
    if (!options.up && !options.unit) text = fmt::format("{} and {} guessed; --up and --unit override", up, unit);
    if (!options.up && options.unit) text = fmt::format("{} guessed; --up overrides", up);
    if (options.up && !options.unit) text = fmt::format("{} guessed; --unit overrides", unit);
    notices.push_back({name, text});
    if (guess.upside_down && !options.up) {
      notices.push_back({name, "the head is below the feet; look at the motion and check --up"});
    }
  }
  layout.root_unit = options.root_unit.value_or(layout.unit);
}

/// Takes skeleton and poses from the file's units and axes to ours, in place.
void to_our_space(Motion& motion, Skeleton& skeleton, Hierarchy hierarchy, const Layout& layout) {
  const Space space{.up = layout.up, .mirrored = layout.mirrored};
  const auto converted = [&](const Eigen::Vector3f& v, double unit) {
    const Eigen::Vector3f turned = space.to_ours(v);
    return Eigen::Vector3f(to_metres(turned.x(), unit), to_metres(turned.y(), unit), to_metres(turned.z(), unit));
  };
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const MutablePoseView pose = motion.pose(frame);
    for (Eigen::Quaternionf& rotation : pose.rotations) rotation = space.to_ours(rotation);
    const bool root_moves = hierarchy.joints[0].translated;
    for (std::size_t i = 0; i < pose.translations.size(); ++i) {
      pose.translations[i] = converted(pose.translations[i], i == 0 && root_moves ? layout.root_unit : layout.unit);
    }
  }
  for (std::size_t i = 0; i < hierarchy.joints.size(); ++i) {
    hierarchy.joints[i].offset = converted(hierarchy.joints[i].offset, i == 0 ? layout.root_unit : layout.unit);
  }
  for (Tip& tip : hierarchy.tips) tip.offset = converted(tip.offset, layout.unit);
  skeleton = Skeleton(std::move(hierarchy.joints), std::move(hierarchy.tips));
}

File read(TextReader& reader, const ReadOptions& options) {
  check(options);
  File file;
  Hierarchy hierarchy = read_hierarchy(reader, file.notices);
  if (hierarchy.channel_count == 0) reader.fail("no joint has channels, so the file holds no motion; export it again");
  const MotionHeader header = read_header(reader, file.notices);

  // The unit and the up axis are known only when all frames are read, so the skeleton that the motion shares is
  // exchanged then, before anybody else has seen it.
  const auto skeleton = std::make_shared<Skeleton>(hierarchy.joints, hierarchy.tips);
  file.motion = Motion(skeleton, header.rate.rate);
  FrameReader frames(reader, hierarchy, header, options);
  file.motion.reserve(frames.frames_to_reserve());
  frames.read(file.motion);

  if (frames.odd_line() != 0) {
    file.notices.push_back({fmt::format("{}:{}", reader.name(), frames.odd_line()),
                            "lines and frames do not fall together, though the count of numbers is right"});
  }
  if (frames.root_is_permuted() && options.root_columns == RootColumns::declared) {
    file.notices.push_back({reader.name(),
                            "the root's columns look permuted: where CHANNELS says rotation they hold the root's "
                            "OFFSET in every frame; --root-order rotation_first --root-unit m would mend it"});
  }
  file.layout.frame_time = header.frame_time;
  settle_space(file.motion, options, file.layout, reader.name(), file.notices);
  file.layout.channels = std::move(hierarchy.channels);
  to_our_space(file.motion, *skeleton, std::move(hierarchy), file.layout);
  keep_hemisphere(file.motion);
  if (options.progress) options.progress(1.0);
  return file;
}

}  // namespace

File read(const std::filesystem::path& path, const ReadOptions& options) {
  TextReader reader(path);
  return read(reader, options);
}

File read_text(std::string name, std::string_view text, const ReadOptions& options) {
  TextReader reader(std::move(name), text);
  return read(reader, options);
}

}  // namespace signweave::bvh
