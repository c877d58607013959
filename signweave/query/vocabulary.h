#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/semantic_db/segments.h"

namespace signweave {

/// The names that queries over some segments can use: for completion and for lists.
struct Vocabulary {
  struct Gloss {
    std::string gloss;  ///< match form
    std::size_t tokens = 0;
  };
  std::vector<Gloss> glosses;  ///< this list and those below are sorted, without duplicates
  std::vector<std::string> tiers;
  std::vector<std::string> recordings;
  std::vector<std::string> signers;  ///< verbatim; without the empty one
};

/// Time grows with the number of glosses and tiers, not of rows, except for recordings changed since their tables were
/// merged: their rows are counted.
Vocabulary vocabulary(const Segments& segments);

struct LabelCount {
  std::string label;  ///< match form
  std::size_t annotations = 0;
};

/// The labels of a tier's annotations over all recordings, without the empty one; sorted, without duplicates. Empty if
/// the tier does not exist. Time grows with the rows of the tier.
std::vector<LabelCount> labels_of(const Segments& segments, std::string_view tier);

/// The words of the query language (docs/query.md), grouped by role.
struct LanguageWords {
  std::vector<std::string> fields;
  std::vector<std::string> links;       ///< between the segments of a sequence or relation
  std::vector<std::string> phases;      ///< values of `phase`
  std::vector<std::string> hands;       ///< values of `hand`
  std::vector<std::string> two_handed;  ///< values of `hands`
  std::vector<std::string> functions;   ///< words that precede a parenthesis
  std::vector<std::string> points;      ///< points of the signer, the arguments of functions
};
LanguageWords language_words();

}  // namespace signweave
