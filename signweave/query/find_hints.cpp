#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/query/find.h"
#include "signweave/query/regex.h"

namespace signweave {
namespace {

// A query may have thousands of conditions; more than a few hints are not useful.
constexpr std::size_t kMostHints = 8;
constexpr int kMostConditions = 64;

class Hinter {
 public:
  explicit Hinter(const Segments& segments) : segments_(segments) {}

  void check(const Expression& expression) {
    if (expression.kind == Expression::Kind::condition) check(expression.condition);
    for (const Expression& operand : expression.operands) check(operand);
    for (const PhaseQuery& sequence : expression.sequence) check(sequence);
  }
  void check(const PhaseQuery& query) {
    for_parts(query, [&](const Term& term) { check(term.expression); });
  }

  std::vector<Notice> take() { return std::move(notices_); }

 private:
  void check(const Condition& condition) {
    if (notices_.size() >= kMostHints || ++looked_at_ > kMostConditions) return;
    if (std::holds_alternative<QueryVariable>(condition.value)) return;
    if (condition.field == Field::gloss) {
      if (glosses_.empty()) glosses_ = segments_.glosses();
      look_for(condition, glosses_, "no sign has the gloss");
    } else if (condition.field == Field::recording) {
      look_for(condition, segments_.recordings(), "no recording is called");
    } else if (condition.field == Field::tier) {
      const std::vector<std::string> tiers = segments_.tiers();
      if (contains(condition.tier, tiers)) return;
      add(fmt::format("no recording has a tier \"{}\"{}", printable(condition.tier),
                      did_you_mean(condition.tier, tiers)));
    }
  }

  void look_for(const Condition& condition, std::span<const std::string> known, std::string_view none) {
    if (const Regex* regex = std::get_if<Regex>(&condition.value)) {
      const std::unique_ptr<RE2> compiled = compile(*regex);
      const auto fits = [&](const std::string& name) { return RE2::FullMatch(match_form(name), *compiled); };
      if (std::any_of(known.begin(), known.end(), fits)) return;
      return add(fmt::format("{} /{}/: it must match the whole name", none, printable(regex->pattern)));
    }
    const std::string& name = std::get<std::string>(condition.value);
    if (!contains(name, known)) add(fmt::format("{} \"{}\"{}", none, printable(name), did_you_mean(name, known)));
  }

  static bool contains(const std::string& name, std::span<const std::string> known) {
    const std::string wanted = match_form(name);
    return std::any_of(known.begin(), known.end(), [&](const std::string& one) { return match_form(one) == wanted; });
  }

  void add(const std::string& text) {
    const Notice notice{"query", text};
    if (std::find(notices_.begin(), notices_.end(), notice) == notices_.end()) notices_.push_back(notice);
  }

  const Segments& segments_;
  std::vector<std::string> glosses_;
  int looked_at_ = 0;
  std::vector<Notice> notices_;
};

}  // namespace

std::vector<Notice> hints(const PhaseQuery& query, const Segments& segments) {
  Hinter hinter(segments);
  hinter.check(query);
  return hinter.take();
}

}  // namespace signweave
