#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/core/text_reader.h"
#include "signweave/nonmanual/channel.h"
#include "signweave/nonmanual/expressions.h"

namespace signweave {
namespace {

constexpr std::size_t kMostExpressions = 1000;
constexpr std::size_t kMostLines = 100'000;
constexpr std::size_t kLongestName = 100;  // bytes
constexpr double kMostMilliseconds = 60'000;

/// A setting of an expression that is a number.
struct NumberSetting {
  std::string_view name;
  float& (*of)(Curve& curve);
};
constexpr NumberSetting kNumberSettings[] = {
    {"amount", [](Curve& curve) -> float& { return curve.amount; }},
    {"head_pitch", [](Curve& curve) -> float& { return curve.head.turn.pitch; }},
    {"head_yaw", [](Curve& curve) -> float& { return curve.head.turn.yaw; }},
    {"head_roll", [](Curve& curve) -> float& { return curve.head.turn.roll; }},
    {"head_pitch_swing", [](Curve& curve) -> float& { return curve.head.swing.pitch; }},
    {"head_yaw_swing", [](Curve& curve) -> float& { return curve.head.swing.yaw; }},
    {"head_roll_swing", [](Curve& curve) -> float& { return curve.head.swing.roll; }},
    {"head_hertz", [](Curve& curve) -> float& { return curve.head.hertz; }},
};
/// A setting that is a time.
struct TimeSetting {
  std::string_view name;
  Milliseconds& (*of)(NamedExpression& expression);
};
constexpr TimeSetting kTimeSettings[] = {
    {"begin_ms", [](NamedExpression& one) -> Milliseconds& { return one.begin; }},
    {"end_ms", [](NamedExpression& one) -> Milliseconds& { return one.end; }},
    {"onset_ms", [](NamedExpression& one) -> Milliseconds& { return one.curve.onset; }},
    {"offset_ms", [](NamedExpression& one) -> Milliseconds& { return one.curve.offset; }},
    {"head_delay_ms", [](NamedExpression& one) -> Milliseconds& { return one.curve.head.delay; }},
    {"head_onset_ms", [](NamedExpression& one) -> Milliseconds& { return one.curve.head.onset; }},
    {"head_offset_ms", [](NamedExpression& one) -> Milliseconds& { return one.curve.head.offset; }},
};

std::optional<double> plain_number(std::string_view text) {
  double value = 0;
  const auto [at, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || at != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

/// The expressions of a file while it is read.
class ExpressionFile {
 public:
  explicit ExpressionFile(TextReader& reader) : reader_(reader) {}

  Expressions read() {
    while (!reader_.peek().empty()) {
      if (++lines_ > kMostLines) reader_.fail(fmt::format("more than {} lines; split the file", kMostLines));
      const std::string line(reader_.rest_of_line());
      if (line.starts_with('#') || (lines_ == 1 && fold_case(line) == "name,what,value")) continue;
      read_line(line);
    }
    return std::move(all_);
  }

 private:
  void read_line(const std::string& line) {
    if (!is_utf8(line)) reader_.fail("the line is not UTF-8; save the file as UTF-8");
    const std::size_t first = line.find(',');
    const std::size_t second = first == line.npos ? line.npos : line.find(',', first + 1);
    if (second == line.npos || line.find(',', second + 1) != line.npos || line.find('"') != line.npos) {
      reader_.fail(fmt::format("expected NAME,WHAT,VALUE without quotes, such as brows up,browInnerUp,0.8; found '{}'",
                               printable(line)));
    }
    const std::string name = match_form(std::string_view(line).substr(0, first));
    if (name.empty() || name.size() > kLongestName) {
      reader_.fail(fmt::format("the name has {} bytes; give one of 1 to {}", name.size(), kLongestName));
    }
    set(expression_of(name), trimmed(std::string_view(line).substr(first + 1, second - first - 1)),
        trimmed(std::string_view(line).substr(second + 1)));
  }

  NamedExpression& expression_of(const std::string& name) {
    const auto at = std::ranges::find(all_, name, [](const NamedExpression& one) { return one.curve.name; });
    if (at != all_.end()) return *at;
    if (all_.size() == kMostExpressions) {
      reader_.fail(fmt::format("more than {} expressions; remove some", kMostExpressions));
    }
    all_.emplace_back().curve.name = name;
    return all_.back();
  }

  void set(NamedExpression& one, std::string_view what, std::string_view value) {
    if (what == "merge") return set_merge(one, value);
    const std::optional<double> number = plain_number(value);
    if (!number) reader_.fail(fmt::format("expected a number for {}, found '{}'", printable(what), printable(value)));
    if (what == "at_end") {
      if (*number != 0 && *number != 1) reader_.fail(fmt::format("at_end is {}; give 1 or 0", *number));
      one.at_end = *number == 1;
      return;
    }
    if (!set_time(one, what, *number) && !set_number(one, what, *number)) {
      if (!channel_of_track(what)) fail_unknown(what);
      one.curve.weights.push_back({std::string(what), static_cast<float>(*number)});
    }
    check(one.curve, fmt::format("{}:{}", reader_.name(), reader_.line()));
  }

  bool set_time(NamedExpression& one, std::string_view what, double number) {
    for (const TimeSetting& setting : kTimeSettings) {
      if (setting.name != what) continue;
      if (!(number >= -kMostMilliseconds && number <= kMostMilliseconds)) {
        reader_.fail(fmt::format("{} is {}; give milliseconds from {} to {}", what, number, -kMostMilliseconds,
                                 kMostMilliseconds));
      }
      setting.of(one) = Milliseconds(std::llround(number));
      return true;
    }
    return false;
  }

  static bool set_number(NamedExpression& one, std::string_view what, double number) {
    for (const NumberSetting& setting : kNumberSettings) {
      if (setting.name != what) continue;
      setting.of(one.curve) = static_cast<float>(number);
      return true;
    }
    return false;
  }

  void set_merge(NamedExpression& one, std::string_view value) {
    for (const Merge merge : {Merge::usual, Merge::maximum, Merge::sum, Merge::replace}) {
      if (name_of(merge) == value) {
        one.curve.merge = merge;
        return;
      }
    }
    reader_.fail(fmt::format("merge is '{}'; give usual, maximum, sum or replace", printable(value)));
  }

  [[noreturn]] void fail_unknown(std::string_view what) {
    std::vector<std::string> known = {"merge",        "at_end",      "browInnerUp",   "browOuterUpLeft",
                                      "browDownLeft", "eyeWideLeft", "eyeSquintLeft", "eyeBlinkLeft",
                                      "cheekPuff",    "jawOpen",     "mouthSmileLeft"};
    for (const NumberSetting& setting : kNumberSettings) known.emplace_back(setting.name);
    for (const TimeSetting& setting : kTimeSettings) known.emplace_back(setting.name);
    const std::string hint = did_you_mean(what, known);
    reader_.fail(fmt::format("'{}' is neither an ARKit name nor a setting{}", printable(what),
                             hint.empty() ? "; docs/non-manuals.md lists the settings" : hint));
  }

  TextReader& reader_;
  Expressions all_;
  std::size_t lines_ = 0;
};

Expressions with_built_in(Expressions own) {
  Expressions all = built_in_expressions();
  for (NamedExpression& one : own) {
    const auto same =
        std::ranges::find(all, one.curve.name, [](const NamedExpression& other) { return other.curve.name; });
    if (same != all.end()) {
      *same = std::move(one);
    } else {
      all.push_back(std::move(one));
    }
  }
  return all;
}

}  // namespace

Expressions read_expressions(const std::filesystem::path& path) {
  TextReader reader(path);
  return with_built_in(ExpressionFile(reader).read());
}

Expressions read_expressions_text(const std::string& file, std::string_view text) {
  TextReader reader(file, text);
  return with_built_in(ExpressionFile(reader).read());
}

}  // namespace signweave
