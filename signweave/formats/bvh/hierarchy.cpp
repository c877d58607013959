#include "signweave/formats/bvh/hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "signweave/core/text.h"
#include "signweave/formats/bvh/euler.h"

namespace signweave::bvh {
namespace {

constexpr std::size_t kMostJoints = 65'535;
std::optional<Channel> channel_named(std::string_view word) noexcept {
  for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
    if (is_keyword(word, kChannelNames[i])) return static_cast<Channel>(i);
  }
  return std::nullopt;
}

bool is_channel_like(std::string_view word) noexcept {
  return word.size() == 9 && (is_keyword(word.substr(1), "position") || is_keyword(word.substr(1), "rotation"));
}

bool is_structure(std::string_view word) noexcept {
  for (const std::string_view keyword : {"{", "}", "ROOT", "JOINT", "End", "OFFSET", "CHANNELS", "MOTION"}) {
    if (is_keyword(word, keyword)) return true;
  }
  return word.empty();
}

std::string shown(std::string_view word) {
  return word.empty() ? "the end of the file" : fmt::format("'{}'", printable(word));
}

/// Reads one joint after another and keeps the open ones in a list instead of on the call stack: files nest thousands
/// deep.
class HierarchyReader {
 public:
  HierarchyReader(TextReader& reader, std::vector<Notice>& notices) : reader_(reader), notices_(notices) {}

  Hierarchy read() {
    read_start();
    while (!open_.empty()) read_item();
    return std::move(result_);
  }

 private:
  struct Open {
    JointIndex joint;
    std::size_t line;
    bool has_offset = false;
    bool has_channels = false;
  };

  void read_start() {
    const std::string_view first = reader_.word();
    if (first.empty()) reader_.fail("the file is empty, expected HIERARCHY; export it again");
    if (is_keyword(first, "MOTION")) {
      reader_.fail("MOTION comes before HIERARCHY; put the HIERARCHY part first, or export the file again");
    }
    if (!is_keyword(first, "HIERARCHY")) {
      reader_.fail(fmt::format("expected HIERARCHY, found {}; this is not a BVH file", shown(first)));
    }
    const std::string_view root = reader_.word();
    if (!is_keyword(root, "ROOT")) {
      reader_.fail(fmt::format("expected ROOT, found {}; HIERARCHY must begin with the root joint", shown(root)));
    }
    open_joint(kNoJoint, "ROOT");
  }

  void read_item() {
    const std::string_view word = reader_.word();
    if (is_keyword(word, "OFFSET")) return read_offset();
    if (is_keyword(word, "CHANNELS")) return read_channels();
    if (is_keyword(word, "JOINT")) return open_joint(open_.back().joint, "JOINT");
    if (is_keyword(word, "End")) return read_tip();
    if (word == "}") return close_joint();
    if (word.empty()) {
      reader_.fail(fmt::format("the file ends inside {}; a '}}' or the rest of the file is missing", place()));
    }
    if (is_keyword(word, "MOTION")) {
      reader_.fail(fmt::format("MOTION begins inside {}; a '}}' is missing before it", place()));
    }
    if (is_keyword(word, "ROOT")) {
      reader_.fail(fmt::format("ROOT inside {}; write JOINT, or close the braces before it", place()));
    }
    if (is_channel_like(word)) {
      reader_.fail(fmt::format("'{}' is one channel more than CHANNELS of '{}' announces; correct its number",
                               printable(word), name_of(open_.back())));
    }
    reader_.fail(fmt::format("expected OFFSET, CHANNELS, JOINT, End Site or '}}', found {}", shown(word)));
  }

  void open_joint(JointIndex parent, std::string_view keyword) {
    if (result_.joints.size() == kMostJoints) {
      reader_.fail(fmt::format("more than {} joints; split the skeleton", kMostJoints));
    }
    Joint joint;
    joint.parent = parent;
    joint.name = read_name(keyword);
    if (!is_utf8(joint.name) && !names_reported_) {
      names_reported_ = true;
      notices_.push_back(reader_.notice(fmt::format(
          "the name '{}' is not UTF-8, it is kept byte for byte; save the file as UTF-8", printable(joint.name))));
    }
    open_.push_back({.joint = static_cast<JointIndex>(result_.joints.size()), .line = name_line_});
    result_.joints.push_back(std::move(joint));
    result_.channels.emplace_back();
  }

  /// Reads the rest of the line, then an opening brace. The brace may be on the name's line, although a name may
  /// contain one.
  std::string read_name(std::string_view keyword) {
    std::string name(reader_.rest_of_line());
    name_line_ = reader_.line();
    if (reader_.peek() == "{") {
      reader_.word();
    } else if (name.ends_with('{')) {
      name.pop_back();
      name = trimmed(name);
    } else {
      const std::string found = shown(reader_.peek());
      reader_.fail(fmt::format("expected '{{' after {} {}, found {}; put the brace on a line of its own", keyword,
                               printable(name), found));
    }
    return name;
  }

  Eigen::Vector3f read_vector() {
    std::array<double, 3> numbers{};
    for (std::size_t read = reader_.plain_numbers(numbers, kLargest).count; read < numbers.size(); ++read) {
      numbers[read] = checked_number(reader_, "a number of OFFSET");
    }
    return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]).cast<float>();
  }

  void read_offset() {
    Open& open = open_.back();
    if (open.has_offset) reader_.fail(fmt::format("a second OFFSET in {}; remove one", place()));
    open.has_offset = true;
    result_.joints[static_cast<std::size_t>(open.joint)].offset = read_vector();
  }

  void read_channels() {
    Open& open = open_.back();
    if (open.has_channels) reader_.fail(fmt::format("a second CHANNELS in {}; remove one", place()));
    open.has_channels = true;
    const std::string count_word(reader_.word());
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(count_word.data(), count_word.data() + count_word.size(), count);
    if (error != std::errc() || end != count_word.data() + count_word.size() || count > 6) {
      reader_.fail(fmt::format("expected a number of channels from 0 to 6, found {}", shown(count_word)));
    }
    const auto joint = static_cast<std::size_t>(open.joint);
    std::vector<Channel>& channels = result_.channels[joint];
    channels.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view word = reader_.word();
      const std::optional<Channel> channel = channel_named(word);
      if (!channel && is_structure(word)) {
        reader_.fail(fmt::format("CHANNELS of '{}' announces {} but names {}, then comes {}; correct its number",
                                 name_of(open), count, i, shown(word)));
      }
      if (!channel) {
        reader_.fail(
            fmt::format("unknown channel {}; a channel is Xposition, Yposition, Zposition, Xrotation, "
                        "Yrotation or Zrotation",
                        shown(word)));
      }
      if (std::find(channels.begin(), channels.end(), *channel) != channels.end()) {
        reader_.fail(fmt::format("channel {} twice in {}; each channel may occur once", printable(word), place()));
      }
      channels.push_back(*channel);
      if (!is_rotation(*channel)) result_.joints[joint].translated = true;
    }
    result_.channel_count += count;
  }

  void read_tip() {
    read_name("End");  // nearly always "Site"; the word is ignored
    const std::string_view word = reader_.word();
    if (!is_keyword(word, "OFFSET")) {
      reader_.fail(
          fmt::format("expected OFFSET in the End Site of '{}', found {}", name_of(open_.back()), shown(word)));
    }
    const Eigen::Vector3f offset = read_vector();
    result_.tips.push_back({.joint = open_.back().joint, .offset = offset});
    const std::string_view brace = reader_.word();
    if (brace != "}") {
      reader_.fail(fmt::format("expected '}}' after the End Site of '{}', found {}; an End Site holds one OFFSET",
                               name_of(open_.back()), shown(brace)));
    }
  }

  void close_joint() {
    if (!open_.back().has_offset) {
      reader_.fail(
          fmt::format("{} has no OFFSET; add one, 'OFFSET 0 0 0' where it coincides with its parent", place()));
    }
    open_.pop_back();
  }

  std::string name_of(const Open& open) const {
    return printable(result_.joints[static_cast<std::size_t>(open.joint)].name);
  }
  std::string place() const {
    return fmt::format("joint '{}' (which begins in line {})", name_of(open_.back()), open_.back().line);
  }

  TextReader& reader_;
  std::vector<Notice>& notices_;
  Hierarchy result_;
  std::vector<Open> open_;  ///< from the root to the joint being read
  std::size_t name_line_ = 1;
  bool names_reported_ = false;
};

}  // namespace

bool is_keyword(std::string_view word, std::string_view keyword) noexcept {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return word.size() == keyword.size() &&
         std::equal(word.begin(), word.end(), keyword.begin(), [&](char a, char b) { return lower(a) == lower(b); });
}

double checked_number(TextReader& reader, std::string_view what) {
  const double value = reader.number(what);
  if (std::abs(value) > kLargest) {
    reader.fail(fmt::format("{:g} is too large for {}; values beyond {:g} are not accepted as measurements", value,
                            what, kLargest));
  }
  return value;
}

Hierarchy read_hierarchy(TextReader& reader, std::vector<Notice>& notices) {
  return HierarchyReader(reader, notices).read();
}

}  // namespace signweave::bvh
