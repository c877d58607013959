#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/semantic_db/segments.h"

namespace signweave {

/// What queries over some segments can name: for completion and for lists.
struct Vocabulary {
  struct Gloss {
    std::string gloss;  ///< match form
    std::size_t tokens = 0;
  };
  std::vector<Gloss> glosses;  ///< each below sorted, once
  std::vector<std::string> tiers;
  std::vector<std::string> recordings;
  std::vector<std::string> signers;  ///< as verbatim as they were given; without the empty one
};

/// The time it takes grows with glosses and tiers, not with rows; but for recordings that were changed since their
/// tables were merged, whose rows are counted.
Vocabulary vocabulary(const Segments& segments);

struct LabelCount {
  std::string label;  ///< match form
  std::size_t annotations = 0;
};

/// The labels of a tier's annotations, over all recordings, without the empty one; sorted, once. None for a tier that
/// there is not. The time it takes grows with the rows of the tier.
std::vector<LabelCount> labels_of(const Segments& segments, std::string_view tier);

/// The words of the query language (docs/query.md), by what they are.
struct LanguageWords {
  std::vector<std::string> fields;
  std::vector<std::string> links;      ///< between the segments of a sequence or relation
  std::vector<std::string> phases;     ///< values of `phase`
  std::vector<std::string> hands;      ///< values of `hand`
  std::vector<std::string> functions;  ///< what stands before a parenthesis
  std::vector<std::string> points;     ///< points of the signer, which functions are asked of
};
LanguageWords language_words();

}  // namespace signweave
