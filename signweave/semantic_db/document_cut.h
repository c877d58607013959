#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Where a document is cut so that every annotation is a record of its own. Nothing is read but where elements begin
/// and end: EAF's TIER and ANNOTATION, ANVIL's track and el.
namespace signweave::semantic_db {

/// One annotation: [begin, end) of its element in the text.
struct CutPiece {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string id;  ///< the annotation's; empty where it has none
};

/// One tier: [begin, end) of its element, and its pieces.
struct CutTier {
  std::string name;
  std::size_t begin = 0;
  std::size_t tag_end = 0;  ///< behind its opening tag
  std::size_t end = 0;
  std::size_t first_piece = 0;
  std::size_t pieces = 0;
};

struct Cut {
  std::vector<CutTier> tiers;    ///< in the order of the text
  std::vector<CutPiece> pieces;  ///< likewise; those of one tier lie together
  std::string around;            ///< the opening tags that every tier stands in, "<ANNOTATION_DOCUMENT …>"
  std::string closing;           ///< their ends
  /// True where a tier, and an annotation, is found by its name alone, so that a question about one can be answered
  /// from its own text: names and ids are there once, no element of these kinds stands elsewhere, and the text is
  /// UTF-8.
  bool exact = false;
};

/// Cuts a document that its format's reader has accepted. What cannot be cut (another root element, a DOCTYPE with
/// declarations of its own, UTF-16 or UTF-32) has no tiers.
Cut cut_document(std::string_view text);

}  // namespace signweave::semantic_db
