#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Cuts a document so that every annotation is a record of its own. Only the bounds of elements are parsed: EAF's TIER
/// and ANNOTATION, ANVIL's track and el.
namespace signweave::semantic_db {

/// One annotation: [begin, end) of its element in the text.
struct CutPiece {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string id;  ///< the annotation's id; empty if it has none
};

/// One tier: [begin, end) of its element, and its pieces.
struct CutTier {
  std::string name;
  std::size_t begin = 0;
  std::size_t tag_end = 0;  ///< end of its opening tag
  std::size_t end = 0;
  std::size_t first_piece = 0;
  std::size_t pieces = 0;
};

struct Cut {
  std::vector<CutTier> tiers;    ///< in text order
  std::vector<CutPiece> pieces;  ///< in text order; those of one tier are contiguous
  std::string around;            ///< the opening tags around every tier, "<ANNOTATION_DOCUMENT …>"
  std::string closing;           ///< the matching closing tags
  /// True if a tier or an annotation is identified by its name alone, so that a query about one can be answered from
  /// its own text: names and ids are unique, no element of these kinds occurs elsewhere, and the text is UTF-8.
  bool exact = false;
};

/// Cuts a document that its format's reader has accepted. A document that cannot be cut (another root element, a
/// DOCTYPE with declarations of its own, UTF-16 or UTF-32) has no tiers in the result.
Cut cut_document(std::string_view text);

}  // namespace signweave::semantic_db
