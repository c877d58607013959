#include "signweave/formats/eaf/edit.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/formats/eaf/edit_head.h"
#include "signweave/formats/eaf/edit_known.h"
#include "signweave/formats/eaf/edit_slots.h"
#include "signweave/formats/eaf/splice.h"

namespace signweave::eaf {
namespace {

class TierEditor {
 public:
  explicit TierEditor(EditContext& context)
      : context_(context),
        now_(context.now),
        old_(context.old),
        known_(recognise(context.old, context.checked)),
        slots_(edit_slots(context.old, context.checked, known_)) {}

  void edit_time_order() {
    std::vector<ListItem> items;
    bool changed = slots_.order.size() != old_.slots.size();
    for (const std::size_t index : slots_.order) {
      const EditedSlot& slot = slots_.slots[index];
      ListItem& item = items.emplace_back();
      if (slot.old == kNone) {
        item.text = slot_element(slot.id, slot.time);
        changed = true;
        continue;
      }
      const Slot& was = old_.slots[slot.old];
      item.old = context_.extents.of(was.element);
      changed = changed || slot.old + 1 != items.size();
      if (slot.time == was.time) continue;
      item.text = context_.with_attributes(was.element, {{"TIME_VALUE", fmt::format("{}", *slot.time)}});
      changed = true;
    }
    if (!changed) return;
    const pugi::xml_node order = context_.xml.root().child("TIME_ORDER");
    if (!order) {
      std::string text = "<TIME_ORDER>";
      for (const ListItem& item : items) text += context_.separator(2) + *item.text;
      context_.insert_at_root("TIME_ORDER", text + context_.separator(1) + "</TIME_ORDER>");
      return;
    }
    std::vector<Extent> old;
    for (const Slot& slot : old_.slots) old.push_back(context_.extents.of(slot.element));
    const Extent extent = context_.extents.of(order);
    const ListPlace place{.head = extent.open_end, .separator = context_.separator(2)};
    if (edit_list(context_.edits, old, items, place)) context_.open_up(context_.edits, extent, "TIME_ORDER", 1);
  }

  void edit_tiers() {
    std::vector<ListItem> items;
    for (std::size_t t = 0; t < now_.tiers.size(); ++t) {
      ListItem& item = items.emplace_back();
      if (known_.tiers[t] == kNone) {
        item.text = new_tier(t);
        continue;
      }
      item.old = context_.extents.of(old_.tiers[known_.tiers[t]].element);
      item.text = changed_tier(t);
    }
    std::vector<Extent> old;
    for (const FileTier& tier : old_.tiers) old.push_back(context_.extents.of(tier.element));
    const ListPlace place{.head = context_.place_at_root("TIER"), .separator = context_.separator(1)};
    const bool inserted = edit_list(context_.edits, old, items, place);
    context_.inserted_at_root = context_.inserted_at_root || inserted;
  }

 private:
  std::string new_tier(std::size_t t) const {
    const Tier& tier = now_.tiers[t];
    std::string text = open_tag("TIER", attributes_of(tier));
    if (tier.annotations.empty()) return text + "/>";
    text += ">";
    for (std::size_t i = 0; i < tier.annotations.size(); ++i) {
      const std::optional<std::string> changed = changed_annotation(t, i);
      text += context_.separator(2);
      text += changed ? std::string_view(*changed) : old_text(t, i);  // moved from another tier
    }
    return text + context_.separator(1) + "</TIER>";
  }

  Extent holder(const FileAnnotation& one) const { return context_.extents.of(one.element.parent()); }

  std::string_view old_text(std::size_t t, std::size_t i) const {
    const Extent extent = holder(*known_.annotations[t][i]);
    return context_.xml.text().substr(extent.begin, extent.end - extent.begin);
  }

  /// The tier's new text; nullopt if it is unchanged.
  std::optional<std::string> changed_tier(std::size_t t) const {
    const Tier& tier = now_.tiers[t];
    const FileTier& was = old_.tiers[known_.tiers[t]];
    const Extent extent = context_.extents.of(was.element);
    Edits edits(context_.xml.text());
    std::vector<Attribute> attributes = attributes_of(tier);
    for (Attribute& one : attributes) {  // a missing attribute and an empty one are equivalent for us
      const pugi::xml_attribute now = was.element.attribute(one.name.c_str());
      if (one.value.value_or("").empty() && std::string_view(now.value()).empty()) {
        one.value = now ? std::optional<std::string>("") : std::nullopt;
      }
    }
    edit_attributes(edits, extent, was.element, attributes);

    bool changed = was.annotations.size() != tier.annotations.size();
    std::vector<ListItem> items;
    for (std::size_t i = 0; i < tier.annotations.size(); ++i) {
      ListItem& item = items.emplace_back();
      const bool here = is_in(was, known_.annotations[t][i]);
      if (here) item.old = holder(*known_.annotations[t][i]);
      item.text = changed_annotation(t, i);
      if (!here && !item.text) item.text = old_text(t, i);  // moved from another tier
      changed = changed || item.text;
    }
    if (changed) {
      std::vector<Extent> old;
      for (const FileAnnotation& one : was.annotations) old.push_back(holder(one));
      const ListPlace place{.head = extent.open_end, .separator = context_.separator(2), .keep_places = true};
      if (edit_list(edits, old, items, place)) context_.open_up(edits, extent, "TIER", 1);
    }
    if (edits.empty()) return std::nullopt;
    return edits.apply(extent.begin, extent.end);
  }

  static bool is_in(const FileTier& tier, const FileAnnotation* one) {
    const FileAnnotation* first = tier.annotations.data();
    return one != nullptr && !std::less<>()(one, first) && std::less<>()(one, first + tier.annotations.size());
  }

  /// The new text of the ANNOTATION element; nullopt if it is unchanged.
  std::optional<std::string> changed_annotation(std::size_t t, std::size_t i) const {
    const Annotation& one = now_.tiers[t].annotations[i];
    const FileAnnotation* was = known_.annotations[t][i];
    const bool with_slots = known_.with_slots[t][i];
    References references;
    if (with_slots) {
      const EditedSlots::Ends ends = slots_.ends[t][i];
      references = {slots_.slots[ends.begin].id, slots_.slots[ends.end].id, {}};
    } else if (context_.checked.stereotypes[t] == Stereotype::symbolic_subdivision) {
      references.previous = previous(t, i);
    }
    if (was == nullptr || was->has_slots() != with_slots) {
      if (!with_slots && one.parent.empty()) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("tier '{}': annotation '{}' has no parent, though the type of its "
                                "tier needs one now; give it one",
                                printable(now_.tiers[t].id), printable(one.id)));
      }
      return annotation_element(one, references, context_.line);
    }
    std::vector<Attribute> attributes = attributes_of(one, references);
    if (!with_slots && same_chain(t, i))
      attributes.pop_back();  // as in the file, which may have no PREVIOUS_ANNOTATION
    const Extent extent = context_.extents.of(was->element);
    Edits edits(context_.xml.text());
    edit_attributes(edits, extent, was->element, attributes);
    if (one.label != was->annotation.label) edit_label(edits, extent, was->element, one.label);
    if (edits.empty()) return std::nullopt;
    return edits.apply(holder(*was).begin, holder(*was).end);
  }

  void edit_label(Edits& edits, const Extent& extent, pugi::xml_node element, const std::string& label) const {
    std::string text = escaped(label, "the label");
    if (const pugi::xml_node value = element.child("ANNOTATION_VALUE")) {
      edit_content(edits, context_.extents.of(value), "ANNOTATION_VALUE", std::move(text));
      return;
    }
    edits.insert(extent.open_end,
                 fmt::format("{}<ANNOTATION_VALUE>{}</ANNOTATION_VALUE>", context_.separator(4), text));
    context_.open_up(edits, extent, element.name(), 3);
  }

  std::string previous(std::size_t t, std::size_t i) const {
    const std::vector<Annotation>& all = now_.tiers[t].annotations;
    return i > 0 && all[i - 1].parent == all[i].parent ? all[i - 1].id : std::string();
  }

  /// True if an annotation follows the same one under the same parent as before.
  bool same_chain(std::size_t t, std::size_t i) const {
    if (context_.checked.stereotypes[t] != Stereotype::symbolic_subdivision) return true;
    const FileAnnotation* was = known_.annotations[t][i];
    if (known_.tiers[t] == kNone || !is_in(old_.tiers[known_.tiers[t]], was)) return false;
    const FileAnnotation* first = old_.tiers[known_.tiers[t]].annotations.data();
    const bool follows = was != first && (was - 1)->annotation.parent == was->annotation.parent;
    return previous(t, i) == (follows ? (was - 1)->annotation.id : std::string());
  }

  EditContext& context_;
  const AnnotationDocument& now_;
  const FileParts& old_;
  Known known_;
  EditedSlots slots_;
};

}  // namespace

std::string edit(const Xml& xml, const FileParts& old, const CheckedDocument& checked) {
  EditContext context(xml, old, checked);
  TierEditor tiers(context);
  edit_root(context);
  edit_header(context);
  tiers.edit_time_order();
  tiers.edit_tiers();
  edit_types(context);
  const Extent root = context.extents.of(xml.root());
  if (root.self_closing() && context.inserted_at_root) {
    context.edits.replace(root.open_end - 2, root.open_end, ">");
    context.edits.insert(root.open_end, fmt::format("{}</{}>", context.line, xml.root().name()));
  }
  return context.edits.apply(0, xml.text().size());
}

}  // namespace signweave::eaf
