#pragma once

#include <string>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/calls/gloss_loci.h"
#include "signweave/calls/listener.h"
#include "signweave/calls/stats_answer.h"
#include "signweave/calls/stats_report.h"

namespace signweave::calls {

/// The length of the longest runs of glosses that are counted.
inline constexpr std::size_t kLongestNgram = 8;

/// Durations of the recorded transitions.
struct StatsCall {
  std::string recording;  ///< empty: all
  bool pairs = false;
  bool glosses = false;
  std::size_t ngrams = 0;  ///< 0: none
  bool loci = false;
  std::string gloss;  ///< with `loci`; empty: all
};

template <class Visit>
void fields(Visit& visit, StatsCall& call) {
  visit(Field{.name = "recording", .help = "of this recording alone"}, call.recording);
  visit(Field{.name = "pairs", .help = "the transitions of each pair of glosses"}, call.pairs);
  visit(Field{.name = "glosses", .help = "how often each gloss occurs, and how long sign and stroke last"},
        call.glosses);
  visit(Field{.name = "ngrams",
              .help = "runs of 2 to N glosses, and the time between their strokes",
              .range = Range{std::size_t{2}, kLongestNgram}},
        call.ngrams);
  visit(Field{.name = "loci", .help = "where in signing space the strokes of each gloss begin and end"}, call.loci);
  visit(Field{.name = "gloss", .help = "with loci: of this gloss alone"}, call.gloss);
}

/// The signs and transitions that were counted.
struct Counted {
  std::vector<std::string> names;
  std::vector<std::vector<Sign>> signs;                      ///< [recording]
  std::vector<std::vector<RecordedTransition>> transitions;  ///< [recording]
  std::vector<RecordedTransition> all;
  std::vector<GlossLoci> loci;  ///< if requested
  SignerBody body;              ///< of the first recording with a measured sign
};

/// A recording whose features are damaged is reported; its durations are still counted. Throws Error{not_found},
/// Error{bad_input} for a gloss without loci.
Counted run(const Database& database, const StatsCall& call, const Listener& listener);

StatisticsAnswer answer_of(const StatsCall& call, const Counted& counted);
/// Rows for CSV; at most one of pairs, glosses, ngrams and loci may be requested (see csv_fault).
Rows csv_of(const StatsCall& call, const Counted& counted);
/// Returns why the request is not a single table; empty if it is.
std::string csv_fault(const StatsCall& call);
/// The number of glosses in a plot of loci: those with the greatest spread.
inline constexpr std::size_t kMostPlottedGlosses = 12;
/// An SVG document: figure 4 of the paper, or with `loci` the signing space with the ends of strokes. Throws
/// Error{not_found}, its text prefixed with `where`, if no transition is recorded, or no stroke measured.
std::string plot_of(const StatsCall& call, const Counted& counted, const std::string& where);

std::vector<NamedSummary> summaries_of(const Counted& counted);
std::vector<Sign> all_signs(const Counted& counted);
std::vector<NgramStats> all_ngrams(const Counted& counted, std::size_t longest);

}  // namespace signweave::calls
