#include "signweave/formats/asf/amc_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace signweave::asf {
namespace {

constexpr std::size_t kAmcBytesPerReport = std::size_t{1} << 20;
/// Bones times frames allowed for a file with hardly any degrees of freedom: 64 MiB of poses.
constexpr std::size_t kMostSparsePoses = std::size_t{1} << 22;
constexpr std::size_t kMostNamed = 3;  ///< number of missing bones that a message names
constexpr double kLimitSlack = 1e-6;   ///< absolute, or relative for a limit beyond 1: the rounding of printed numbers

std::string dofs_shown(const std::vector<Dof>& dofs) {
  std::string text;
  for (const Dof dof : dofs) text += fmt::format("{}{}", text.empty() ? "" : " ", name_of(dof));
  return text;
}

}  // namespace

AmcReader::AmcReader(TextReader& reader, const Figure& figure, std::function<void(double)> progress,
                     std::vector<Notice>& notices)
    : lines_(reader),
      figure_(figure),
      progress_(std::move(progress)),
      notices_(notices),
      seen_at_(figure.bones.size(), 0),
      degrees_(figure.degrees) {
  std::size_t columns = 0;
  for (std::size_t i = 0; i < figure.bones.size(); ++i) {
    bones_.emplace(figure.bones[i].name, i);
    columns_.push_back(columns);
    columns += figure.bones[i].dofs.size();
    if (!figure.bones[i].dofs.empty()) ++moving_;
  }
  numbers_.resize(columns);
  read_header();
}

void AmcReader::read_header() {
  if (!lines_.next()) lines_.fail("the file is empty, expected the frames of a recording; export it again");
  std::optional<Notice> unknown;
  while (lines_.is_keyword()) {
    const std::string_view word = lines_.first();
    const bool degrees = same_word(word, ":degrees");
    if (degrees || same_word(word, ":radians")) {
      degrees_ = degrees;
    } else if (!same_word(word, ":fully-specified") && !unknown) {
      unknown = lines_.reader().notice(fmt::format("{} is unknown and was ignored", in_quotes(word)));
    }
    if (!lines_.next()) lines_.fail("the file ends before its first frame; export it again");
  }
  if (unknown) notices_.push_back(*unknown);
  if (lines_.words().size() != 1 || !whole_number(lines_.first())) {
    const bool bone = bones_.contains(lines_.first()) || same_word(lines_.first(), "root");
    lines_.fail(fmt::format("expected the number of the first frame, found {}; {}", in_quotes(lines_.first()),
                            bone ? "write it on a line of its own before its bones" : "this is not an Acclaim motion"));
  }
  lines_.back();
  header_bytes_ = lines_.reader().bytes_read();
}

std::int64_t AmcReader::frames_expected() const noexcept {
  const std::size_t total = lines_.reader().total_bytes();
  const std::size_t read = std::min(total, lines_.reader().bytes_read());
  const std::size_t frame = std::max(read - std::min(read, header_bytes_), 2 * numbers_.size());
  std::size_t most = (total - read) / frame;
  most += most / 16 + 1;
  if (is_sparse()) most = std::min(most, kMostSparsePoses / figure_.bones.size() + 1);
  return static_cast<std::int64_t>(most);
}

std::span<const double> AmcReader::next() {
  if (!lines_.next()) return {};
  check_size();
  read_number();
  while (lines_.next()) {
    if (lines_.words().size() == 1 && whole_number(lines_.first())) {
      lines_.back();
      break;
    }
    read_bone();
  }
  check_complete();
  ++frames_;
  report_progress();
  return numbers_;
}

void AmcReader::read_number() {
  const std::int64_t before = std::exchange(number_, whole_number(lines_.first()).value_or(0));
  frame_line_ = lines_.line();
  seen_ = 0;
  guess_ = 0;
  if (frames_ == 0) {
    if (number_ > 1) {
      notices_.push_back(
          lines_.reader().notice(fmt::format("the first frame has the number {}; it becomes frame 0", number_)));
    }
    return;
  }
  if (number_ == before + 1) return;
  if (number_ == before) lines_.fail(fmt::format("frame {} occurs twice; remove one", number_));
  if (number_ < before) {
    lines_.fail(fmt::format("frame {} comes after frame {}; put the frames in order", number_, before));
  }
  const std::string missing = number_ == before + 2 ? fmt::format("frame {} is", before + 1)
                                                    : fmt::format("frames {} to {} are", before + 1, number_ - 1);
  lines_.fail(fmt::format("{} missing; restore the rest, or split the file here", missing));
}

std::size_t AmcReader::bone_of(std::string_view name) {
  const std::vector<Bone>& bones = figure_.bones;
  // Each frame lists the bones in one order, which is usually that of the skeleton.
  for (; guess_ < bones.size() && bones[guess_].dofs.empty(); ++guess_) {
  }
  if (guess_ < bones.size() && bones[guess_].name == name) return guess_;
  if (const auto found = bones_.find(name); found != bones_.end()) return found->second;
  if (same_word(name, "root")) return 0;
  if (lines_.is_keyword())
    lines_.fail(fmt::format("{} is after the first frame; move it to before that frame", in_quotes(name)));
  if (name.front() == '-' || (name.front() >= '0' && name.front() <= '9')) {
    lines_.fail(
        fmt::format("{} is neither a bone nor the number of a frame, which is a whole number on a line of its own",
                    in_quotes(name)));
  }
  std::vector<std::string> known;
  for (const Bone& bone : bones) known.push_back(bone.name);
  const std::string near = did_you_mean_bone(name, known);
  lines_.fail(fmt::format("frame {} has the bone {}, which the skeleton does not have{}", number_, in_quotes(name),
                          near.empty() ? "; name another skeleton" : near),
              near.empty() ? Remedies{{"skeleton", ""}} : Remedies{});
}

void AmcReader::read_bone() {
  const std::size_t at = bone_of(lines_.first());
  const Bone& bone = figure_.bones[at];
  if (!bone.dofs.empty()) guess_ = at + 1;
  if (seen_at_[at] > frame_line_) {
    lines_.fail(fmt::format("bone {} occurs twice in frame {}, also in line {}; remove one", in_quotes(bone.name),
                            number_, seen_at_[at]));
  }
  seen_at_[at] = lines_.line();
  const std::span<const std::string_view> words = lines_.words().subspan(1);
  if (words.size() != bone.dofs.size()) {
    const std::size_t count = bone.dofs.size();
    const std::string expected =
        count == 0 ? "no numbers, because it has no dof"
                   : fmt::format("{} number{} ({})", count, count == 1 ? "" : "s", dofs_shown(bone.dofs));
    lines_.fail(fmt::format("bone {} of frame {}: expected {}, found {}", in_quotes(bone.name), number_, expected,
                            words.size()));
  }
  if (words.empty()) return;
  ++seen_;
  for (std::size_t i = 0; i < words.size(); ++i) {
    numbers_[columns_[at] + i] = number_of(words[i], lines_, "a number of a frame");
  }
  if (!bone.limits.empty()) check_limits(at);
}

void AmcReader::check_limits(std::size_t at) {
  const Bone& bone = figure_.bones[at];
  const double half_turn = std::numbers::pi / 180;
  const double unit = figure_.degrees == degrees_ ? 1.0 : figure_.degrees ? half_turn : 1 / half_turn;
  for (std::size_t i = 0; i < bone.limits.size(); ++i) {
    const double value = numbers_[columns_[at] + i];
    const double scale = is_rotation(bone.dofs[i]) ? unit : 1.0;
    const double low = bone.limits[i].low * scale;
    const double high = bone.limits[i].high * scale;
    const bool inside = value >= low - kLimitSlack * std::max(1.0, std::abs(low)) &&
                        value <= high + kLimitSlack * std::max(1.0, std::abs(high));
    if (inside) continue;
    if (outside_++ == 0) {
      first_outside_ =
          lines_.reader().notice(fmt::format("{} of {} is {:g}, its limits are {:g} and {:g}", name_of(bone.dofs[i]),
                                             in_quotes(bone.name), value, low, high));
    }
  }
}

void AmcReader::check_complete() const {
  if (seen_ == moving_) return;
  std::string names;
  const std::size_t missing = moving_ - seen_;
  std::size_t named = 0;
  for (std::size_t i = 0; i < figure_.bones.size() && named < kMostNamed; ++i) {
    if (figure_.bones[i].dofs.empty() || seen_at_[i] > frame_line_) continue;
    names += fmt::format("{}{}", named++ == 0 ? "" : ", ", in_quotes(figure_.bones[i].name));
  }
  if (missing > named) names += fmt::format(" and {} more", missing - named);
  lines_.fail_at(frame_line_,
                 fmt::format("frame {} lacks the bone{} {}; restore {}, or name another skeleton", number_,
                             missing == 1 ? "" : "s", names, missing == 1 ? "it" : "them"),
                 {{"skeleton", ""}});
}

/// So many bones without degrees of freedom that a few numbers would expand to gigabytes of joints at rest.
bool AmcReader::is_sparse() const noexcept {
  return figure_.bones.size() > 16 * numbers_.size();
}

void AmcReader::check_size() const {
  if (is_sparse() && static_cast<std::size_t>(frames_) * figure_.bones.size() > kMostSparsePoses) {
    lines_.fail(fmt::format("{} bones have only {} dofs; leave out the bones that do not move", figure_.bones.size(),
                            numbers_.size()));
  }
}

void AmcReader::report_progress() {
  const TextReader& reader = lines_.reader();
  if (!progress_ || reader.total_bytes() == 0 || reader.bytes_read() < reported_at_ + kAmcBytesPerReport) return;
  reported_at_ = reader.bytes_read();
  progress_(std::min(1.0, static_cast<double>(reported_at_) / static_cast<double>(reader.total_bytes())));
}

void AmcReader::report() {
  if (outside_ == 0) return;
  first_outside_.text = fmt::format("{} number{} outside of the skeleton's limits and {} kept as {}; the first: {}",
                                    outside_, outside_ == 1 ? " is" : "s are", outside_ == 1 ? "is" : "are",
                                    outside_ == 1 ? "it is" : "they are", first_outside_.text);
  notices_.push_back(first_outside_);
}

}  // namespace signweave::asf
