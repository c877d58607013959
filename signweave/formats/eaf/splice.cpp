#include "signweave/formats/eaf/splice.h"

#include <fmt/format.h>

#include <algorithm>

namespace signweave::eaf {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

/// The position after `what`, or the end of the text.
std::size_t past(std::string_view text, std::string_view what, std::size_t from) {
  const std::size_t at = text.find(what, from);
  return at == std::string_view::npos ? text.size() : at + what.size();
}

/// The position after the '>' that ends a tag; quoted text may contain one.
std::size_t past_tag(std::string_view text, std::size_t from) {
  for (std::size_t at = from; at < text.size(); ++at) {
    if (text[at] == '>') return at + 1;
    if (text[at] == '"' || text[at] == '\'') at = std::min(text.find(text[at], at + 1), text.size());
  }
  return text.size();
}

/// The position after a DOCTYPE, whose internal subset contains declarations and comments in brackets.
std::size_t past_doctype(std::string_view text, std::size_t from) {
  std::size_t depth = 0;
  for (std::size_t at = from; at < text.size(); ++at) {
    if (text.substr(at).starts_with("<!--")) {
      at = past(text, "-->", at) - 1;
    } else if (text[at] == '"' || text[at] == '\'') {
      at = std::min(text.find(text[at], at + 1), text.size());
    } else if (text[at] == '<') {
      ++depth;
    } else if (text[at] == '>' && --depth == 0) {
      return at + 1;
    }
  }
  return text.size();
}

}  // namespace

Extents::Extents(const Xml& xml) : xml_(xml) {
  const std::string_view text = xml.text();
  std::vector<std::size_t> open;
  std::size_t at = 0;
  while ((at = text.find('<', at)) != std::string_view::npos) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) {
      at = past(text, "-->", at + 4);
    } else if (rest.starts_with("<![CDATA[")) {
      at = past(text, "]]>", at);
    } else if (rest.starts_with("<?")) {
      at = past(text, "?>", at);
    } else if (rest.starts_with("<!")) {
      at = past_doctype(text, at);
    } else if (rest.starts_with("</")) {
      const std::size_t end = past_tag(text, at);
      if (!open.empty()) {
        extents_[open.back()].close_begin = at;
        extents_[open.back()].end = end;
        open.pop_back();
      }
      at = end;
    } else {
      const std::size_t end = past_tag(text, at);
      extents_.push_back({at, end, end, end});
      if (text[end - 2] != '/') open.push_back(extents_.size() - 1);
      at = end;
    }
  }
}

Extent Extents::of(pugi::xml_node element) const {
  const auto begin = static_cast<std::size_t>(element.offset_debug()) - 1;  // after its '<'
  const auto found = std::lower_bound(extents_.begin(), extents_.end(), begin,
                                      [](const Extent& extent, std::size_t at) { return extent.begin < at; });
  if (found == extents_.end() || found->begin != begin) {
    xml_.fail(element, "this element cannot be changed in place; save the file with ELAN first");
  }
  return *found;
}

void Edits::replace(std::size_t begin, std::size_t end, std::string with) {
  edits_.push_back({begin, end, std::move(with)});
}

std::string Edits::apply(std::size_t begin, std::size_t end) const {
  std::vector<const Edit*> order;
  for (const Edit& edit : edits_) {
    if (edit.begin >= begin && edit.end <= end) order.push_back(&edit);
  }
  // An insertion at a position comes before a removal that begins there.
  std::stable_sort(order.begin(), order.end(), [](const Edit* a, const Edit* b) {
    return a->begin != b->begin ? a->begin < b->begin : (a->begin == a->end && b->begin != b->end);
  });
  std::string result;
  std::size_t at = begin;
  for (const Edit* edit : order) {
    result += text_.substr(at, edit->begin - at);
    result += edit->with;
    at = edit->end;
  }
  result += text_.substr(at, end - at);
  return result;
}

void edit_attributes(Edits& edits, const Extent& extent, pugi::xml_node element, const std::vector<Attribute>& wanted) {
  const std::string_view text = edits.text();
  const std::size_t tag_end = extent.open_end - (extent.self_closing() ? 2 : 1);
  struct FoundAttribute {
    std::string_view name;
    std::size_t begin;  ///< of the blanks before the name
    std::size_t value;
    std::size_t end;  ///< after the quote
  };
  std::vector<FoundAttribute> found;
  std::size_t at = text.find_first_of(" \t\r\n/>", extent.begin + 1);
  std::size_t last = at;
  while (at < tag_end) {
    const std::size_t name = text.find_first_not_of(kBlank, at);
    if (name >= tag_end) break;
    const std::size_t name_end = text.find_first_of(" \t\r\n=", name);
    const std::size_t quote = text.find_first_of("\"'", name_end);
    if (quote >= tag_end) break;
    const std::size_t end = text.find(text[quote], quote + 1);
    found.push_back({text.substr(name, name_end - name), at, quote + 1, end + 1});
    at = last = end + 1;
  }
  for (const Attribute& one : wanted) {
    const pugi::xml_attribute now = element.attribute(one.name.c_str());
    if (one.value ? now && *one.value == now.value() : !now) continue;
    const auto place =
        std::find_if(found.begin(), found.end(), [&](const FoundAttribute& p) { return p.name == one.name; });
    if (!one.value) {
      if (place != found.end()) edits.replace(place->begin, place->end, {});
    } else if (place == found.end()) {
      edits.insert(last, fmt::format(" {}=\"{}\"", one.name, escaped(*one.value, one.name)));
    } else {
      const char quote = text[place->value - 1];
      edits.replace(place->value - 1, place->end,
                    fmt::format("{0}{1}{0}", quote == '\'' ? '"' : quote, escaped(*one.value, one.name)));
    }
  }
}

void edit_content(Edits& edits, const Extent& extent, std::string_view name, std::string content) {
  if (extent.self_closing()) {
    edits.replace(extent.open_end - 2, extent.open_end, fmt::format(">{}</{}>", content, name));
  } else {
    edits.replace(extent.open_end, extent.close_begin, std::move(content));
  }
}

namespace {

/// The beginning of the blanks before a position.
std::size_t blanks_before(std::string_view text, std::size_t at) {
  while (at > 0 && kBlank.find(text[at - 1]) != std::string_view::npos) --at;
  return at;
}

/// Selects the items that stay when the list determines the order: a longest subsequence that is in file order.
std::vector<bool> staying(const std::vector<ListItem>& items, bool keep_places) {
  std::vector<bool> stays(items.size(), false);
  std::vector<std::size_t> tails;  // [length - 1], the item that ends the best run of that length
  std::vector<std::size_t> before(items.size(), kNone);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].old) continue;
    if (keep_places) {
      stays[i] = true;
      continue;
    }
    const auto place = std::lower_bound(tails.begin(), tails.end(), items[i].old->begin,
                                        [&](std::size_t tail, std::size_t at) { return items[tail].old->begin < at; });
    if (place != tails.begin()) before[i] = *(place - 1);
    if (place == tails.end()) {
      tails.push_back(i);
    } else {
      *place = i;
    }
  }
  if (!tails.empty()) {
    for (std::size_t i = tails.back(); i != kNone; i = before[i]) stays[i] = true;
  }
  return stays;
}

}  // namespace

bool edit_list(Edits& edits, const std::vector<Extent>& old, const std::vector<ListItem>& items,
               const ListPlace& place) {
  const std::string_view text = edits.text();
  const std::vector<bool> stays = staying(items, place.keep_places);
  std::vector<std::size_t> kept;
  bool inserted = false;
  std::size_t anchor = place.head;
  if (!old.empty()) {
    const auto first =
        std::min_element(old.begin(), old.end(), [](const Extent& a, const Extent& b) { return a.begin < b.begin; });
    anchor = blanks_before(text, first->begin);
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    const ListItem& item = items[i];
    if (stays[i]) {
      if (item.text) edits.replace(item.old->begin, item.old->end, *item.text);
      kept.push_back(item.old->begin);
      anchor = item.old->end;
      continue;
    }
    inserted = true;
    const std::string_view moved = item.old ? text.substr(item.old->begin, item.old->end - item.old->begin) : "";
    edits.insert(anchor, place.separator + (item.text ? *item.text : std::string(moved)));
  }
  std::sort(kept.begin(), kept.end());
  for (const Extent& extent : old) {
    if (std::binary_search(kept.begin(), kept.end(), extent.begin)) continue;
    edits.replace(blanks_before(text, extent.begin), extent.end, {});
  }
  return inserted;
}

}  // namespace signweave::eaf
