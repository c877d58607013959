#include "signweave/formats/eaf/edit_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace signweave::eaf {
namespace {

/// Matches each element of `now` with at most one of `was`: first the equal ones, then by each of the tests in turn.
/// Returns [now], an index into `was` or kNone.
template <typename T>
std::vector<std::size_t> partners(const std::vector<T>& was, const std::vector<T>& now,
                                  const std::vector<bool (*)(const T&, const T&)>& tests) {
  std::vector<std::size_t> result(now.size(), kNone);
  std::vector<bool> taken(was.size(), false);
  const auto pair_up = [&](auto fits) {
    std::size_t free = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      while (free < was.size() && taken[free]) ++free;
      for (std::size_t j = free; j < was.size() && result[i] == kNone; ++j) {
        if (taken[j] || !fits(was[j], now[i])) continue;
        result[i] = j;
        taken[j] = true;
      }
    }
  };
  pair_up([](const T& a, const T& b) { return a == b; });
  for (const auto test : tests) pair_up(test);
  return result;
}

template <typename T, typename Change, typename Make>
std::vector<ListItem> list_items(const EditContext& context, const std::vector<T>& was, const std::vector<T>& now,
                                 const std::vector<pugi::xml_node>& nodes,
                                 const std::vector<bool (*)(const T&, const T&)>& tests, Change change, Make make) {
  const std::vector<std::size_t> partner = partners(was, now, tests);
  std::vector<ListItem> items;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (partner[i] == kNone) {
      items.push_back({std::nullopt, make(now[i])});
      continue;
    }
    const pugi::xml_node node = nodes[partner[i]];
    items.push_back({context.extents.of(node), std::nullopt});
    if (was[partner[i]] != now[i]) items.back().text = change(node, now[i]);
  }
  return items;
}

void edit_encoding(EditContext& context) {
  if (!context.xml.converted()) return;
  for (const pugi::xml_node node : context.xml.document().children()) {
    const std::string_view encoding = node.attribute("encoding").value();
    if (node.type() != pugi::node_declaration || encoding.empty()) continue;
    const std::size_t at = context.xml.text().find(encoding);
    context.edits.replace(at, at + encoding.size(), "UTF-8");
  }
}

bool is_declared(const EditContext& context, const char* element, const char* attribute, std::string_view id) {
  for (const pugi::xml_node node : context.xml.root().children(element)) {
    if (id == node.attribute(attribute).value()) return true;
  }
  return false;
}

void add_declarations(EditContext& context) {
  std::set<std::string> languages;
  for (const Tier& tier : context.now.tiers) languages.insert(tier.language);
  for (const FileTier& tier : context.old.tiers) languages.erase(tier.tier.language);
  languages.erase("");
  for (const std::string& id : languages) {
    if (!is_declared(context, "LANGUAGE", "LANG_ID", id)) context.insert_at_root("LANGUAGE", language_element(id));
  }
  std::set<Stereotype> stereotypes;
  std::set<std::string> vocabularies;
  for (const TierType& type : context.now.types) {
    stereotypes.insert(type.stereotype);
    vocabularies.insert(type.controlled_vocabulary);
  }
  for (const TierType& type : context.old.head.types) {
    stereotypes.erase(type.stereotype);
    vocabularies.erase(type.controlled_vocabulary);
  }
  vocabularies.erase("");
  for (const Stereotype stereotype : kConstraints) {
    if (!stereotypes.contains(stereotype)) continue;
    if (is_declared(context, "CONSTRAINT", "STEREOTYPE", name_of(stereotype))) continue;
    context.insert_at_root("CONSTRAINT", constraint_element(stereotype));
  }
  for (const std::string& id : vocabularies) {
    if (is_declared(context, "CONTROLLED_VOCABULARY", "CV_ID", id)) continue;
    context.insert_at_root("CONTROLLED_VOCABULARY", vocabulary_element(id));
  }
}

}  // namespace

EditContext::EditContext(const Xml& source, const FileParts& parts, const CheckedDocument& wanted)
    : xml(source),
      old(parts),
      checked(wanted),
      now(wanted.document),
      extents(source),
      edits(source.text()),
      line(source.text().find("\r\n") == std::string_view::npos ? "\n" : "\r\n") {}

std::vector<Extent> EditContext::extents_of(const std::vector<pugi::xml_node>& nodes) const {
  std::vector<Extent> result;
  for (const pugi::xml_node node : nodes) result.push_back(extents.of(node));
  return result;
}

std::string EditContext::with_attributes(pugi::xml_node element, const std::vector<Attribute>& attributes) const {
  const Extent extent = extents.of(element);
  Edits own(xml.text());
  edit_attributes(own, extent, element, attributes);
  return own.apply(extent.begin, extent.end);
}

std::size_t EditContext::place_at_root(std::string_view name) const {
  constexpr std::array<std::string_view, 9> kOrder = {"LICENSE",  "HEADER",          "TIME_ORDER",
                                                      "TIER",     "LINGUISTIC_TYPE", "LOCALE",
                                                      "LANGUAGE", "CONSTRAINT",      "CONTROLLED_VOCABULARY"};
  const auto rank = [&](std::string_view of) { return std::find(kOrder.begin(), kOrder.end(), of) - kOrder.begin(); };
  std::size_t at = extents.of(xml.root()).open_end;
  for (const pugi::xml_node child : xml.root().children()) {
    if (child.type() == pugi::node_element && rank(child.name()) <= rank(name)) at = extents.of(child).end;
  }
  return at;
}

void EditContext::insert_at_root(std::string_view name, std::string text) {
  edits.insert(place_at_root(name), separator(1) + std::move(text));
  inserted_at_root = true;
}

void EditContext::open_up(Edits& into, const Extent& extent, std::string_view name, std::size_t depth) const {
  if (extent.self_closing()) {
    into.replace(extent.open_end - 2, extent.open_end, ">");
    into.insert(extent.open_end, fmt::format("{}</{}>", separator(depth), name));
  } else if (extent.close_begin == extent.open_end) {
    into.insert(extent.open_end, separator(depth));
  }
}

void edit_root(EditContext& context) {
  edit_encoding(context);
  const pugi::xml_node root = context.xml.root();
  const auto value = [&](const char* name, const std::string& text) -> Attribute {
    if (text.empty() && !root.attribute(name)) return {name, std::nullopt};
    return {name, text};
  };
  const AnnotationDocument& now = context.now;
  edit_attributes(context.edits, context.extents.of(root), root,
                  {value("AUTHOR", now.author), value("DATE", now.date), value("FORMAT", now.format)});
}

void edit_header(EditContext& context) {
  const AnnotationDocument& was = context.old.head;
  const AnnotationDocument& now = context.now;
  if (was.linked_files == now.linked_files && was.properties == now.properties) return;
  const pugi::xml_node header = context.xml.root().child("HEADER");
  if (!header) {
    std::string text = R"(<HEADER MEDIA_FILE="" TIME_UNITS="milliseconds">)";
    for (const LinkedFile& file : now.linked_files) text += context.separator(2) + linked_file_element(file);
    for (const auto& [name, value] : now.properties) text += context.separator(2) + property_element(name, value);
    context.insert_at_root("HEADER", text + context.separator(1) + "</HEADER>");
    return;
  }
  std::vector<pugi::xml_node> files;
  std::vector<pugi::xml_node> properties;
  const Extent extent = context.extents.of(header);
  std::size_t last = extent.open_end;
  for (const pugi::xml_node one : context.xml.root().children("HEADER")) {
    for (const pugi::xml_node child : one.children()) {
      const std::string_view name = child.name();
      if (name == "MEDIA_DESCRIPTOR" || name == "LINKED_FILE_DESCRIPTOR") files.push_back(child);
      if (name == "PROPERTY") properties.push_back(child);
      if (one == header && child.type() == pugi::node_element) last = context.extents.of(child).end;
    }
  }
  const std::vector<ListItem> file_items = list_items(
      context, was.linked_files, now.linked_files, files,
      {[](const LinkedFile& a, const LinkedFile& b) { return a.media == b.media && a.url == b.url; },
       [](const LinkedFile& a, const LinkedFile& b) { return a.media == b.media; }},
      [&](pugi::xml_node node, const LinkedFile& file) {
        std::vector<Attribute> attributes = attributes_of(file);
        if (node.attribute("TIME_ORIGIN") && !attributes.back().value) attributes.back().value = "0";
        return context.with_attributes(node, attributes);
      },
      linked_file_element);
  using Property = std::pair<std::string, std::string>;
  const std::vector<ListItem> property_items = list_items(
      context, was.properties, now.properties, properties,
      {[](const Property& a, const Property& b) { return a.first == b.first; }},
      [&](pugi::xml_node node, const Property& property) {
        Edits edits(context.xml.text());
        edit_content(edits, context.extents.of(node), "PROPERTY", escaped(property.second, "the property"));
        return edits.apply(context.extents.of(node).begin, context.extents.of(node).end);
      },
      [](const Property& property) { return property_element(property.first, property.second); });
  const ListPlace files_place{.head = extent.open_end, .separator = context.separator(2)};
  const ListPlace properties_place{.head = last, .separator = context.separator(2)};
  const bool first = edit_list(context.edits, context.extents_of(files), file_items, files_place);
  const bool second = edit_list(context.edits, context.extents_of(properties), property_items, properties_place);
  if (first || second) context.open_up(context.edits, extent, "HEADER", 1);
}

void edit_types(EditContext& context) {
  const std::vector<TierType>& was = context.old.head.types;
  if (was != context.now.types) {
    std::vector<pugi::xml_node> nodes;
    for (const pugi::xml_node node : context.xml.root().children("LINGUISTIC_TYPE")) nodes.push_back(node);
    const std::vector<ListItem> items = list_items(
        context, was, context.now.types, nodes, {[](const TierType& a, const TierType& b) { return a.id == b.id; }},
        [&](pugi::xml_node node, const TierType& type) { return context.with_attributes(node, attributes_of(type)); },
        type_element);
    const ListPlace place{.head = context.place_at_root("LINGUISTIC_TYPE"), .separator = context.separator(1)};
    const bool inserted = edit_list(context.edits, context.extents_of(nodes), items, place);
    context.inserted_at_root = context.inserted_at_root || inserted;
  }
  add_declarations(context);
}

}  // namespace signweave::eaf
