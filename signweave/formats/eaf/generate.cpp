#include "signweave/formats/eaf/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>

#include "signweave/formats/eaf/xml.h"

namespace signweave::eaf {
namespace {

/// Determines the slots that the annotations of a document without source use.
class SlotMaker {
 public:
  struct Ends {
    std::size_t begin = kNone;
    std::size_t end = kNone;
  };

  explicit SlotMaker(const CheckedDocument& checked) : checked_(checked) {
    const std::vector<Tier>& tiers = checked_.document.tiers;
    ends_.resize(tiers.size());
    children_.resize(tiers.size());
    for (std::size_t t = 0; t < tiers.size(); ++t) {
      ends_[t].resize(tiers[t].annotations.size());
      children_[t].resize(tiers[t].annotations.size());
    }
    for (const std::size_t t : checked_.tier_order) {
      if (is_symbolic(checked_.stereotypes[t])) continue;
      for (std::size_t i = 0; i < tiers[t].annotations.size(); ++i) {
        const std::size_t parent = checked_.parent_annotations[t][i];
        const bool under = parent != kNone && !is_symbolic(checked_.stereotypes[checked_.parents[t]]);
        if (under) {
          children_[checked_.parents[t]][parent].push_back({t, i});
        } else {
          roots_.push_back({t, i});
        }
      }
    }
    for (const Node& root : roots_) {
      ends_[root.tier][root.place] = {make(span(root).begin), make(span(root).end)};
      walk(root);
    }
    for (std::size_t t = 0; t < tiers.size(); ++t) {
      for (std::size_t i = 0; i < tiers[t].annotations.size(); ++i) {
        if (ends_[t][i].begin == kNone || !tiers[t].annotations[i].aligned) continue;
        slots_[ends_[t][i].begin].needs_time = slots_[ends_[t][i].end].needs_time = true;
      }
    }
    for (const std::vector<Bound>& bounds : subdivisions_) unalign(bounds);
    number();
  }

  /// "ts1" …, in time order.
  std::string id(std::size_t slot) const { return fmt::format("ts{}", numbers_[slot] + 1); }
  Ends ends(std::size_t tier, std::size_t annotation) const { return ends_[tier][annotation]; }
  /// The TIME_SLOT elements in order.
  std::vector<std::string> elements() const {
    std::vector<std::string> result;
    for (const std::size_t slot : order_) result.push_back(slot_element(id(slot), slots_[slot].time));
    return result;
  }

 private:
  struct Node {
    std::size_t tier;
    std::size_t place;
  };
  struct MadeSlot {
    std::optional<std::int64_t> time;
    std::int64_t shown = 0;   ///< its time, or the time at which ELAN shows it
    bool needs_time = false;  ///< an aligned annotation uses it
    bool listed = false;
  };

  const Annotation& at(Node node) const { return checked_.document.tiers[node.tier].annotations[node.place]; }
  TimeSpan span(Node node) const { return at(node).span; }

  std::size_t make(Milliseconds time) {
    slots_.push_back({.time = time.count(), .shown = time.count()});
    return slots_.size() - 1;
  }

  void list(std::size_t slot) {
    if (slots_[slot].listed) return;
    slots_[slot].listed = true;
    order_.push_back(slot);
  }

  /// Lists the slots under a root so that those of children are between those of their parent. Uses an explicit stack,
  /// because tiers may be nested deeply.
  void walk(Node root) {
    struct Step {
      Node node;
      std::size_t next = 0;            ///< child to visit next
      std::size_t parent_end = kNone;  ///< listed by the parent after all its children
    };
    std::vector<Step> stack{{root}};
    enter(root);
    while (!stack.empty()) {
      Step& step = stack.back();
      const std::vector<Node>& below = children_[step.node.tier][step.node.place];
      const std::size_t end = ends_[step.node.tier][step.node.place].end;
      if (step.next < below.size()) {
        const Node child = below[step.next++];
        enter(child);
        stack.push_back({child, 0, end});  // `step` is invalid from here on
        continue;
      }
      if (end != step.parent_end) list(end);
      stack.pop_back();
    }
  }

  /// Lists an annotation's begin and assigns slots to its children.
  void enter(Node node) {
    const Ends own = ends_[node.tier][node.place];
    list(own.begin);
    const std::vector<Node>& below = children_[node.tier][node.place];
    for (auto first = below.begin(); first != below.end();) {
      const auto last = std::find_if(first, below.end(), [&](const Node& one) { return one.tier != first->tier; });
      if (checked_.stereotypes[first->tier] == Stereotype::time_subdivision) {
        subdivide(node, {first, last});
      } else {
        for (auto one = first; one != last; ++one) {
          ends_[one->tier][one->place] = {make(span(*one).begin), make(span(*one).end)};
        }
      }
      first = last;
    }
  }

  struct Bound {
    std::size_t slot;
    std::int64_t time;  ///< at which ELAN shows it
    bool shared;        ///< by two neighbours
  };

  void subdivide(Node parent, const std::vector<Node>& pieces) {
    const Ends own = ends_[parent.tier][parent.place];
    std::vector<Bound> bounds;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      Ends& ends = ends_[pieces[i].tier][pieces[i].place];
      const TimeSpan here = span(pieces[i]);
      if (i > 0 && span(pieces[i - 1]).end == here.begin) {
        ends.begin = bounds.back().slot;
        bounds.back().shared = true;
      } else {
        ends.begin = i == 0 && here.begin == span(parent).begin ? own.begin : make(here.begin);
        bounds.push_back({ends.begin, here.begin.count(), false});
      }
      const bool last = i + 1 == pieces.size();
      ends.end = last && here.end == span(parent).end ? own.end : make(here.end);
      bounds.push_back({ends.end, here.end.count(), false});
    }
    subdivisions_.push_back(std::move(bounds));
  }

  /// Removes the time of every slot that ELAN would show at exactly that time without it, and that is not used by an
  /// annotation with times of its own.
  void unalign(const std::vector<Bound>& bounds) {
    const auto even = [&](std::size_t from, std::size_t to) {
      const std::int64_t step = (bounds[to].time - bounds[from].time) / static_cast<std::int64_t>(to - from);
      for (std::size_t i = from + 1; i < to; ++i) {
        if (bounds[i].time != bounds[i - 1].time + step) return false;
      }
      return true;
    };
    for (std::size_t from = 0; from + 1 < bounds.size();) {
      constexpr std::size_t kLongestRun = 1000;  // a longer run would take long to search
      std::size_t to = from + 1;
      while (to + 1 < bounds.size() && bounds[to].shared && !slots_[bounds[to].slot].needs_time &&
             to - from < kLongestRun)
        ++to;
      while (to > from + 1 && !even(from, to)) --to;
      for (std::size_t i = from + 1; i < to; ++i) slots_[bounds[i].slot].time = std::nullopt;
      from = to;
    }
  }

  void number() {
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return slots_[a].shown < slots_[b].shown; });
    numbers_.resize(slots_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) numbers_[order_[i]] = i;
  }

  const CheckedDocument& checked_;
  std::vector<std::vector<Ends>> ends_;
  std::vector<std::vector<std::vector<Node>>> children_;
  std::vector<Node> roots_;
  std::vector<MadeSlot> slots_;
  std::vector<std::vector<Bound>> subdivisions_;  ///< the bounds of the parts of one parent, in order
  std::vector<std::size_t> order_;
  std::vector<std::size_t> numbers_;
};

class Lines {
 public:
  void add(std::size_t depth, std::string_view line) {
    text_.append(depth * 4, ' ');
    text_ += line;
    text_ += '\n';
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void add_header(const CheckedDocument& checked, Lines& lines) {
  const AnnotationDocument& document = checked.document;
  lines.add(1, "<HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\">");
  for (const bool media : {true, false}) {  // the schema requires media first
    for (const LinkedFile& file : document.linked_files) {
      if (file.media == media) lines.add(2, linked_file_element(file));
    }
  }
  bool counted = false;
  for (const auto& [name, value] : document.properties) {
    lines.add(2, property_element(name, value));
    counted = counted || name == kLastUsedAnnotationId;
  }
  if (!counted) lines.add(2, property_element(kLastUsedAnnotationId, fmt::format("{}", checked.last_id)));
  lines.add(1, "</HEADER>");
}

void add_tier(const CheckedDocument& checked, std::size_t index, const SlotMaker& slots, Lines& lines) {
  const Tier& tier = checked.document.tiers[index];
  const std::string tag = open_tag("TIER", attributes_of(tier));
  if (tier.annotations.empty()) {
    lines.add(1, tag + "/>");
    return;
  }
  lines.add(1, tag + ">");
  const Annotation* before = nullptr;
  for (std::size_t i = 0; i < tier.annotations.size(); ++i) {
    const Annotation& one = tier.annotations[i];
    References references;
    if (!is_symbolic(checked.stereotypes[index])) {
      references = {slots.id(slots.ends(index, i).begin), slots.id(slots.ends(index, i).end), {}};
    } else if (checked.stereotypes[index] == Stereotype::symbolic_subdivision) {
      if (before != nullptr && before->parent == one.parent) references.previous = before->id;
      before = &one;
    }
    lines.add(2, annotation_element(one, references, "\n"));
  }
  lines.add(1, "</TIER>");
}

}  // namespace

std::string generate(const CheckedDocument& checked) {
  const AnnotationDocument& document = checked.document;
  const SlotMaker slots(checked);
  Lines lines;
  lines.add(0, R"(<?xml version="1.0" encoding="UTF-8"?>)");
  // The schema requires a date, and the same document must give the same bytes.
  const std::string date = document.date.empty() ? "1970-01-01T00:00:00+00:00" : document.date;
  lines.add(0, open_tag("ANNOTATION_DOCUMENT",
                        {{"AUTHOR", document.author},
                         {"DATE", date},
                         {"FORMAT", "3.0"},
                         {"VERSION", "3.0"},
                         {"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"},
                         {"xsi:noNamespaceSchemaLocation", "http://www.mpi.nl/tools/elan/EAFv3.0.xsd"}}) +
                   ">");
  add_header(checked, lines);
  lines.add(1, "<TIME_ORDER>");
  for (const std::string& element : slots.elements()) lines.add(2, element);
  lines.add(1, "</TIME_ORDER>");
  std::set<std::string> languages;
  std::set<std::string> vocabularies;
  for (const std::size_t index : checked.tier_order) {
    const Tier& tier = document.tiers[index];
    add_tier(checked, index, slots, lines);
    if (!tier.language.empty()) languages.insert(tier.language);
  }
  for (const TierType& type : document.types) {
    lines.add(1, type_element(type));
    if (!type.controlled_vocabulary.empty()) vocabularies.insert(type.controlled_vocabulary);
  }
  for (const std::string& id : languages) lines.add(1, language_element(id));
  for (const Stereotype stereotype : kConstraints) lines.add(1, constraint_element(stereotype));
  for (const std::string& id : vocabularies) lines.add(1, vocabulary_element(id));
  lines.add(0, "</ANNOTATION_DOCUMENT>");
  return lines.take();
}

}  // namespace signweave::eaf
