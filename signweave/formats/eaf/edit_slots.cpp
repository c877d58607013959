#include "signweave/formats/eaf/edit_slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <tuple>

namespace signweave::eaf {
namespace {

class SlotEditor {
 public:
  SlotEditor(const FileParts& old, const CheckedDocument& checked, const Known& known)
      : old_(old), checked_(checked), known_(known) {}

  EditedSlots run() {
    for (std::size_t i = 0; i < old_.slots.size(); ++i) {
      result_.slots.push_back({std::string(old_.slots[i].id), i, old_.slots[i].time});
    }
    const std::vector<Tier>& tiers = checked_.document.tiers;
    result_.ends.resize(tiers.size());
    for (std::size_t t = 0; t < tiers.size(); ++t) result_.ends[t].resize(tiers[t].annotations.size());
    for (const std::size_t t : checked_.tier_order) {
      assign(t);
    }
    settle_times();
    sort();
    return std::move(result_);
  }

 private:
  using Ends = EditedSlots::Ends;
  enum class Side { begin, end };

  struct User {
    std::size_t tier;
    std::size_t place;
    Side side;
  };

  const Annotation& at(std::size_t tier, std::size_t place) const {
    return checked_.document.tiers[tier].annotations[place];
  }

  std::size_t make(std::optional<std::int64_t> time) {
    result_.slots.push_back({{}, kNone, time});
    return result_.slots.size() - 1;
  }

  void assign(std::size_t t) {
    const std::vector<Annotation>& annotations = checked_.document.tiers[t].annotations;
    const bool shares = checked_.stereotypes[t] == Stereotype::time_subdivision;
    std::vector<Ends>& ends = result_.ends[t];
    for (std::size_t i = 0; i < annotations.size(); ++i) {
      const FileAnnotation* was = known_.annotations[t][i];
      if (known_.with_slots[t][i] && was != nullptr && was->has_slots()) ends[i] = {was->begin, was->end};
    }
    for (std::size_t i = 0; i < annotations.size(); ++i) {
      if (!known_.with_slots[t][i]) continue;
      const Annotation& one = annotations[i];
      if (ends[i].begin == kNone && shares) {
        const std::size_t parent = checked_.parent_annotations[t][i];
        if (parent != kNone) {
          const Annotation& above = at(checked_.parents[t], parent);
          const Ends outer = result_.ends[checked_.parents[t]][parent];
          if (above.span.begin == one.span.begin) ends[i].begin = outer.begin;
          if (above.span.end == one.span.end) ends[i].end = outer.end;
        }
        const auto joins = [&](std::size_t a, std::size_t b) {
          return annotations[a].parent == annotations[b].parent && annotations[a].span.end == annotations[b].span.begin;
        };
        if (ends[i].begin == kNone && i > 0 && joins(i - 1, i)) ends[i].begin = ends[i - 1].end;
        if (ends[i].end == kNone && i + 1 < annotations.size() && joins(i, i + 1)) ends[i].end = ends[i + 1].begin;
      }
      if (ends[i].begin == kNone) ends[i].begin = make(one.span.begin.count());
      if (ends[i].end == kNone) ends[i].end = make(one.span.end.count());
    }
  }

  /// [old slot] whether an annotation that was left out uses it: it stays, with its time.
  std::vector<bool> held_slots() const {
    std::vector<bool> held(old_.slots.size(), false);
    for (const FileTier& tier : old_.tiers) {
      for (const FileAnnotation& one : tier.left_out) {
        for (const std::size_t slot : {one.begin, one.end}) {
          if (slot < held.size()) held[slot] = true;
        }
      }
    }
    return held;
  }

  /// The time that an annotation requires for one of its slots; nullopt if any will do.
  std::optional<std::int64_t> wanted(const User& user, std::size_t slot) const {
    const Annotation& one = at(user.tier, user.place);
    const FileAnnotation* was = known_.annotations[user.tier][user.place];
    const bool begin = user.side == Side::begin;
    const std::int64_t time = (begin ? one.span.begin : one.span.end).count();
    if (was == nullptr || !was->has_slots() || one.aligned) return time;
    // An annotation without times of its own follows its parent and neighbours, unless it was itself moved.
    if (!result_.slots[slot].time) return std::nullopt;
    const TimeSpan before = was->annotation.span;
    if ((begin ? before.begin : before.end).count() == time) return std::nullopt;
    return time;
  }

  void settle_times() {
    std::vector<std::vector<User>> users(result_.slots.size());
    for (std::size_t t = 0; t < result_.ends.size(); ++t) {
      for (std::size_t i = 0; i < result_.ends[t].size(); ++i) {
        if (result_.ends[t][i].begin == kNone) continue;
        users[result_.ends[t][i].begin].push_back({t, i, Side::begin});
        users[result_.ends[t][i].end].push_back({t, i, Side::end});
      }
    }
    const std::vector<bool> held = held_slots();
    for (std::size_t slot = 0; slot < users.size(); ++slot) {
      std::map<std::int64_t, std::vector<User>> by_time;
      for (const User& user : users[slot]) {
        if (const std::optional<std::int64_t> time = wanted(user, slot)) by_time[*time].push_back(user);
      }
      if (by_time.empty()) continue;
      const std::optional<std::int64_t> now = result_.slots[slot].time;
      const bool is_wanted = now && (by_time.contains(*now) || (slot < held.size() && held[slot]));
      const std::int64_t stays = is_wanted ? *now : by_time.begin()->first;
      result_.slots[slot].time = stays;
      for (const auto& [time, wanting] : by_time) {
        if (time == stays) continue;
        const std::size_t fresh = make(time);
        for (const User& user : wanting) {
          Ends& ends = result_.ends[user.tier][user.place];
          (user.side == Side::begin ? ends.begin : ends.end) = fresh;
        }
      }
    }
  }

  /// The sort position of a slot: its time (or that of the aligned slot before it), then its position among equals.
  struct Key {
    std::int64_t reached;
    std::size_t place;
    std::vector<std::size_t> after;  ///< for an unaligned slot that moves with another: its offset after that one
    bool operator<(const Key& other) const {
      return std::tie(reached, place, after) < std::tie(other.reached, other.place, other.after);
    }
  };

  void sort() {
    const std::size_t count = result_.slots.size();
    std::vector<bool> used_before(old_.slots.size(), false);
    for (const FileTier& tier : old_.tiers) {
      for (const FileAnnotation& one : tier.annotations) {
        if (one.has_slots()) used_before[one.begin] = used_before[one.end] = true;
      }
    }
    std::vector<bool> used(count, false);
    for (const std::vector<Ends>& tier : result_.ends) {
      for (const Ends& ends : tier) {
        if (ends.begin != kNone) used[ends.begin] = used[ends.end] = true;
      }
    }
    const std::vector<bool> held = held_slots();
    for (std::size_t slot = 0; slot < held.size(); ++slot) used[slot] = used[slot] || held[slot];
    for (std::size_t slot = 0; slot < count; ++slot) {
      const std::size_t was = result_.slots[slot].old;
      if (used[slot] || (was != kNone && !used_before[was])) result_.order.push_back(slot);
    }
    name_new_slots();
    for (std::size_t i = 0; i < old_.slots.size(); ++i) {
      if (old_.slots[i].rank != i) return;  // it was not sorted: new slots stay at the end
    }
    const std::vector<Key> keys = sort_keys();
    std::sort(result_.order.begin(), result_.order.end(),
              [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  }

  /// New slots, and old ones whose new time does not fit between their neighbours.
  std::vector<bool> slots_to_move() const {
    const std::size_t count = result_.slots.size();
    std::vector<std::int64_t> next(count, kLatest);  // the next unchanged time after the slot
    for (std::size_t slot = old_.slots.size(); slot-- > 1;) {
      const std::optional<std::int64_t> time = old_.slots[slot].time;
      next[slot - 1] = time && time == result_.slots[slot].time ? *time : next[slot];
    }
    std::vector<bool> moved(count, true);
    std::int64_t latest = -1;
    for (std::size_t slot = 0; slot < old_.slots.size(); ++slot) {
      const std::optional<std::int64_t> time = result_.slots[slot].time;
      moved[slot] = time != old_.slots[slot].time && (*time < latest || *time > next[slot]);
      if (!moved[slot] && time) latest = std::max(latest, *time);
    }
    return moved;
  }

  std::vector<Key> sort_keys() const {
    std::vector<bool> moved = slots_to_move();
    std::vector<Key> keys;
    std::int64_t latest = -1;
    for (std::size_t slot = 0; slot < result_.slots.size(); ++slot) {
      const std::optional<std::int64_t> time = result_.slots[slot].time;
      if (!moved[slot] && time) latest = std::max(latest, *time);
      keys.push_back({moved[slot] && time ? *time : latest, slot, {}});
    }
    for (const std::size_t t : checked_.tier_order) {
      if (checked_.parents[t] == kNone) continue;
      std::size_t parent = kNone;
      std::size_t anchor = kNone;
      std::size_t after = 0;
      for (std::size_t i = 0; i < result_.ends[t].size(); ++i) {
        const std::size_t above = checked_.parent_annotations[t][i];
        if (above == kNone || result_.ends[t][i].begin == kNone) continue;
        if (above != parent) {
          parent = above;
          anchor = result_.ends[checked_.parents[t]][above].begin;
          after = 0;
        }
        for (const std::size_t slot : {result_.ends[t][i].begin, result_.ends[t][i].end}) {
          if (slot == anchor || anchor == kNone) continue;
          if (result_.slots[slot].time || slot == result_.ends[checked_.parents[t]][above].end) {
            anchor = slot;
            after = 0;
          } else if (moved[anchor] && !moved[slot]) {
            keys[slot] = keys[anchor];
            keys[slot].after.push_back(++after);
            moved[slot] = true;
          }
        }
      }
    }
    return keys;
  }

  void name_new_slots() {
    std::uint64_t last = 0;
    for (const Slot& slot : old_.slots) {
      std::uint64_t number = 0;
      if (slot.id.size() < 3 || slot.id.size() > 18 || !slot.id.starts_with("ts")) continue;
      const auto [end, error] = std::from_chars(slot.id.data() + 2, slot.id.data() + slot.id.size(), number);
      if (error == std::errc() && end == slot.id.data() + slot.id.size()) last = std::max(last, number);
    }
    for (const std::size_t slot : result_.order) {
      if (result_.slots[slot].old == kNone) result_.slots[slot].id = fmt::format("ts{}", ++last);
    }
  }

  const FileParts& old_;
  const CheckedDocument& checked_;
  const Known& known_;
  EditedSlots result_;
};

}  // namespace

EditedSlots edit_slots(const FileParts& old, const CheckedDocument& checked, const Known& known) {
  return SlotEditor(old, checked, known).run();
}

}  // namespace signweave::eaf
