#include "signweave/semantic_db/document_cut.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <pugixml.hpp>
#include <unordered_set>

#include "signweave/core/text.h"

namespace signweave::semantic_db {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

/// A tag: its name, whether it opens, closes or does both, and its position.
struct Tag {
  std::string_view text;  ///< with its brackets
  std::string_view name;
  bool closes = false;  ///< "</x>"
  bool empty = false;   ///< "<x/>"
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The tags of a text in order; comments, CDATA and processing instructions are skipped.
class Tags {
 public:
  explicit Tags(std::string_view text) : text_(text) {}

  /// nullopt at the end, or if the text is not understood: see `understood`.
  std::optional<Tag> next() {
    for (;;) {
      const std::size_t begin = text_.find('<', at_);
      if (begin == text_.npos) return std::nullopt;
      const std::string_view rest = text_.substr(begin);
      if (rest.starts_with("<!--")) {
        if (!pass(begin + 4, "-->")) return std::nullopt;
      } else if (rest.starts_with("<![CDATA[")) {
        if (!pass(begin + 9, "]]>")) return std::nullopt;
      } else if (rest.starts_with("<?")) {
        if (!pass(begin + 2, "?>")) return std::nullopt;
      } else if (rest.starts_with("<!")) {
        const std::size_t end = end_of_tag(begin);
        if (end == text_.npos || text_.substr(begin, end - begin).find('[') != text_.npos) return give_up();
        at_ = end;
      } else {
        return tag(begin);
      }
    }
  }

  bool understood() const noexcept { return understood_; }

 private:
  std::optional<Tag> give_up() {
    understood_ = false;
    at_ = text_.size();
    return std::nullopt;
  }

  bool pass(std::size_t from, std::string_view end) {
    const std::size_t found = text_.find(end, from);
    if (found == text_.npos) return give_up().has_value();
    at_ = found + end.size();
    return true;
  }

  /// The position after the '>' that is outside quotes.
  std::size_t end_of_tag(std::size_t begin) const noexcept {
    for (std::size_t i = begin; i < text_.size(); ++i) {
      if (text_[i] == '>') return i + 1;
      if (text_[i] != '"' && text_[i] != '\'') continue;
      i = text_.find(text_[i], i + 1);
      if (i == text_.npos) break;
    }
    return text_.npos;
  }

  std::optional<Tag> tag(std::size_t begin) {
    const std::size_t end = end_of_tag(begin);
    if (end == text_.npos) return give_up();
    Tag tag{.text = text_.substr(begin, end - begin), .name = {}, .begin = begin, .end = end};
    tag.closes = tag.text.size() > 1 && tag.text[1] == '/';
    tag.empty = !tag.closes && tag.text.size() > 2 && tag.text[tag.text.size() - 2] == '/';
    const std::size_t name = tag.closes ? 2 : 1;
    tag.name = tag.text.substr(name, tag.text.find_first_of(" \t\r\n/>", name) - name);
    at_ = end;
    return tag;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool understood_ = true;
};

/// An attribute's value as the readers see it; empty if it is missing.
std::string attribute(const Tag& tag, std::string_view wanted) {
  const std::string_view text = tag.text;
  for (std::size_t at = text.find_first_of(kBlank); at != text.npos;) {
    at = text.find_first_not_of(kBlank, at);
    if (at == text.npos) break;
    const std::size_t sign = text.find('=', at);
    if (sign == text.npos) break;
    const std::string_view name = trimmed(text.substr(at, sign - at));
    const std::size_t open = text.find_first_of("\"'", sign);
    if (open == text.npos) break;
    const std::size_t close = text.find(text[open], open + 1);
    if (close == text.npos) break;
    if (name == wanted) {
      const std::string_view raw = text.substr(open + 1, close - open - 1);
      if (raw.find_first_of("&\t\r\n") == raw.npos) return std::string(raw);
      const std::string element = fmt::format("<x a={}/>", text.substr(open, close + 1 - open));
      pugi::xml_document document;
      document.load_buffer(element.data(), element.size(), pugi::parse_full, pugi::encoding_utf8);
      return document.document_element().attribute("a").value();
    }
    at = close + 1;
  }
  return {};
}

/// The relevant elements of a format.
struct Names {
  std::string_view root;
  std::string_view body;  ///< element around the tiers; empty: the root itself
  std::string_view tier;
  std::string_view tier_name;  ///< attribute with the tier's name
  std::string_view group;      ///< element that may surround pieces; empty: none
  std::string_view piece;
  std::array<std::string_view, 2> annotations;  ///< elements in a piece that have the id; empty: the id is its number
};

constexpr Names kEaf{.root = "ANNOTATION_DOCUMENT",
                     .body = {},
                     .tier = "TIER",
                     .tier_name = "TIER_ID",
                     .group = {},
                     .piece = "ANNOTATION",
                     .annotations = {"ALIGNABLE_ANNOTATION", "REF_ANNOTATION"}};
constexpr Names kAnvil{.root = "annotation",
                       .body = "body",
                       .tier = "track",
                       .tier_name = "name",
                       .group = "el-group",
                       .piece = "el",
                       .annotations = {}};

class Cutter {
 public:
  Cutter(std::string_view text, const Names& names, const Tag& root) : text_(text), names_(names) {
    cut_.around = root.text;
    cut_.closing = fmt::format("</{}>", root.name);
    cut_.exact = true;
  }

  void see(const Tag& tag) {
    if (!tag.closes) open(tag);
    if (tag.closes || tag.empty) close(tag);
  }

  /// False if the readers would not accept the text.
  bool whole() const noexcept { return depth_ == 0 && !in_tier_; }

  Cut take() {
    const bool one_body = names_.body.empty() || bodies_ <= 1;
    cut_.exact = cut_.exact && one_body && is_utf8(text_) && declares_utf8();
    std::unordered_set<std::string_view> seen;
    for (const CutTier& tier : cut_.tiers) cut_.exact = cut_.exact && seen.insert(tier.name).second;
    seen.clear();
    for (const CutPiece& piece : cut_.pieces) {
      cut_.exact = cut_.exact && (piece.id.empty() || seen.insert(piece.id).second);
    }
    return std::move(cut_);
  }

 private:
  /// Whether the declaration names UTF-8 or no encoding, which also means UTF-8.
  bool declares_utf8() const {
    std::string_view head = text_.substr(0, text_.find("?>"));
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    if (!head.starts_with("<?xml")) return true;
    const std::size_t at = head.find("encoding");
    if (at == head.npos) return true;
    const std::string name = fold_case(head.substr(at, 24));
    return name.find("utf-8") != name.npos || name.find("utf8") != name.npos;
  }

  void open(const Tag& tag) {
    ++depth_;
    if (!names_.body.empty() && depth_ == 2 && tag.name == names_.body) {
      if (++bodies_ == 1) {
        cut_.around += tag.empty ? std::string() : std::string(tag.text);
        cut_.closing = fmt::format("</{}>", tag.name) + cut_.closing;
      }
      in_body_ = true;
    } else if (tag.name == names_.tier) {
      const bool placed = names_.body.empty() ? depth_ == 2 : depth_ == 3 && in_body_;
      if (!placed) cut_.exact = false;
      if (placed) {
        in_tier_ = true;
        cut_.tiers.push_back({.name = attribute(tag, names_.tier_name),
                              .begin = tag.begin,
                              .tag_end = tag.end,
                              .first_piece = cut_.pieces.size()});
        tier_depth_ = depth_;
      }
    } else if (in_tier_ && depth_ == tier_depth_ + 1 && !names_.group.empty() && tag.name == names_.group) {
      in_group_ = true;
    } else if (tag.name == names_.piece) {
      const bool placed =
          in_tier_ && piece_depth_ == 0 && (depth_ == tier_depth_ + 1 || (in_group_ && depth_ == tier_depth_ + 2));
      if (!placed) cut_.exact = false;
      if (placed) {
        piece_depth_ = depth_;
        cut_.pieces.push_back({.begin = tag.begin});
        ++cut_.tiers.back().pieces;
        if (names_.annotations[0].empty()) cut_.pieces.back().id = fmt::format("a{}", cut_.pieces.size());
      }
    } else if (tag.name == names_.annotations[0] || tag.name == names_.annotations[1]) {
      if (piece_depth_ == 0 || depth_ != piece_depth_ + 1) {
        cut_.exact = false;
      } else {
        cut_.pieces.back().id = attribute(tag, "ANNOTATION_ID");
      }
    }
  }

  void close(const Tag& tag) {
    if (piece_depth_ == depth_) {
      cut_.pieces.back().end = tag.end;
      piece_depth_ = 0;
    } else if (in_group_ && depth_ == tier_depth_ + 1) {
      in_group_ = false;
    } else if (in_tier_ && depth_ == tier_depth_) {
      cut_.tiers.back().end = tag.end;
      in_tier_ = false;
    } else if (in_body_ && depth_ == 2) {
      in_body_ = false;
    }
    --depth_;
  }

  std::string_view text_;
  const Names& names_;
  Cut cut_;
  std::int64_t depth_ = 1;  ///< the root is open
  std::int64_t tier_depth_ = 0;
  std::int64_t piece_depth_ = 0;  ///< 0: outside any piece
  int bodies_ = 0;
  bool in_body_ = false;
  bool in_group_ = false;
  bool in_tier_ = false;
};

}  // namespace

Cut cut_document(std::string_view text) {
  if (text.substr(0, 4096).find('\0') != text.npos) return {};
  Tags tags(text);
  const std::optional<Tag> root = tags.next();
  if (!root || root->closes || root->empty) return {};
  if (root->name != kEaf.root && root->name != kAnvil.root) return {};
  Cutter cutter(text, root->name == kEaf.root ? kEaf : kAnvil, *root);
  while (const std::optional<Tag> tag = tags.next()) cutter.see(*tag);
  if (!tags.understood() || !cutter.whole()) return {};
  return cutter.take();
}

}  // namespace signweave::semantic_db
