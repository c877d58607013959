#include "signweave/annotation/sign.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "signweave/annotation/tier_name.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Describes what is wrong with a sign's phases; empty if they fill it in order.
std::string faults_of(const Sign& sign) {
  std::string faults;
  const auto add = [&](const std::string& fault) { faults += faults.empty() ? fault : "; " + fault; };
  Milliseconds reached = sign.span.begin;
  bool stroke_seen = false;
  bool retraction_seen = false;
  for (const Phase& phase : sign.phases) {
    const std::string name = printable(phase.label);
    if (!sign.span.contains(phase.span)) add(fmt::format("phase '{}' extends outside it", name));
    if (phase.span.begin > reached) {
      add(fmt::format("a gap of {} ms at {} ms", (phase.span.begin - reached).count(), reached.count()));
    }
    if (phase.span.begin < reached && &phase != &sign.phases.front()) {
      add(fmt::format("phase '{}' overlaps the previous one by {} ms", name,
                      (std::min(reached, phase.span.end) - phase.span.begin).count()));
    }
    reached = std::max(reached, phase.span.end);
    if (phase.kind == PhaseKind::stroke) {
      if (retraction_seen) add(fmt::format("stroke '{}' comes after a retraction", name));
      stroke_seen = true;
    }
    if (phase.kind == PhaseKind::preparation && (stroke_seen || retraction_seen)) {
      add(fmt::format("preparation '{}' comes after a {}", name, stroke_seen ? "stroke" : "retraction"));
    }
    retraction_seen = retraction_seen || phase.kind == PhaseKind::retraction;
  }
  if (reached < sign.span.end) {
    add(fmt::format("a gap of {} ms at {} ms", (sign.span.end - reached).count(), reached.count()));
  }
  if (!stroke_seen) add("no stroke, so it is never a candidate");
  return faults;
}

class Collector {
 public:
  Collector(const AnnotationDocument& document, const TierNames& names) : document_(document), names_(names) {
    for (const Tier& tier : document.tiers) tiers_.emplace(tier.id, &tier);
  }

  SignsFound run() {
    for (const TierNames::SignTier& tier : names_.sign_tiers) collect_signs(tier);
    std::set<std::string_view> done;
    for (const std::string& id : names_.phase_tiers) {
      const Tier& tier = find(id);
      if (done.insert(tier.id).second) collect_phases(tier);
    }
    for (const auto& [label, count] : unknown_) {
      note("", fmt::format("{} phases have the unknown label '{}': stored as other; map the label to a kind of phase",
                           count, printable(label)));
    }
    for (Sign& sign : found_.signs) finish(sign);
    return std::move(found_);
  }

 private:
  /// The signs of one tier: [begin, end) of `found_.signs`, in time order.
  struct SignRow {
    const Tier* tier;
    Hand hand;
    std::string signer;
    std::size_t begin;
    std::size_t end;
  };

  const Tier& find(const std::string& id) const {
    const auto tier = tiers_.find(id);
    if (tier != tiers_.end()) return *tier->second;
    std::vector<std::string> known;
    for (const Tier& one : document_.tiers) known.push_back(one.id);
    throw Error(ErrorCode::not_found, fmt::format("the annotation has no tier '{}'; name one that it has{}",
                                                  printable(id), did_you_mean(id, known)));
  }

  void note(std::string_view tier, std::string text) { found_.notices.push_back({std::string(tier), std::move(text)}); }

  void collect_signs(const TierNames::SignTier& given) {
    const Tier& tier = find(given.id);
    if (rows_.contains(&tier)) return;  // named twice
    const std::string& signer = given.signer.empty() ? tier.participant : given.signer;
    const std::size_t begin = found_.signs.size();
    for (const Annotation& one : tier.annotations) {
      std::size_t place = kNone;
      if (!match_form(one.label).empty()) {
        place = found_.signs.size();
        found_.signs.push_back({.gloss = one.label,
                                .span = one.span,
                                .phases = {},
                                .hand = given.hand,
                                .signer = signer,
                                .tier = tier.id,
                                .annotation = one.id});
      }
      sign_of_.emplace(one.id, place);
    }
    rows_.emplace(&tier, order_.size());
    order_.push_back({&tier, given.hand, signer, begin, found_.signs.size()});
  }

  void collect_phases(const Tier& tier) {
    const SignRow* above = nullptr;
    std::size_t levels = 0;
    std::vector<const Tier*> path{&tier};
    for (const Tier* at = &tier; above == nullptr && levels < document_.tiers.size(); ++levels) {
      const auto parent = tiers_.find(at->parent);
      if (at->parent.empty() || parent == tiers_.end()) break;
      at = parent->second;
      path.push_back(at);
      if (const auto row = rows_.find(at); row != rows_.end()) above = &order_[row->second];
    }
    const Links links = above == nullptr ? Links{} : links_between(path);
    const std::vector<const SignRow*> rows = above != nullptr ? std::vector{above} : rows_for(tier);
    Loose loose;
    for (const Annotation& one : tier.annotations) {
      Phase phase{phase_kind_of(one.label, names_), one.span, one.label, one.id};
      bool placed = false;
      if (const std::size_t* linked = above == nullptr ? nullptr : sign_above(one, links)) {
        if (*linked == kNone) {
          ++loose.unlabelled;
          continue;
        }
        found_.signs[*linked].phases.push_back(phase);
        placed = true;
      } else {
        for (const SignRow* row : rows) {
          const std::size_t sign = sign_around(*row, one.span);
          if (sign == kNone) continue;
          found_.signs[sign].phases.push_back(phase);
          placed = true;
        }
      }
      if (!placed && loose.outside++ == 0) loose.first = one.span.begin;
      if (phase.kind == PhaseKind::other) ++unknown_[match_form(one.label)];
    }
    report(tier, loose);
  }

  struct Loose {
    std::size_t outside = 0;
    std::size_t unlabelled = 0;
    Milliseconds first{0};
  };

  void report(const Tier& tier, const Loose& loose) {
    if (loose.outside > 0) {
      note(tier.id, fmt::format("{} phases are in no sign, the first at {} ms", loose.outside, loose.first.count()));
    }
    if (loose.unlabelled > 0) {
      note(tier.id, fmt::format("{} phases belong to annotations without a gloss", loose.unlabelled));
    }
  }

  using Links = std::unordered_map<std::string_view, std::string_view>;  ///< annotation -> parent

  static Links links_between(const std::vector<const Tier*>& path) {
    Links links;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      for (const Annotation& one : path[i]->annotations) links.emplace(one.id, one.parent);
    }
    return links;
  }

  /// The sign that is an ancestor; *kNone if that has no gloss; null if there is none.
  const std::size_t* sign_above(const Annotation& one, const Links& links) const {
    std::string_view at = one.parent;
    for (std::size_t steps = 0; !at.empty() && steps <= links.size(); ++steps) {
      if (const auto sign = sign_of_.find(at); sign != sign_of_.end()) return &sign->second;
      const auto up = links.find(at);
      if (up == links.end()) return nullptr;
      at = up->second;
    }
    return nullptr;
  }

  /// The sign tiers to which the phases of an independent phase tier may belong.
  std::vector<const SignRow*> rows_for(const Tier& tier) const {
    const TierName name = read_tier_name(tier.id);
    const std::string& signer = tier.participant.empty() ? name.signer : tier.participant;
    std::vector<const SignRow*> rows;
    for (const SignRow& row : order_) {
      const bool hand_fits = name.hand == Hand::both || row.hand == Hand::both || name.hand == row.hand;
      const bool signer_fits = signer.empty() || row.signer.empty() || signer == row.signer;
      if (hand_fits && signer_fits) rows.push_back(&row);
    }
    return rows;
  }

  /// The sign of a tier that contains a span, else the one that shares most time with it, else kNone.
  std::size_t sign_around(const SignRow& row, TimeSpan span) const {
    const auto begin = found_.signs.begin() + static_cast<std::ptrdiff_t>(row.begin);
    const auto end = found_.signs.begin() + static_cast<std::ptrdiff_t>(row.end);
    auto at = std::lower_bound(begin, end, span.begin,
                               [](const Sign& sign, Milliseconds time) { return sign.span.end <= time; });
    std::size_t best = kNone;
    Milliseconds most{-1};
    for (; at != end && (at->span.begin < span.end || at->span.contains(span)); ++at) {
      const Milliseconds shared = std::min(at->span.end, span.end) - std::max(at->span.begin, span.begin);
      if (shared <= most) continue;
      most = shared;
      best = static_cast<std::size_t>(at - found_.signs.begin());
    }
    return best;
  }

  void finish(Sign& sign) {
    if (sign.phases.empty()) {
      sign.inferred = true;
      sign.phases.push_back({.kind = PhaseKind::stroke, .span = sign.span});
      return;
    }
    std::stable_sort(sign.phases.begin(), sign.phases.end(), [](const Phase& a, const Phase& b) {
      return a.span.begin != b.span.begin ? a.span.begin < b.span.begin : a.span.end < b.span.end;
    });
    const std::string faults = faults_of(sign);
    if (faults.empty()) return;
    note(sign.tier, fmt::format("sign '{}' at {} ms is not filled by its phases in order: {}", printable(sign.gloss),
                                sign.span.begin.count(), faults));
  }

  const AnnotationDocument& document_;
  const TierNames& names_;
  std::unordered_map<std::string_view, const Tier*> tiers_;
  std::unordered_map<const Tier*, std::size_t> rows_;  ///< an index into order_
  std::vector<SignRow> order_;
  std::unordered_map<std::string_view, std::size_t> sign_of_;  ///< annotation of a sign tier -> sign; kNone: no gloss
  std::map<std::string, std::size_t> unknown_;
  SignsFound found_;
};

}  // namespace

std::string_view name_of(Hand hand) noexcept {
  switch (hand) {
    case Hand::both:
      return "both";
    case Hand::right:
      return "right";
    case Hand::left:
      return "left";
  }
  return "both";
}

std::optional<TimeSpan> Sign::stroke_span() const noexcept {
  std::optional<TimeSpan> result;
  for (const Phase& phase : phases) {
    if (phase.kind != PhaseKind::stroke) continue;
    if (!result) result = phase.span;
    result->end = std::max(result->end, phase.span.end);
  }
  return result;
}

TimeSpan Sign::preparation_span() const noexcept {
  const std::optional<TimeSpan> stroke = stroke_span();
  return {span.begin, stroke ? std::max(span.begin, stroke->begin) : span.begin};
}

TimeSpan Sign::retraction_span() const noexcept {
  const std::optional<TimeSpan> stroke = stroke_span();
  return {stroke ? std::min(span.end, stroke->end) : span.end, span.end};
}

SignsFound signs_in(const AnnotationDocument& document, const TierNames& names) {
  return Collector(document, names).run();
}

}  // namespace signweave
