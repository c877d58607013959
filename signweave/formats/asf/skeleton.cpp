#include "signweave/formats/asf/skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "signweave/core/text.h"
#include "signweave/formats/asf/lines.h"

namespace signweave::asf {
namespace {

constexpr std::size_t kMostBones = 65'534;  // in addition to the root
constexpr std::array<std::string_view, 7> kDofNames = {"tx", "ty", "tz", "rx", "ry", "rz", "l"};
constexpr double kUnitLengthOff = 0.01;  ///< deviation of a direction's length from 1 that is reported

std::optional<std::array<int, 3>> axis_order_of(std::string_view word) noexcept {
  constexpr std::array<std::string_view, 6> kOrders = {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"};
  for (const std::string_view order : kOrders) {
    if (same_word(word, order)) return std::array{order[0] - 'x', order[1] - 'x', order[2] - 'x'};
  }
  return std::nullopt;
}

/// True if a word can only be a number, including "inf".
bool is_numeric(std::string_view word) noexcept {
  const bool letter = (word.front() >= 'a' && word.front() <= 'z') || (word.front() >= 'A' && word.front() <= 'Z');
  return !letter || same_word(word, "inf") || same_word(word, "infinity") || same_word(word, "nan");
}

/// Entries that may occur once in a bone or in the root.
enum class BoneEntry : unsigned { id, name, direction, length, axis, dof, limits, order, position, orientation };

/// Reads one section after another.
class FigureReader {
 public:
  FigureReader(TextReader& reader, std::vector<Notice>& notices) : reader_(reader), lines_(reader), notices_(notices) {}

  Figure read() {
    if (!lines_.next()) lines_.fail("the file is empty, expected an Acclaim skeleton; export it again");
    if (!lines_.is_keyword()) {
      lines_.fail(fmt::format("expected a keyword such as :units, found {}; this is not an Acclaim skeleton",
                              in_quotes(lines_.first())));
    }
    figure_.bones.push_back({.name = "root"});
    do read_section();
    while (lines_.next());
    const std::size_t end = lines_.line();
    if (!has_root_) lines_.fail("the file ends without :root; export it again");
    if (!has_hierarchy_) lines_.fail("the file ends without :hierarchy; export it again");
    const bool moves =
        std::any_of(figure_.bones.begin(), figure_.bones.end(), [](const Bone& bone) { return !bone.dofs.empty(); });
    if (!moves) lines_.fail("no bone has a dof and the root's order is empty, so nothing can move; export it again");
    report();
    order_bones(figure_.bones, kinships_, reader_.name(), end);
    return std::move(figure_);
  }

 private:
  void read_section() {
    const std::string_view keyword = lines_.first();
    if (!lines_.is_keyword()) {
      lines_.fail(
          fmt::format("{} is in no section; a section begins with a keyword such as :bonedata", in_quotes(keyword)));
    }
    if (same_word(keyword, ":units")) return read_units();
    if (same_word(keyword, ":root")) return read_root();
    if (same_word(keyword, ":bonedata")) return read_bones();
    if (same_word(keyword, ":hierarchy")) return read_hierarchy();
    constexpr std::array kKnown = {":version", ":name", ":documentation"};
    const bool known =
        std::any_of(kKnown.begin(), kKnown.end(), [&](std::string_view word) { return same_word(keyword, word); });
    if (!known) note_unknown(keyword);
    skip_section();
  }

  /// Advances to the next line of this section; false if another section begins or the file ends.
  bool next_in_section() {
    if (!lines_.next()) return false;
    if (lines_.is_keyword()) lines_.back();
    return !lines_.is_keyword();
  }

  void skip_section() {
    while (next_in_section()) {
    }
  }

  void read_units() {
    while (next_in_section()) {
      const std::string_view key = lines_.first();
      if (same_word(key, "length")) {
        figure_.length_unit = lines_.numbers(1, "length")[0];
        if (!(figure_.length_unit >= 1e-6 && figure_.length_unit <= 1e6)) {
          lines_.fail(fmt::format("a length unit of {:g}; lengths are divided by it, so it must be from 1e-6 to 1e6",
                                  figure_.length_unit));
        }
      } else if (same_word(key, "angle")) {
        const std::string_view word = lines_.words().size() == 2 ? lines_.words()[1] : std::string_view();
        const bool degrees = same_word(word, "deg") || same_word(word, "degrees") || same_word(word, "degree");
        const bool radians = same_word(word, "rad") || same_word(word, "radians") || same_word(word, "radian");
        if (!degrees && !radians) lines_.fail("expected 'angle deg' or 'angle rad'");
        figure_.degrees = degrees;
      } else if (!same_word(key, "mass")) {
        note_unknown(key);
      }
    }
  }

  void read_root() {
    if (has_root_) lines_.fail("a second :root; remove one");
    has_root_ = true;
    Bone& root = figure_.bones[0];
    root.line = lines_.line();
    begin_item("the root");
    while (next_in_section()) {
      const std::string_view key = lines_.first();
      if (same_word(key, "order")) {
        once(BoneEntry::order);
        root.dofs = read_dofs("order");
      } else if (same_word(key, "axis")) {
        once(BoneEntry::axis);
        if (lines_.words().size() != 2) lines_.fail("expected 'axis XYZ' or another order of the three");
        root.axis.order = read_axis_order(lines_.words()[1]);
      } else if (same_word(key, "position")) {
        once(BoneEntry::position);
        figure_.position = read_vector("position");
      } else if (same_word(key, "orientation")) {
        once(BoneEntry::orientation);
        root.axis.angles = read_vector("orientation");
      } else {
        note_unknown(key);
      }
    }
    if (!has(BoneEntry::order)) {
      lines_.fail_at(root.line, "the root has no order; add one, such as 'order TX TY TZ RX RY RZ'");
    }
  }

  void read_bones() {
    while (next_in_section()) {
      if (!same_word(lines_.first(), "begin")) {
        lines_.fail(fmt::format("expected 'begin' of a bone, found {}", in_quotes(lines_.first())));
      }
      read_bone();
    }
  }

  void read_bone() {
    if (figure_.bones.size() > kMostBones)
      lines_.fail(fmt::format("more than {} bones; split the skeleton", kMostBones));
    Bone bone{.line = lines_.line()};
    double length = 0;
    begin_item(fmt::format("the bone that begins in line {}", bone.line));
    for (;;) {
      if (!next_in_section()) lines_.fail(fmt::format("{} has no 'end'", item_));
      const std::string_view key = lines_.first();
      if (same_word(key, "end")) break;
      if (same_word(key, "begin")) lines_.fail(fmt::format("'begin' inside {}; write 'end' before it", item_));
      if (same_word(key, "name")) {
        once(BoneEntry::name);
        if (lines_.words().size() != 2) lines_.fail("expected a name of one word");
        bone.name = lines_.words()[1];
        item_ = "bone " + in_quotes(bone.name);
      } else if (same_word(key, "direction")) {
        once(BoneEntry::direction);
        bone.direction = read_vector("direction");
      } else if (same_word(key, "length")) {
        once(BoneEntry::length);
        length = lines_.numbers(1, "length")[0];
      } else if (same_word(key, "axis")) {
        once(BoneEntry::axis);
        bone.axis = read_turn();
      } else if (same_word(key, "dof")) {
        once(BoneEntry::dof);
        bone.dofs = read_dofs("dof");
      } else if (same_word(key, "limits")) {
        once(BoneEntry::limits);
        bone.limits = read_limits();
      } else if (!same_word(key, "id") && !same_word(key, "bodymass") && !same_word(key, "cofmass")) {
        note_unknown(key);
      }
    }
    finish(bone, length);
    figure_.bones.push_back(std::move(bone));
  }

  void finish(Bone& bone, double length) {
    if (!has(BoneEntry::name))
      lines_.fail(fmt::format("{} has no name; a bone needs name, direction and length", item_));
    if (!has(BoneEntry::direction))
      lines_.fail(fmt::format("{} has no direction; a bone needs name, direction and length", item_));
    if (!has(BoneEntry::length))
      lines_.fail(fmt::format("{} has no length; a bone needs name, direction and length", item_));
    if (!bone.dofs.empty() && !has(BoneEntry::axis)) {
      lines_.fail(fmt::format("{} has no axis; add one, 'axis 0 0 0 XYZ' where it turns about the figure's", item_));
    }
    if (same_word(bone.name, "root")) lines_.fail("a bone is called 'root' like the root; give it another name");
    const auto [known, is_new] = lines_of_.emplace(bone.name, bone.line);
    if (!is_new) {
      lines_.fail(fmt::format("a second {}, the first begins in line {}; give it another name", item_, known->second));
    }
    if (!is_utf8(bone.name) && odd_name_.where.empty()) {
      odd_name_ = reader_.notice(fmt::format(
          "the name {} is not UTF-8, it is kept byte for byte; save the file as UTF-8", in_quotes(bone.name)));
    }
    if (has(BoneEntry::limits) && bone.limits.size() != bone.dofs.size()) {
      if (odd_limits_.where.empty()) {
        odd_limits_ = reader_.notice(fmt::format("{} has {} limits for {} dofs; its limits are ignored", item_,
                                                 bone.limits.size(), bone.dofs.size()));
      }
      bone.limits.clear();
    }
    bone.tail = bone.direction * length;
    if (length != 0 && std::abs(bone.direction.norm() - 1) > kUnitLengthOff && odd_direction_.where.empty()) {
      odd_direction_ =
          reader_.notice(fmt::format("the direction of {} has the length {:.3g} instead of 1, so the bone "
                                     "is {:.4g} long and not {:.4g}",
                                     item_, bone.direction.norm(), bone.tail.norm(), length));
    }
  }

  void read_hierarchy() {
    has_hierarchy_ = true;
    bool ended = false;
    if (!next_in_section() || !same_word(lines_.first(), "begin")) lines_.fail("expected 'begin' after :hierarchy");
    while (!ended && next_in_section()) {
      ended = same_word(lines_.first(), "end") && lines_.words().size() == 1;
      if (ended) break;
      kinships_.push_back({.names = {lines_.words().begin(), lines_.words().end()}, .line = lines_.line()});
    }
    if (!ended) lines_.fail(":hierarchy has no 'end'; the rest of it is missing");
  }

  std::vector<Dof> read_dofs(std::string_view what) {
    std::vector<Dof> dofs;
    for (const std::string_view word : lines_.words().subspan(1)) {
      std::size_t i = 0;
      while (i < kDofNames.size() && !same_word(word, kDofNames[i])) ++i;
      const bool root = what == "order";
      if (i == kDofNames.size() || (root && static_cast<Dof>(i) == Dof::l)) {
        lines_.fail(fmt::format("unknown {} {}; expected tx, ty, tz, rx, ry{}", what, in_quotes(word),
                                root ? " or rz" : ", rz or l"));
      }
      const auto dof = static_cast<Dof>(i);
      if (std::find(dofs.begin(), dofs.end(), dof) != dofs.end()) {
        lines_.fail(fmt::format("{} twice in {} of {}; each may occur once", in_quotes(word), what, item_));
      }
      dofs.push_back(dof);
    }
    return dofs;
  }

  std::array<int, 3> read_axis_order(std::string_view word) {
    const std::optional<std::array<int, 3>> order = axis_order_of(word);
    if (!order) lines_.fail(fmt::format("expected XYZ or another order of the three axes, found {}", in_quotes(word)));
    return *order;
  }

  Eigen::Vector3d read_vector(std::string_view what) {
    const std::vector<double> numbers = lines_.numbers(3, what);
    return {numbers[0], numbers[1], numbers[2]};
  }

  Turn read_turn() {
    if (lines_.words().size() != 5) {
      lines_.fail(fmt::format("expected 'axis' with three angles and their order, found {} words after it",
                              lines_.words().size() - 1));
    }
    Turn turn;
    for (std::size_t i = 0; i < 3; ++i) {
      turn.angles[static_cast<int>(i)] = number_of(lines_.words()[i + 1], lines_, "an angle of axis");
    }
    turn.order = read_axis_order(lines_.words()[4]);
    return turn;
  }

  double read_limit(std::string_view word) {
    const bool negative = word.starts_with('-');
    const std::string_view size = negative || word.starts_with('+') ? word.substr(1) : word;
    if (same_word(size, "inf") || same_word(size, "infinity")) {
      return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    }
    return number_of(word, lines_, "a limit");
  }

  /// Reads pairs of numbers on this line and on the following ones that begin with a number, whatever the number of
  /// dofs.
  std::vector<Limit> read_limits() {
    std::vector<double> numbers;
    std::size_t line = lines_.line();
    std::size_t keys = 1;
    do {
      line = lines_.line();
      for (const std::string_view word : lines_.words().subspan(keys)) numbers.push_back(read_limit(word));
      keys = 0;
    } while (next_in_section() && is_numeric(lines_.first()));
    lines_.back();
    if (numbers.size() % 2 != 0) {
      lines_.fail_at(line, fmt::format("the limits of {} are {} numbers, expected pairs", item_, numbers.size()));
    }
    std::vector<Limit> limits;
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
      limits.push_back({std::min(numbers[i], numbers[i + 1]), std::max(numbers[i], numbers[i + 1])});
    }
    return limits;
  }

  void begin_item(std::string name) {
    item_ = std::move(name);
    entries_ = 0;
  }
  bool has(BoneEntry entry) const noexcept { return (entries_ >> static_cast<unsigned>(entry) & 1u) != 0; }
  void once(BoneEntry entry) {
    if (has(entry)) lines_.fail(fmt::format("a second {} in {}; remove one", in_quotes(lines_.first()), item_));
    entries_ |= 1u << static_cast<unsigned>(entry);
  }

  void note_unknown(std::string_view word) {
    if (unknown_.where.empty()) {
      unknown_ = reader_.notice(fmt::format("{} is not part of a skeleton and was ignored", in_quotes(word)));
    }
  }

  void report() {
    for (Notice* notice : {&unknown_, &odd_name_, &odd_limits_, &odd_direction_}) {
      if (!notice->where.empty()) notices_.push_back(std::move(*notice));
    }
    if (!figure_.bones[0].axis.angles.isZero(0) || !figure_.position.isZero(0)) {
      notices_.push_back({fmt::format("{}:{}", reader_.name(), figure_.bones[0].line),
                          "the root is pre-set: its position is added to that of each frame, and its orientation turns "
                          "the figure before each frame does"});
    }
  }

  TextReader& reader_;
  Lines lines_;
  std::vector<Notice>& notices_;
  Figure figure_;
  std::vector<Kinship> kinships_;
  std::unordered_map<std::string, std::size_t> lines_of_;  ///< of the bones, by name
  bool has_root_ = false;
  bool has_hierarchy_ = false;
  std::string item_;                                        ///< the item being read, for messages
  unsigned entries_ = 0;                                    ///< its entries so far, one bit each
  Notice unknown_, odd_name_, odd_limits_, odd_direction_;  ///< the first of each kind
};

}  // namespace

std::string_view name_of(Dof dof) noexcept {
  return kDofNames[static_cast<std::size_t>(dof)];
}

Figure read_figure(TextReader& reader, std::vector<Notice>& notices) {
  return FigureReader(reader, notices).read();
}

}  // namespace signweave::asf
