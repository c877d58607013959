#include "signweave/calls/stats_report.h"

#include <fmt/format.h>

#include <cmath>

#include "signweave/rig/part.h"

namespace signweave::calls {
namespace {

constexpr const char* kSideNames[] = {"left", "right"};

std::string ms(double value) {
  return fmt::format("{:.0f}", value);
}

/// Half the confidence interval: "± 37"; "-" for fewer than two values.
std::string interval_of(const Distribution& of) {
  return of.count < 2 ? "-" : ms((of.mean_high - of.mean_low) / 2);
}

std::string mean_of(const Distribution& of) {
  return of.count == 0 ? "-" : ms(of.mean);
}

std::vector<std::string> joined(std::vector<std::string> row, const std::vector<std::string>& more) {
  row.insert(row.end(), more.begin(), more.end());
  return row;
}

std::vector<std::string> complete_head() {
  std::vector<std::string> head = {"count", "mean", "sd", "mean_low", "mean_high", "least"};
  for (const double quantile : Distribution::kQuantiles) head.push_back(fmt::format("q{:02.0f}", 100 * quantile));
  return joined(std::move(head), {"most", "histogram_begin", "histogram_width", "histogram_counts"});
}

std::vector<std::string> complete(const Distribution& of) {
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  std::vector<std::string> row = {std::to_string(of.count),
                                  number(of.mean),
                                  number(of.deviation),
                                  of.count < 2 ? "" : number(of.mean_low),
                                  of.count < 2 ? "" : number(of.mean_high),
                                  number(of.least)};
  for (const double quantile : of.quantiles) row.push_back(number(quantile));
  std::string counts;
  for (const std::size_t count : of.histogram.counts) {
    counts += fmt::format("{}{}", counts.empty() ? "" : " ", count);
  }
  return joined(std::move(row), {number(of.most), number(of.histogram.begin), number(of.histogram.width), counts});
}

/// Adds one row for each measure of each part, each prefixed with `name`.
void add_complete(const TransitionSummary& summary, const std::vector<std::string>& name, Rows& rows) {
  const auto row = [&](const char* part, const char* hand, const char* measure, const Distribution& of) {
    if (of.count > 0) rows.push_back(joined(joined(name, {part, hand, measure}), complete(of)));
  };
  const auto part = [&](const char* which, const PartStats& stats) {
    row(which, "", summary.inferred ? "duration_ms_inferred" : "duration_ms", stats.duration);
    for (std::size_t side = 0; side < stats.hands.size(); ++side) {
      const TravelStats& hand = stats.hands[side];
      row(which, kSideNames[side], "displacement_m", hand.displacement);
      row(which, kSideNames[side], "path_m", hand.path);
      row(which, kSideNames[side], "speed_m_per_s", hand.speed);
    }
  };
  part("whole", summary.whole);
  part("retraction", summary.retraction);
  part("preparation", summary.preparation);
}

std::string locus_of(const SpaceAngles& at) {
  const auto whole = [](float degrees) { return static_cast<int>(std::lround(degrees)); };
  return fmt::format("@{}/{}/{:.1f}", whole(at.azimuth), whole(at.elevation), at.distance);
}

std::string text_of(const std::vector<std::string>& glosses) {
  std::string text;
  for (const std::string& gloss : glosses) text += (text.empty() ? "" : " ") + gloss;
  return text;
}

}  // namespace

Rows transition_rows(const std::vector<NamedSummary>& summaries) {
  Rows rows = {{"recording", "transitions", "mean ms", "±95 %", "SD", "5 %", "10 %", "25 %", "median", "75 %", "90 %",
                "95 %", "retraction", "preparation"}};
  for (const NamedSummary& one : summaries) {
    const Distribution& of = one.summary.whole.duration;
    std::vector<std::string> row = {one.recording.empty() ? "(all)" : one.recording, std::to_string(of.count),
                                    mean_of(of), interval_of(of), of.count == 0 ? "-" : ms(of.deviation)};
    for (const double quantile : of.quantiles) row.push_back(of.count == 0 ? "-" : ms(quantile));
    row.push_back(mean_of(one.summary.retraction.duration));
    row.push_back(mean_of(one.summary.preparation.duration));
    rows.push_back(std::move(row));
  }
  return rows;
}

Rows hand_rows(const std::vector<NamedSummary>& summaries) {
  Rows rows = {{"recording", "hand", "transitions", "displacement m", "SD", "path m", "SD", "velocity m/s", "SD"}};
  for (const NamedSummary& one : summaries) {
    for (std::size_t side = 0; side < 2; ++side) {
      const TravelStats& hand = one.summary.whole.hands[side];
      if (hand.path.count == 0) continue;
      std::vector<std::string> row = {one.recording.empty() ? "(all)" : one.recording, kSideNames[side],
                                      std::to_string(hand.path.count)};
      for (const Distribution* of : {&hand.displacement, &hand.path, &hand.speed}) {
        row = joined(std::move(row), {fmt::format("{:.2f}", of->mean), fmt::format("{:.2f}", of->deviation)});
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

Rows pair_rows(const std::vector<PairStats>& pairs) {
  Rows rows = {{"from", "to", "count", "mean ms", "±95 %", "SD", "median", "retraction", "preparation"}};
  for (const PairStats& pair : pairs) {
    const Distribution& of = pair.summary.whole.duration;
    rows.push_back({pair.from, pair.to, std::to_string(of.count), ms(of.mean), interval_of(of), ms(of.deviation),
                    ms(of.median()), mean_of(pair.summary.retraction.duration),
                    mean_of(pair.summary.preparation.duration)});
  }
  return rows;
}

Rows gloss_rows(const std::vector<GlossStats>& glosses) {
  Rows rows = {{"gloss", "count", "sign ms", "SD", "least", "most", "stroke ms", "SD", "least", "most"}};
  for (const GlossStats& gloss : glosses) {
    std::vector<std::string> row = {gloss.gloss, std::to_string(gloss.sign.count)};
    for (const Distribution* of : {&gloss.sign, &gloss.stroke}) {
      const bool none = of->count == 0;
      row = joined(std::move(row), {mean_of(*of), none ? "-" : ms(of->deviation), none ? "-" : ms(of->least),
                                    none ? "-" : ms(of->most)});
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Rows ngram_rows(const std::vector<NgramStats>& ngrams) {
  Rows rows = {{"n", "glosses", "count", "interval ms", "SD"}};
  for (const NgramStats& ngram : ngrams) {
    rows.push_back({std::to_string(ngram.glosses.size()), text_of(ngram.glosses), std::to_string(ngram.count),
                    ms(ngram.interval.mean), ms(ngram.interval.deviation)});
  }
  return rows;
}

Rows loci_rows(const std::vector<GlossLoci>& glosses) {
  Rows rows = {
      {"gloss", "count", "hand", "begin", "nearest", "end", "nearest", "heading", "begins", "ends", "spread cm"}};
  for (const GlossLoci& gloss : glosses) {
    rows.push_back({gloss.gloss, std::to_string(gloss.tokens.size()), kSideNames[static_cast<std::size_t>(gloss.hand)],
                    locus_of(gloss.begin.middle), fmt::format("@{}", gloss.begin.nearest), locus_of(gloss.end.middle),
                    fmt::format("@{}", gloss.end.nearest),
                    gloss.heading == Heading::neither ? "-" : std::string(name_of(gloss.heading)),
                    std::to_string(gloss.begin.places), std::to_string(gloss.end.places),
                    fmt::format("{:.0f}", 100 * gloss.spread())});
  }
  return rows;
}

Rows transition_csv(const std::vector<NamedSummary>& summaries) {
  Rows rows = {joined({"recording", "part", "hand", "measure"}, complete_head())};
  for (const NamedSummary& one : summaries) add_complete(one.summary, {one.recording}, rows);
  return rows;
}

Rows pair_csv(const std::vector<PairStats>& pairs) {
  Rows rows = {joined({"from", "to", "part", "hand", "measure"}, complete_head())};
  for (const PairStats& pair : pairs) add_complete(pair.summary, {pair.from, pair.to}, rows);
  return rows;
}

Rows gloss_csv(const std::vector<GlossStats>& glosses) {
  Rows rows = {joined({"gloss", "measure"}, complete_head())};
  for (const GlossStats& gloss : glosses) {
    rows.push_back(joined({gloss.gloss, "sign_ms"}, complete(gloss.sign)));
    if (gloss.stroke.count > 0) rows.push_back(joined({gloss.gloss, "stroke_ms"}, complete(gloss.stroke)));
  }
  return rows;
}

Rows ngram_csv(const std::vector<NgramStats>& ngrams) {
  Rows rows = {joined({"n", "glosses", "occurrences", "measure"}, complete_head())};
  for (const NgramStats& ngram : ngrams) {
    rows.push_back(joined(
        {std::to_string(ngram.glosses.size()), text_of(ngram.glosses), std::to_string(ngram.count), "interval_ms"},
        complete(ngram.interval)));
  }
  return rows;
}

Rows loci_csv(const std::vector<GlossLoci>& glosses) {
  Rows rows = {
      joined({"gloss", "hand", "heading", "end", "nearest", "places", "spread_m", "measure"}, complete_head())};
  for (const GlossLoci& gloss : glosses) {
    for (const bool begin : {true, false}) {
      const PlaceStats& place = begin ? gloss.begin : gloss.end;
      const std::vector<std::string> name = {gloss.gloss,
                                             kSideNames[static_cast<std::size_t>(gloss.hand)],
                                             std::string(name_of(gloss.heading)),
                                             begin ? "begin" : "end",
                                             std::string(place.nearest),
                                             std::to_string(place.places),
                                             fmt::format("{:.6g}", place.spread)};
      rows.push_back(joined(joined(name, {"azimuth_deg"}), complete(place.azimuth)));
      rows.push_back(joined(joined(name, {"elevation_deg"}), complete(place.elevation)));
      rows.push_back(joined(joined(name, {"distance_sw"}), complete(place.distance)));
    }
  }
  return rows;
}

}  // namespace signweave::calls
