#include "signweave/formats/bvh/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "signweave/core/text.h"
#include "signweave/formats/bvh/euler.h"

namespace signweave::bvh {
namespace {

constexpr std::size_t kBytesPerReport = std::size_t{1} << 20;
/// Joints times frames allowed for a file with hardly any channels: 64 MiB of poses.
constexpr std::size_t kFreePoses = std::size_t{1} << 22;

/// "Frames: 12" as key and value.
struct Entry {
  std::string line;
  std::string key;  ///< without blanks; empty if the line has no colon
  std::string value;
};

Entry read_entry(TextReader& reader, std::string_view expected) {
  Entry entry;
  entry.line = reader.word();
  if (entry.line.empty()) reader.fail(fmt::format("the file ends here, expected '{}'", expected));
  entry.line += ' ';
  entry.line += reader.rest_of_line();
  const std::size_t colon = entry.line.find(':');
  if (colon != std::string::npos) {
    for (const char c : entry.line.substr(0, colon)) {
      if (c != ' ' && c != '\t') entry.key += c;
    }
    entry.value = trimmed(std::string_view(entry.line).substr(colon + 1));
  }
  return entry;
}

}  // namespace

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
    reader.fail(fmt::format("expected 'Frames: N', found '{}'", printable(trimmed(frames.line))));
  }
  const char* const end = frames.value.data() + frames.value.size();
  const auto [at, error] = std::from_chars(frames.value.data(), end, header.frames);
  if (error != std::errc() || at != end || header.frames < 0) {
    reader.fail(fmt::format("expected a whole number of frames, found '{}'", printable(frames.value)));
  }
  if (header.frames == 0) reader.fail("Frames: 0; a recording needs at least one frame, export it again");

  const Entry time = read_entry(reader, "Frame Time: SECONDS");
  if (!is_keyword(time.key, "FrameTime")) {
    reader.fail(fmt::format("expected 'Frame Time: SECONDS', found '{}'", printable(trimmed(time.line))));
  }
  const std::optional<SnappedRate> rate = snap_frame_time(time.value);
  if (!rate) {
    reader.fail(fmt::format("'{}' is not a frame time; write the seconds of a frame, such as 0.008333 for 120 a second",
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

PermutedRoot::PermutedRoot(const std::vector<Channel>& declared, const Eigen::Vector3f& offset)
    : declared_(declared), offset_(offset.cast<double>()) {
  suspect_ = has_positions_then_rotations(declared) && !offset.isZero(0);
}

void PermutedRoot::see(std::span<const double> numbers) noexcept {
  for (std::size_t column = 0; suspect_ && column < 6; ++column) {
    const double offset = offset_[axis_of(declared_[column % 3])];
    const bool equal = std::abs(numbers[column] - offset) <= 1e-5 * std::max(1.0, std::abs(offset));
    if (column < 3) positions_move_ = positions_move_ || !equal;
    if (column >= 3 && !equal) suspect_ = false;
  }
}

FrameReader::FrameReader(TextReader& reader, const Hierarchy& hierarchy, const MotionHeader& header,
                         const ReadOptions& options)
    : reader_(reader),
      hierarchy_(hierarchy),
      options_(options),
      frames_(header.frames),
      numbers_(hierarchy.channel_count),
      permuted_(hierarchy.channels[0], hierarchy.joints[0].offset) {}

std::int64_t FrameReader::frames_to_reserve() const {
  const std::size_t left = reader_.total_bytes() - std::min(reader_.total_bytes(), reader_.bytes_read());
  std::size_t most = left / (2 * hierarchy_.channel_count) + 1;
  if (is_sparse()) most = std::min(most, kFreePoses / hierarchy_.joints.size() + 1);
  return std::min(frames_, static_cast<std::int64_t>(most));
}

std::span<const double> FrameReader::next() {
  if (frame_ == frames_) {
    if (!reader_.peek().empty()) fail_long();
    return {};
  }
  check_size();
  for (std::size_t read = 0; read < numbers_.size();) {
    const TextReader::NumberRun run = reader_.plain_numbers(std::span(numbers_).subspan(read), kLargest);
    if (read == 0 && run.count > 0) begin_frame(run.first_line);
    read += run.count;
    if (read == numbers_.size()) break;
    if (reader_.peek().empty()) fail_short(read);
    if (read == 0) begin_frame(reader_.line());
    numbers_[read++] = checked_number(reader_, "a number of a frame");
  }
  permuted_.see(numbers_);
  last_line_ = reader_.line();
  if (last_line_ != first_line_) note_odd_line(first_line_);
  ++frame_;
  report();
  return numbers_;
}

void FrameReader::begin_frame(std::size_t line) noexcept {
  first_line_ = line;
  if (frame_ > 0 && line == last_line_) note_odd_line(line);
}

/// So many joints without channels that a few numbers would expand to gigabytes of joints at rest.
bool FrameReader::is_sparse() const noexcept {
  return hierarchy_.joints.size() > 16 * hierarchy_.channel_count;
}

void FrameReader::check_size() const {
  if (is_sparse() && static_cast<std::size_t>(frame_) * hierarchy_.joints.size() > kFreePoses) {
    reader_.fail(fmt::format("{} joints have only {} channels; leave out the joints that do not move",
                             hierarchy_.joints.size(), hierarchy_.channel_count));
  }
}

void FrameReader::note_odd_line(std::size_t line) noexcept {
  if (odd_line_ == 0) odd_line_ = line;
}

std::string FrameReader::odd_line_hint() const {
  if (odd_line_ == 0) return {};
  return fmt::format(" (line {} is the first that does not hold the {} numbers of one frame)", odd_line_,
                     hierarchy_.channel_count);
}

void FrameReader::fail_short(std::size_t numbers) {
  const std::string part = numbers == 0 ? "" : fmt::format(" and {} of {} numbers", numbers, hierarchy_.channel_count);
  const std::string repair = frame_ == 0 ? "restore" : fmt::format("write 'Frames: {}' or restore", frame_);
  reader_.fail(fmt::format("the file ends after {} whole frames{}, but Frames: says {}{}; {} the rest of it", frame_,
                           part, frames_, odd_line_hint(), repair));
}

void FrameReader::fail_long() {
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
                          "{}{}; write 'Frames: {}' or remove the excess",
                          reader_.name(), line, frames_, whole, rest, frames_, odd_line_hint(), whole));
}

void FrameReader::report() {
  if (!options_.progress || reader_.bytes_read() < reported_ + kBytesPerReport) return;
  reported_ = reader_.bytes_read();
  if (reader_.total_bytes() == 0) return;
  options_.progress(std::min(1.0, static_cast<double>(reported_) / static_cast<double>(reader_.total_bytes())));
}

}  // namespace signweave::bvh
