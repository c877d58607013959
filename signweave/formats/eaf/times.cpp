#include "signweave/formats/eaf/times.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "signweave/core/text.h"
#include "signweave/formats/eaf/ids.h"

namespace signweave::eaf {
namespace {

/// A stable sort; most tiers are already sorted, and annotations are expensive to move.
template <typename Iterator, typename Before>
void sort_unless_sorted(Iterator begin, Iterator end, const Before& before) {
  if (!std::is_sorted(begin, end, before)) std::stable_sort(begin, end, before);
}

class Settler {
 public:
  Settler(const Xml& xml, Unsound unsound, FileParts& parts)
      : xml_(xml),
        unsound_(unsound),
        parts_(parts),
        times_(parts.slots.size()),
        begins_(parts.slots.size(), kNone),
        ends_(parts.slots.size(), kNone) {}

  void run(const std::vector<std::size_t>& tier_order) {
    rank_slots();
    for (std::size_t i = 0; i < times_.size(); ++i) times_[i] = parts_.slots[i].time;
    for (const std::size_t index : tier_order) {
      FileTier& tier = parts_.tiers[index];
      if (tier.parent != kNone && !parts_.tiers[tier.parent].left_out.empty()) leave_out_orphans(tier);
      sort_by_slots(tier);
      if (tier.parent != kNone) {
        find_parents_by_slots(tier);
        interpolate(tier);
      }
      set_spans(tier);
      if (tier.parent != kNone) {
        find_parents_by_time(tier);
        divide_parents(tier);
      }
      sort_by_time(tier);
      report(tier);
    }
  }

 private:
  /// A stable sort by the latest time so far is equivalent to ELAN's insertion of one slot after another.
  void rank_slots() {
    const std::size_t count = parts_.slots.size();
    std::vector<std::int64_t> reached(count);
    std::int64_t latest = -1;
    for (std::size_t i = 0; i < count; ++i) {
      const std::optional<std::int64_t>& time = parts_.slots[i].time;
      if (time) latest = std::max(latest, *time);
      reached[i] = time.value_or(latest);
    }
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    sort_unless_sorted(order_.begin(), order_.end(),
                       [&](std::size_t a, std::size_t b) { return reached[a] < reached[b]; });
    for (std::size_t i = 0; i < count; ++i) parts_.slots[order_[i]].rank = i;
  }

  /// Leaves out the annotations that refer to one that was left out.
  void leave_out_orphans(FileTier& tier) {
    Ids missing;
    for (const FileAnnotation& one : parts_.tiers[tier.parent].left_out) missing.add(one.annotation.id, 0);
    std::vector<FileAnnotation> sound;
    for (FileAnnotation& one : tier.annotations) {
      if (one.has_slots() || missing.find(one.annotation.parent) == Ids::kMissing) {
        sound.push_back(std::move(one));
        continue;
      }
      const std::string what = fmt::format("annotation '{}' refers to annotation '{}', which is left out",
                                           printable(one.annotation.id), printable(one.annotation.parent));
      leave_out(xml_, unsound_, parts_, tier, std::move(one), what, "correct that one");
    }
    tier.annotations = std::move(sound);
  }

  std::size_t rank(std::size_t slot) const { return parts_.slots[slot].rank; }

  /// Sorts those with slots first, in the order of their slots; the others stay as in the file.
  void sort_by_slots(FileTier& tier) {
    const auto key = [&](const FileAnnotation& one) { return one.has_slots() ? rank(one.begin) : kNone; };
    sort_unless_sorted(tier.annotations.begin(), tier.annotations.end(),
                       [&](const FileAnnotation& a, const FileAnnotation& b) { return key(a) < key(b); });
    parents_.assign(tier.annotations.size(), kNone);
  }

  void find_parents_by_slots(const FileTier& tier) {
    const std::vector<FileAnnotation>& above = parts_.tiers[tier.parent].annotations;
    std::vector<std::size_t> by_rank;  // parents with slots
    for (std::size_t i = 0; i < above.size(); ++i) {
      if (!above[i].has_slots()) continue;
      std::size_t& begins = begins_[above[i].begin];
      std::size_t& ends = ends_[above[i].end];
      begins = std::min(begins, i);  // the first of several; kNone is greater than any
      ends = std::min(ends, i);
      by_rank.push_back(i);
    }
    sort_unless_sorted(by_rank.begin(), by_rank.end(),
                       [&](std::size_t a, std::size_t b) { return rank(above[a].begin) < rank(above[b].begin); });
    for (std::size_t i = 0; i < tier.annotations.size() && tier.annotations[i].has_slots(); ++i) {
      const FileAnnotation& one = tier.annotations[i];
      if (begins_[one.begin] != kNone) {
        parents_[i] = begins_[one.begin];
      } else if (ends_[one.end] != kNone) {
        parents_[i] = ends_[one.end];
      } else {
        const auto after =
            std::upper_bound(by_rank.begin(), by_rank.end(), rank(one.begin),
                             [&](std::size_t value, std::size_t parent) { return value < rank(above[parent].begin); });
        if (after == by_rank.begin()) continue;
        const FileAnnotation& around = above[*(after - 1)];
        // If its own times contradict the order, the times decide: around an unaligned parent the order is unreliable.
        const bool fits = !one.annotation.aligned || around.annotation.span.contains(own_span(one));
        if (fits && rank(one.end) <= rank(around.end)) parents_[i] = *(after - 1);
      }
    }
    for (const std::size_t i : by_rank) begins_[above[i].begin] = ends_[above[i].end] = kNone;
  }

  /// The span of an annotation whose slots both have times.
  TimeSpan own_span(const FileAnnotation& one) const {
    return {Milliseconds(*parts_.slots[one.begin].time), Milliseconds(*parts_.slots[one.end].time)};
  }

  void interpolate(const FileTier& tier) {
    const std::vector<FileAnnotation>& above = parts_.tiers[tier.parent].annotations;
    struct Use {
      std::size_t parent;
      std::size_t slot;
      bool operator==(const Use&) const = default;
    };
    std::vector<Use> uses;
    for (std::size_t i = 0; i < tier.annotations.size() && tier.annotations[i].has_slots(); ++i) {
      if (parents_[i] == kNone) continue;
      uses.push_back({parents_[i], tier.annotations[i].begin});
      uses.push_back({parents_[i], tier.annotations[i].end});
    }
    std::sort(uses.begin(), uses.end(), [&](const Use& a, const Use& b) {
      return a.parent != b.parent ? a.parent < b.parent : rank(a.slot) < rank(b.slot);
    });
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    std::vector<std::size_t> run;
    for (std::size_t i = 0; i < uses.size();) {
      const TimeSpan bounds = above[uses[i].parent].annotation.span;
      std::int64_t left = bounds.begin.count();
      const std::size_t parent = uses[i].parent;
      run.clear();
      for (; i < uses.size() && uses[i].parent == parent; ++i) {
        if (!times_[uses[i].slot]) {
          run.push_back(uses[i].slot);
          continue;
        }
        const std::int64_t right = *times_[uses[i].slot];
        spread(run, left, right);
        run.clear();
        left = right;
      }
      spread(run, left, bounds.end.count());
    }
  }

  void spread(const std::vector<std::size_t>& run, std::int64_t left, std::int64_t right) {
    const std::int64_t step = std::max<std::int64_t>(0, right - left) / static_cast<std::int64_t>(run.size() + 1);
    std::int64_t time = left;
    for (const std::size_t slot : run) times_[slot] = time += step;
  }

  /// Spreads the times of slots that are in no parent between their neighbours in TIME_ORDER.
  void spread_the_rest() {
    if (rest_is_spread_) return;
    rest_is_spread_ = true;
    rest_ = times_;
    std::vector<std::size_t> run;
    std::int64_t left = 0;
    const auto settle = [&](std::int64_t right) {
      const std::int64_t step = (right - left) / static_cast<std::int64_t>(run.size() + 1);
      std::int64_t time = left;
      for (const std::size_t slot : run) rest_[slot] = time += step;
      run.clear();
    };
    for (const std::size_t slot : order_) {
      if (!parts_.slots[slot].time) {
        run.push_back(slot);
        continue;
      }
      settle(*parts_.slots[slot].time);
      left = *parts_.slots[slot].time;
    }
    settle(left);
  }

  void set_spans(FileTier& tier) {
    std::size_t loose = 0;
    std::size_t clamped = 0;
    std::size_t sound = 0;  // number of sound ones so far
    for (std::size_t i = 0; i < tier.annotations.size(); ++i) {
      FileAnnotation& one = tier.annotations[i];
      const auto keep = [&] {
        if (sound != i) {
          parents_[sound] = parents_[i];
          tier.annotations[sound] = std::move(one);
        }
        ++sound;
      };
      if (!one.has_slots()) {
        keep();
        continue;
      }
      for (const std::size_t slot : {one.begin, one.end}) {
        if (times_[slot]) continue;
        spread_the_rest();
        times_[slot] = rest_[slot];
        ++loose;
      }
      const std::int64_t begin = *times_[one.begin];
      const std::int64_t end = *times_[one.end];
      if (begin > end && (one.annotation.aligned || rank(one.begin) > rank(one.end))) {
        const std::string what = fmt::format("annotation '{}' begins at {} ms, after its end at {} ms",
                                             printable(one.annotation.id), begin, end);
        leave_out(xml_, unsound_, parts_, tier, std::move(one), what, "swap its slots or correct a TIME_VALUE");
        continue;
      }
      if (begin > end) ++clamped;
      one.annotation.span = {Milliseconds(begin), Milliseconds(std::max(begin, end))};
      keep();
    }
    tier.annotations.resize(sound);
    parents_.resize(sound);
    if (loose > 0) {
      note(tier.element, fmt::format("tier '{}' has {} unaligned slots outside any parent: spread between their "
                                     "neighbours in TIME_ORDER",
                                     printable(tier.tier.id), loose));
    }
    if (clamped > 0) {
      note(tier.element, fmt::format("tier '{}' has {} annotations whose interpolated begin lies after their end: they "
                                     "have no length",
                                     printable(tier.tier.id), clamped));
    }
  }

  void find_parents_by_time(FileTier& tier) {
    const std::vector<FileAnnotation>& above = parts_.tiers[tier.parent].annotations;  // in time order
    for (std::size_t i = 0; i < tier.annotations.size() && tier.annotations[i].has_slots(); ++i) {
      FileAnnotation& one = tier.annotations[i];
      const TimeSpan span = one.annotation.span;
      if (parents_[i] == kNone) {
        // Annotations of a tier do not overlap, so only the few that end after this one's begin and begin before its
        // end can contain it.
        const auto first =
            std::lower_bound(above.begin(), above.end(), span.begin,
                             [](const FileAnnotation& a, Milliseconds time) { return a.annotation.span.end < time; });
        Milliseconds most{-1};
        constexpr std::ptrdiff_t kTried = 64;  // if annotations overlap, there may be very many
        for (auto at = first; at != above.end() && at - first < kTried && at->annotation.span.begin <= span.end; ++at) {
          const TimeSpan other = at->annotation.span;
          Milliseconds shared = std::min(span.end, other.end) - std::max(span.begin, other.begin);
          if (other.contains(span)) shared = Milliseconds(kLatest);
          if (shared <= most || (shared.count() == 0 && !other.contains(span))) continue;
          most = shared;
          parents_[i] = static_cast<std::size_t>(at - above.begin());
        }
      }
      if (parents_[i] == kNone) {
        note(one.element, fmt::format("annotation '{}' lies in no annotation of the parent tier '{}'",
                                      printable(one.annotation.id), printable(tier.tier.parent)));
        continue;
      }
      const FileAnnotation& parent = above[parents_[i]];
      one.annotation.parent = parent.annotation.id;
      if (!parent.annotation.span.contains(span)) {
        note(one.element, fmt::format("annotation '{}' reaches outside its parent '{}'", printable(one.annotation.id),
                                      printable(parent.annotation.id)));
      }
    }
  }

  /// Sets the spans of the annotations without slots.
  void divide_parents(FileTier& tier) {
    const auto first = std::find_if(tier.annotations.begin(), tier.annotations.end(),
                                    [](const FileAnnotation& one) { return !one.has_slots(); });
    if (first == tier.annotations.end()) return;
    const std::vector<FileAnnotation>& above = parts_.tiers[tier.parent].annotations;
    Ids parent_of;
    parent_of.reserve(above.size());
    for (std::size_t i = 0; i < above.size(); ++i) parent_of.add(above[i].annotation.id, i);
    const auto parent = [&](const FileAnnotation& one) { return parent_of.find(one.annotation.parent); };
    sort_unless_sorted(first, tier.annotations.end(),
                       [&](const FileAnnotation& a, const FileAnnotation& b) { return parent(a) < parent(b); });
    for (auto begin = first; begin != tier.annotations.end();) {
      auto end = begin;
      while (end != tier.annotations.end() && end->annotation.parent == begin->annotation.parent) ++end;
      follow_chain(begin, end);
      const TimeSpan span = above[parent(*begin)].annotation.span;
      const auto count = static_cast<std::size_t>(end - begin);
      const double part = static_cast<double>(span.duration().count()) / static_cast<double>(count);
      const auto bound = [&](std::size_t i) {
        return i == count ? span.end
                          : span.begin + Milliseconds(static_cast<std::int64_t>(static_cast<double>(i) * part));
      };
      for (std::size_t i = 0; i < count; ++i, ++begin) {
        const bool whole = tier.stereotype == Stereotype::symbolic_association;
        begin->annotation.span = whole ? span : TimeSpan{bound(i), bound(i + 1)};
      }
    }
  }

  using AnnotationIterator = std::vector<FileAnnotation>::iterator;

  /// Sorts the children of one parent by their PREVIOUS_ANNOTATION; those outside the chain stay in file order.
  void follow_chain(AnnotationIterator begin, AnnotationIterator end) {
    const auto count = static_cast<std::size_t>(end - begin);
    if (count == 1 && begin->previous.empty()) return;
    std::unordered_map<std::string_view, std::size_t> places;
    for (std::size_t i = 0; i < count; ++i) places.emplace(begin[static_cast<std::ptrdiff_t>(i)].annotation.id, i);
    std::vector<std::size_t> next(count, kNone);
    std::vector<bool> follows(count, false);
    bool broken = false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view previous = begin[static_cast<std::ptrdiff_t>(i)].previous;
      if (previous.empty()) continue;
      const auto before = places.find(previous);
      if (before == places.end() || next[before->second] != kNone || before->second == i) {
        broken = true;
        continue;
      }
      next[before->second] = i;
      follows[i] = true;
    }
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t at = follows[i] ? kNone : i; at != kNone; at = next[at]) order.push_back(at);
    }
    if (order.size() != count) {  // the rest is a cycle
      broken = true;
      std::vector<bool> placed(count, false);
      for (const std::size_t at : order) placed[at] = true;
      for (std::size_t i = 0; i < count; ++i) {
        if (!placed[i]) order.push_back(i);
      }
    }
    if (broken) {
      note(begin->element, fmt::format("the PREVIOUS_ANNOTATIONs under annotation '{}' make no chain: what does not "
                                       "fit is in file order",
                                       printable(begin->annotation.parent)));
    }
    if (std::is_sorted(order.begin(), order.end())) return;
    std::vector<FileAnnotation> sorted;
    sorted.reserve(count);
    for (const std::size_t at : order) sorted.push_back(std::move(begin[static_cast<std::ptrdiff_t>(at)]));
    std::move(sorted.begin(), sorted.end(), begin);
  }

  void sort_by_time(FileTier& tier) {
    sort_unless_sorted(tier.annotations.begin(), tier.annotations.end(),
                       [](const FileAnnotation& a, const FileAnnotation& b) {
                         const TimeSpan x = a.annotation.span;
                         const TimeSpan y = b.annotation.span;
                         return x.begin != y.begin ? x.begin < y.begin : x.end < y.end;
                       });
  }

  void report(const FileTier& tier) {
    const FileAnnotation* last = nullptr;
    for (const FileAnnotation& one : tier.annotations) {
      const TimeSpan span = one.annotation.span;
      if (one.annotation.aligned && span.begin == span.end) {
        note(one.element, fmt::format("annotation '{}' has no length: both its slots are at {} ms",
                                      printable(one.annotation.id), span.begin.count()));
      }
      if (last != nullptr && span.begin < last->annotation.span.end) {
        note(one.element, fmt::format("annotation '{}' overlaps '{}' on the same tier", printable(one.annotation.id),
                                      printable(last->annotation.id)));
      }
      if (last == nullptr || span.end > last->annotation.span.end) last = &one;
    }
  }

  void note(pugi::xml_node node, std::string_view what) { parts_.notices.push_back(xml_.notice(node, what)); }

  const Xml& xml_;
  Unsound unsound_;
  FileParts& parts_;
  std::vector<std::optional<std::int64_t>> times_;  ///< [slot]
  std::vector<std::optional<std::int64_t>> rest_;   ///< [slot], see spread_the_rest
  bool rest_is_spread_ = false;
  std::vector<std::size_t> begins_;   ///< [slot] the parent that begins there, for the tier being processed
  std::vector<std::size_t> ends_;     ///< [slot] the parent that ends there
  std::vector<std::size_t> order_;    ///< slots by rank
  std::vector<std::size_t> parents_;  ///< [annotation of the current tier], an index into the parent tier
};

}  // namespace

void settle_times(const Xml& xml, Unsound unsound, FileParts& parts, const std::vector<std::size_t>& tier_order) {
  Settler(xml, unsound, parts).run(tier_order);
}

}  // namespace signweave::eaf
