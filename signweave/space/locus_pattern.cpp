#include "signweave/space/locus_pattern.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <array>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::array<std::string_view, 3> kUsualPatterns = {
    "(?<gloss>INDEX|IX|PT|POINT)[-_:](?<at>[^-_:]+)",
    "(?<gloss>.+)[-_](?<from>[^-_]+)[-_](?<to>[^-_]+)",
    R"((?<from>[123][a-z]?)(?<gloss>\p{Lu}.*?)(?<to>[123][a-z]?))",
};
constexpr std::array<std::string_view, 4> kGroups = {"gloss", "from", "to", "at"};
constexpr std::size_t kMostGroups = 32;
constexpr std::size_t kLongestGloss = 10'000;  // bytes

[[noreturn]] void refuse_pattern(std::string_view pattern, std::string_view why) {
  throw Error(ErrorCode::bad_input, fmt::format("the pattern '{}' of loci: {}", printable(pattern), why));
}

/// RE2 writes named groups (?P<name>…).
std::string with_python_groups(std::string_view pattern) {
  std::string written;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    written += pattern[i];
    if (pattern[i] == '\\' && i + 1 < pattern.size()) {
      written += pattern[++i];
    } else if (pattern.substr(i).starts_with("(?<")) {
      written += "?P";
      ++i;
    }
  }
  return written;
}

/// The text of each group that took part in a match of the whole gloss, by kGroups; none if it does not match.
std::optional<std::array<std::string, kGroups.size()>> groups_of(const RE2& regex, const std::string& gloss) {
  std::array<re2::StringPiece, kMostGroups + 1> found;
  const int count = regex.NumberOfCapturingGroups() + 1;
  if (!regex.Match(gloss, 0, gloss.size(), RE2::ANCHOR_BOTH, found.data(), count)) return std::nullopt;
  std::array<std::string, kGroups.size()> texts;
  for (const auto& [name, number] : regex.NamedCapturingGroups()) {
    const auto group = std::ranges::find(kGroups, std::string_view(name));
    const re2::StringPiece& text = found[static_cast<std::size_t>(number)];
    texts[static_cast<std::size_t>(group - kGroups.begin())].assign(text.data(), text.size());
  }
  return texts;
}

}  // namespace

LocusPattern locus_pattern(std::string_view pattern) {
  if (pattern.size() > kLongestLocusPattern) {
    refuse_pattern(pattern,
                   fmt::format("it has {} bytes; give one of at most {}", pattern.size(), kLongestLocusPattern));
  }
  RE2::Options options;
  options.set_log_errors(false);
  options.set_max_mem(std::int64_t{1} << 20);
  auto regex = std::make_shared<const RE2>(with_python_groups(match_form(pattern)), options);
  if (!regex->ok()) refuse_pattern(pattern, printable(regex->error()));
  if (regex->NumberOfCapturingGroups() > static_cast<int>(kMostGroups)) {
    refuse_pattern(pattern, fmt::format("more than {} groups; use (?:…) for those without a name", kMostGroups));
  }
  bool loci = false;
  for (const auto& [name, number] : regex->NamedCapturingGroups()) {
    if (std::ranges::find(kGroups, std::string_view(name)) == kGroups.end()) {
      refuse_pattern(pattern, fmt::format("no group '{}'; the groups are gloss, from, to and at", printable(name)));
    }
    loci = loci || name != "gloss";
  }
  if (!loci) refuse_pattern(pattern, "it captures no locus; name a group (?<from>…), (?<to>…) or (?<at>…)");
  return {std::move(regex)};
}

std::optional<GlossLoci> loci_of(std::string_view gloss, std::span<const LocusPattern> patterns,
                                 const LocusWords& words) {
  const std::string form = match_form(gloss);
  if (form.size() > kLongestGloss) return std::nullopt;
  for (const LocusPattern& pattern : patterns) {
    const auto texts = groups_of(*pattern.regex, form);
    if (!texts) continue;
    GlossLoci loci{.gloss = (*texts)[0].empty() ? form : (*texts)[0], .from = {}, .to = {}, .at = {}};
    const std::array<std::optional<LocusRef>*, 3> aims = {&loci.from, &loci.to, &loci.at};
    bool known = true;
    for (std::size_t i = 0; i < aims.size(); ++i) {
      const std::string& word = (*texts)[i + 1];
      if (word.empty()) continue;
      const auto found = words.find(fold_case(word));
      known = known && found != words.end();
      if (known) *aims[i] = found->second;
    }
    if (known && (loci.from || loci.to || loci.at)) return loci;
  }
  return std::nullopt;
}

std::span<const std::string_view> usual_locus_patterns() noexcept {
  return kUsualPatterns;
}

}  // namespace signweave
