#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "signweave/notation/utterance.h"
#include "signweave/notation/utterance_space.h"
#include "signweave/notation/utterance_word.h"

namespace signweave {
namespace utterances {
namespace {

/// True if a word is read as one of an expression's name.
bool is_expression_word(std::string_view word, bool first) {
  constexpr std::array<std::string_view, 7> kReserved = {"dominant", "weak", "right", "left",
                                                         "fingers",  "gaze", "mouth"};
  return !word.empty() && word.find_first_of("[]{};:\"") == word.npos && !word.starts_with("..") &&
         word.find_first_of("@+-") != 0 && word != "hold" &&
         !(first && std::ranges::find(kReserved, word) != kReserved.end());
}

}  // namespace

std::string expression_text(const std::string& name) {
  if (is_space_option(name)) return in_quotes(name);
  std::string_view rest = name;
  for (bool first = true;; first = false) {
    const std::size_t blank = std::min(rest.find(' '), rest.size());
    const std::string_view word = rest.substr(0, blank);
    if (!is_expression_word(word, first) || std::ranges::any_of(word, is_blank)) return in_quotes(name);
    if (blank == rest.size()) return name;
    rest.remove_prefix(blank + 1);
  }
}

}  // namespace utterances

namespace {

using namespace utterances;

std::string sign_text(const SignRef& sign, bool inside) {
  const std::string& name = sign.kind == SignRef::Kind::gloss ? sign.gloss.gloss : sign.recording;
  const std::string text = inside ? quoted_if_needed_inside(name) : quoted_if_needed(name);
  if (sign.kind == SignRef::Kind::piece)
    return fmt::format("{}@{}..{}", text, sign.span.begin.count(), sign.span.end.count());
  return sign.gloss.token > 0 ? fmt::format("{}#{}", text, sign.gloss.token) : text;
}

std::string signs_text(const std::vector<PartSign>& signs) {
  std::string text;
  for (const PartSign& one : signs) {
    text += (text.empty() ? "" : " ") + (one.rest ? "rest" : sign_text(one.sign, true));
    for (const SyncMark& mark : one.sync) {
      text += mark.anchor == SyncMark::Anchor::begin ? " @begin" : " @end";
      if (mark.offset != Milliseconds(0)) text += fmt::format("{:+}", mark.offset.count());
    }
  }
  return text;
}

std::string non_manual_text(const NonManual& one, std::string_view extent) {
  std::string text;
  if (one.kind == NonManual::Kind::expression) {
    text = expression_text(one.what);
  } else if (one.kind == NonManual::Kind::mouthing) {
    text = "mouth " + in_quotes(one.what);
  } else {
    const bool bare = one.what.find_first_of("[]{};:\"") == one.what.npos && std::ranges::none_of(one.what, is_blank);
    text = "gaze @" + (bare ? one.what : in_quotes(one.what));
  }
  text += extent;
  if (one.begin != Milliseconds(0) || one.end != Milliseconds(0)) text += fmt::format(" {:+}", one.begin.count());
  if (one.end != Milliseconds(0)) text += fmt::format(" {:+}", one.end.count());
  return text;
}

/// "" if something lasts as long as its place, otherwise " ..+2".
std::string extent_text(std::size_t places_on) {
  return places_on == 0 ? std::string() : fmt::format(" ..+{}", places_on);
}

bool is_fingers(BodyPart part) {
  return part >= BodyPart::dominant_fingers && part <= BodyPart::left_fingers;
}

/// How the parts and non-manuals of an utterance are written.
class UtterancePrinter {
 public:
  explicit UtterancePrinter(const Utterance& utterance) : utterance_(utterance), layout_(utterance.places.size()) {}
  std::string print();

 private:
  struct PlaceLayout {
    std::size_t bracket_first = 0;
    std::size_t bracket_end = 0;                     ///< of the bracket that the place is in; 0: none
    std::size_t bracket_parts = 0;                   ///< the number of last parts in the bracket that begins here
    std::vector<std::span<const NonManual>> scopes;  ///< that begin here, the outer one first
    std::size_t scopes_ended = 0;                    ///< those that end here
    std::vector<const NonManual*> non_manuals;       ///< written as options
    std::vector<const HandHold*> holds;              ///< that begin here
    std::vector<const LocusSetup*> loci;             ///< that are set up here
  };
  void plan_brackets();
  void plan_scopes();
  bool crosses_bracket(const NonManual& one) const;
  std::string options_text(std::size_t place) const;
  void open(std::size_t place);
  void close(std::size_t place);

  const Utterance& utterance_;
  std::vector<PlaceLayout> layout_;
  std::string text_;
  std::size_t open_ = 0;  ///< scopes and brackets
};

/// A bracket begins with each place whose last parts last equally long, outside other brackets.
void UtterancePrinter::plan_brackets() {
  for (std::size_t i = 0; i < layout_.size();) {
    const std::vector<PlacePart>& parts = utterance_.places[i].parts;
    std::size_t& taken = layout_[i].bracket_parts;
    const std::size_t length = parts.empty() ? 1 : std::min(parts.back().places, layout_.size() - i);
    while (taken < parts.size()) {
      const PlacePart& part = parts[parts.size() - 1 - taken];
      if (part.places != parts.back().places || (part.places == 1 && is_fingers(part.part))) break;
      ++taken;
    }
    const std::size_t end = i + (taken > 0 ? length : 1);
    for (std::size_t k = i; taken > 0 && k < end; ++k) {
      layout_[k].bracket_first = i;
      layout_[k].bracket_end = end;
    }
    i = end;
  }
}

bool UtterancePrinter::crosses_bracket(const NonManual& one) const {
  const PlaceLayout& first = layout_[one.first];
  const PlaceLayout& last = layout_[one.last];
  if (first.bracket_end > 0 && first.bracket_first < one.first && one.last >= first.bracket_end) return true;
  return last.bracket_end > 0 && one.first < last.bracket_first && one.last + 1 < last.bracket_end;
}

/// Scopes are the non-manuals over several places that lie inside each other and inside or around brackets.
void UtterancePrinter::plan_scopes() {
  std::vector<std::size_t> open;  // the last places of scopes
  const std::vector<NonManual>& all = utterance_.non_manuals;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t next = i + 1;
    while (next < all.size() && all[next].first == all[i].first && all[next].last == all[i].last) ++next;
    const std::span<const NonManual> same(&all[i], next - i);
    while (!open.empty() && open.back() < all[i].first) open.pop_back();
    const bool fits = (open.empty() || open.back() >= all[i].last) && open.size() + 1 < kMostUtteranceDepth &&
                      !crosses_bracket(all[i]);
    if (all[i].first < all[i].last && fits) {
      open.push_back(all[i].last);
      layout_[all[i].first].scopes.push_back(same);
      ++layout_[all[i].last].scopes_ended;
    } else {
      for (const NonManual& one : same) layout_[one.first].non_manuals.push_back(&one);
    }
    i = next;
  }
}

std::string UtterancePrinter::options_text(std::size_t place) const {
  const PlaceLayout& layout = layout_[place];
  const std::vector<PlacePart>& parts = utterance_.places[place].parts;
  std::string text;
  const auto add = [&](const std::string& option) { text += (text.empty() ? "" : "; ") + option; };
  for (std::size_t k = 0; k + layout.bracket_parts < parts.size(); ++k) {
    add(fmt::format("{}{}: {}", name_of(parts[k].part), extent_text(parts[k].places - 1), signs_text(parts[k].signs)));
  }
  if (const auto side = utterance_.places[place].dominant)
    add(*side == Side::left ? "dominant left" : "dominant right");
  for (const LocusSetup* locus : layout.loci) add(setup_text(*locus));
  for (const std::string& change : space_texts(utterance_.places[place].space)) add(change);
  for (const HandHold* hold : layout.holds)
    add(fmt::format("{} hold{}", name_of(hold->hand), extent_text(hold->until - hold->from)));
  for (const NonManual* one : layout.non_manuals) add(non_manual_text(*one, extent_text(one->last - one->first)));
  return text.empty() ? text : '{' + text + '}';
}

/// Writes what begins with a place: longer things first.
void UtterancePrinter::open(std::size_t place) {
  const PlaceLayout& layout = layout_[place];
  bool bracket = layout.bracket_end > 0 && layout.bracket_first == place;
  const auto open_bracket = [&] {
    text_ += '[';
    ++open_;
    bracket = false;
  };
  for (const std::span<const NonManual> scope : layout.scopes) {
    if (bracket && scope.front().last + 1 < layout.bracket_end) open_bracket();
    std::string options;
    for (const NonManual& one : scope) options += (options.empty() ? "" : "; ") + non_manual_text(one, "");
    text_ += '{' + options + ": ";
    ++open_;
  }
  if (bracket) open_bracket();
}

/// Writes what ends with a place: scopes inside a bracket, the bracket, scopes around it.
void UtterancePrinter::close(std::size_t place) {
  const PlaceLayout& layout = layout_[place];
  const bool bracket = layout.bracket_end == place + 1;
  std::size_t inside = 0;  // scopes that end here and begin in the bracket behind its first place or with it
  for (std::size_t k = layout.bracket_first; bracket && k <= place; ++k) {
    for (const std::span<const NonManual> scope : layout_[k].scopes) {
      if (scope.front().last == place && k > layout.bracket_first) ++inside;
    }
  }
  text_ += std::string(bracket ? inside : layout.scopes_ended, '}');
  open_ -= layout.scopes_ended + (bracket ? 1 : 0);
  if (!bracket) return;
  const std::vector<PlacePart>& parts = utterance_.places[layout.bracket_first].parts;
  for (const PlacePart& part : std::span(parts).last(layout_[layout.bracket_first].bracket_parts))
    text_ += fmt::format(" | {}: {}", name_of(part.part), signs_text(part.signs));
  text_ += ']' + std::string(layout.scopes_ended - inside, '}');
}

std::string UtterancePrinter::print() {
  plan_brackets();
  plan_scopes();
  for (const HandHold& hold : utterance_.holds) {
    if (hold.from != kPlaceBefore) layout_[hold.from].holds.push_back(&hold);
  }
  for (const LocusSetup& locus : utterance_.loci) layout_[locus.from].loci.push_back(&locus);
  for (std::size_t i = 0; i < layout_.size(); ++i) {
    const Place& place = utterance_.places[i];
    if (i > 0) text_ += ' ';
    if (place.pause_before > Milliseconds(0)) text_ += place.pause_before > kComma ? ". " : ", ";
    open(i);
    text_ += sign_text(place, open_ > 0);
    text_ += options_text(i);
    close(i);
  }
  return std::move(text_);
}

}  // namespace

std::string to_string(const SpaceChange& change) {
  std::string text;
  for (const std::string& option : utterances::space_texts(change)) text += (text.empty() ? "" : "; ") + option;
  return text;
}

std::string to_string(const GlossRef& gloss) {
  std::string text = quoted_if_needed(gloss.gloss);
  if (gloss.token > 0) text += fmt::format("#{}", gloss.token);
  return text;
}

std::string to_string(const Utterance& utterance) {
  return UtterancePrinter(utterance).print();
}

}  // namespace signweave
