#include <array>

#include "demo/space.h"

namespace signweave::demo {
namespace {

/// Cuts tokens into units of several signs between rests.
std::vector<std::vector<Aimed>> in_units(const std::vector<Aimed>& tokens, std::size_t length) {
  std::vector<std::vector<Aimed>> units;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (i % length == 0) units.emplace_back();
    units.back().push_back(tokens[i]);
  }
  return units;
}

/// Every value once, neighbours far apart: `step` has no divisor in common with their number.
template <typename T>
std::vector<T> spread(const std::vector<T>& values, std::size_t step) {
  std::vector<T> result;
  for (std::size_t i = 0; i < values.size(); ++i) result.push_back(values[i * step % values.size()]);
  return result;
}

struct Pair {
  const char* from;
  const char* to;
};
constexpr const char* kArc[] = {"-75/0/1.2", "-50/0/1.2", "-25/0/1.2", "front", "25/0/1.2", "50/0/1.2", "75/0/1.2"};

/// Subjects and objects of a verb: the signer and every locus, others with each other, and three of them again.
std::vector<Pair> pairs() {
  std::vector<Pair> all;
  for (const char* locus : kArc) all.push_back({"self", locus});
  for (const char* locus : kArc) all.push_back({locus, "self"});
  all.insert(all.end(), {{"left", "right"},
                         {"right", "left"},
                         {"-50/0/1.2", "25/0/1.2"},
                         {"50/0/1.2", "-75/0/1.2"},
                         {"-25/0/1.2", "75/0/1.2"},
                         {"front", "-50/0/1.2"},
                         {"self", "50/0/1.2"},
                         {"-50/0/1.2", "self"},
                         {"self", "addressee"}});
  return all;
}

/// Objects of a verb that has no locus of its subject.
std::vector<Pair> objects() {
  std::vector<Pair> all;
  for (int round = 0; round < 3; ++round) {
    for (const char* locus : kArc) all.push_back({"self", locus});
  }
  all.insert(all.end(), {{"self", "left"}, {"self", "right"}, {"self", "addressee"}});
  return all;
}

Aimed token(const AimedSign& sign, const Pair& pair) {
  Aimed aimed{.gloss = sign.gloss, .from = locus_of(pair.from), .to = locus_of(pair.to), .at = {}};
  if (sign.aiming == Aiming::facing) aimed.from.reset();
  return aimed;
}

}  // namespace

SpaceScript espace_index() {
  std::vector<Aimed> tokens;
  const auto add = [&](std::string_view locus) {
    tokens.push_back({.gloss = "INDEX", .from = {}, .to = {}, .at = locus_of(locus)});
  };
  for (int round = 0; round < 3; ++round) {
    for (const char* elevation : {"-20", "0", "20"}) {
      for (const char* azimuth : {"-75", "-50", "-25", "0", "25", "50", "75"}) {
        add(std::string(azimuth) + "/" + elevation + "/2.5");
      }
    }
    for (const char* name : {"left", "front", "addressee"}) add(name);
  }
  return {.name = "espace_index", .units = in_units(spread(tokens, 17), 8)};
}

SpaceScript espace_verbes(int part) {
  std::vector<Aimed> tokens;
  const std::span<const AimedSign> verbs = aimed_signs().subspan(1);
  for (std::size_t i = 0; i < verbs.size(); ++i) {
    if (i % 2 != static_cast<std::size_t>(part - 1)) continue;
    const bool object_only = verbs[i].aiming == Aiming::mouth || verbs[i].aiming == Aiming::facing;
    for (const Pair& pair : object_only ? objects() : pairs()) tokens.push_back(token(verbs[i], pair));
  }
  return {.name = part == 1 ? "espace_verbes_1" : "espace_verbes_2", .units = in_units(spread(tokens, 29), 8)};
}

}  // namespace signweave::demo
