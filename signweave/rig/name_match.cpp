#include "signweave/rig/name_match.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "signweave/core/text.h"
#include "signweave/rig/conventions.h"

namespace signweave {
namespace {

bool separates(char c) {
  return c == '_' || c == '.' || c == '-' || c == ' ';
}

std::string plain(std::string_view name) {
  std::string text = fold_case(name);
  std::erase_if(text, separates);
  return text;
}

/// The longest prefix ending in a separator that most names share; a side's letter does not count.
std::string shared_prefix(const std::vector<std::string>& names) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& name : names) {
    for (std::size_t i = 1; i + 1 < std::min<std::size_t>(name.size(), 40); ++i) {
      if (separates(name[i])) ++counts[name.substr(0, i + 1)];
    }
  }
  std::string best;
  for (const auto& [prefix, count] : counts) {
    if (10 * count >= 7 * names.size() && count > 2 && prefix.size() > best.size()) best = prefix;
  }
  return best;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> list;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) list.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return list;
}

std::string with(std::string_view pattern, char mark, std::string_view word) {
  std::string text;
  for (const char c : pattern) {
    if (c == mark) {
      text.append(word);
    } else {
      text.push_back(c);
    }
  }
  return text;
}

struct Meaning {
  Part part;
  std::size_t rank;  ///< 0 is the best of the part's names
};
using Table = std::unordered_map<std::string, Meaning>;

void add_fingers(const FingerNames& names, Side side, std::string_view word, Table& table) {
  const std::vector<std::string_view> fingers = words(names.fingers);
  const bool numbered = names.pattern.find('#') != std::string_view::npos;
  for (const Finger finger : kFingers) {
    const std::string_view called = fingers[static_cast<std::size_t>(finger)];
    if (called == "-") continue;
    const std::string begun = with(with(names.pattern, '@', word), '%', called);
    const std::vector<std::string_view> points = words(names.points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i] == "-") continue;
      const Part part = finger_part(side, finger, static_cast<FingerPoint>(i));
      table.try_emplace(plain(numbered ? with(begun, '#', points[i]) : begun), Meaning{part, 0});
    }
  }
}

Table table_of(const Convention& convention) {
  Table table;
  const std::vector<std::string_view> lefts = words(convention.left);
  const std::vector<std::string_view> rights = words(convention.right);
  for (std::size_t i = 0; i < lefts.size(); ++i) {
    for (const Side side : kSides) {
      const std::string_view word = side == Side::left ? lefts[i] : rights[i];
      for (const NameRow& row : convention.rows) {
        const std::vector<std::string_view> list = words(row.names);
        for (std::size_t rank = 0; rank < list.size(); ++rank) {
          const bool sided = list[rank].find('@') != std::string_view::npos;
          table.try_emplace(plain(with(list[rank], '@', word)), Meaning{sided ? of(side, row.part) : row.part, rank});
        }
      }
      for (const FingerNames& names : convention.fingers) add_fingers(names, side, word, table);
    }
  }
  return table;
}

const std::vector<Table>& tables() {
  static const std::vector<Table> all = [] {
    std::vector<Table> list;
    for (const Convention& convention : conventions()) list.push_back(table_of(convention));
    return list;
  }();
  return all;
}

NameMatch match(const Table& table, const std::vector<std::string>& names) {
  NameMatch found;
  found.joints.fill(kNoJoint);
  std::array<std::size_t, kPartCount> ranks{};
  for (std::size_t joint = 0; joint < names.size(); ++joint) {
    const auto entry = table.find(names[joint]);
    if (entry == table.end()) continue;
    const auto part = static_cast<std::size_t>(entry->second.part);
    const std::size_t rank = entry->second.rank;
    if (found.joints[part] != kNoJoint && rank >= ranks[part]) {
      const bool same = names[static_cast<std::size_t>(found.joints[part])] == names[joint];
      if (same) found.ambiguous.push_back(entry->second.part);
      continue;
    }
    found.joints[part] = static_cast<JointIndex>(joint);
    ranks[part] = rank;
  }
  return found;
}

bool marked(const Convention& convention, const Skeleton& skeleton) {
  const std::vector<std::string_view> marks = words(convention.marks);
  return std::any_of(skeleton.joints().begin(), skeleton.joints().end(), [&](const Joint& joint) {
    const std::string name = fold_case(joint.name);
    return std::any_of(marks.begin(), marks.end(),
                       [&](std::string_view mark) { return name.find(mark) != std::string::npos; });
  });
}

}  // namespace

std::vector<std::string> plain_names(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints()) {
    const std::size_t colon = joint.name.rfind(':');
    names.push_back(colon == std::string::npos ? joint.name : joint.name.substr(colon + 1));
  }
  const std::string prefix = shared_prefix(names);
  for (std::string& name : names) {
    if (name.starts_with(prefix)) name.erase(0, prefix.size());
    name = plain(name);
  }
  return names;
}

NameMatch match_names(const Skeleton& skeleton) {
  const std::vector<std::string> names = plain_names(skeleton);
  NameMatch best;
  best.joints.fill(kNoJoint);
  std::size_t best_score = 0;
  std::vector<NameMatch> all;
  for (std::size_t i = 0; i < conventions().size(); ++i) {
    const Convention& convention = conventions()[i];
    all.push_back(match(tables()[i], names));
    const bool needs_mark = !convention.marks.empty();
    if (needs_mark && !marked(convention, skeleton)) continue;
    const auto count = [&](auto begin, auto end) {
      return static_cast<std::size_t>(std::count_if(begin, end, [](JointIndex joint) { return joint != kNoJoint; }));
    };
    // A limb counts more than a finger, of which there are many.
    const auto fingers = all[i].joints.begin() + static_cast<std::ptrdiff_t>(kNamedParts);
    const std::size_t score = 4 * count(all[i].joints.begin(), fingers) + count(fingers, all[i].joints.end()) +
                              (needs_mark && best_score > 0 ? 1 : 0);
    if (score <= best_score) continue;
    best_score = score;
    best = all[i];
    best.convention = convention.name;
  }
  // "Hips", "Spine" and "Head" alone occur in many tables.
  if (best_score < 4 * 5) best.convention.clear();
  // Another table may name a part that the best table lacks, as long as no joint plays two parts.
  std::vector<bool> used(names.size());
  for (const JointIndex joint : best.joints) {
    if (joint != kNoJoint) used[static_cast<std::size_t>(joint)] = true;
  }
  for (const NameMatch& other : all) {
    for (std::size_t part = 0; part < kPartCount; ++part) {
      const JointIndex joint = other.joints[part];
      if (best.joints[part] != kNoJoint || joint == kNoJoint || used[static_cast<std::size_t>(joint)]) continue;
      best.joints[part] = joint;
      used[static_cast<std::size_t>(joint)] = true;
    }
  }
  return best;
}

}  // namespace signweave
