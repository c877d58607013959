#pragma once

#include <string>
#include <vector>

#include "signweave/calls/gloss_loci.h"
#include "signweave/features/gloss_stats.h"
#include "signweave/features/transition_stats.h"

/// Statistics as rows for display and as complete rows for CSV. Durations are milliseconds.
namespace signweave::calls {

using Rows = std::vector<std::vector<std::string>>;

/// Transitions of one recording, or of all of them.
struct NamedSummary {
  std::string recording;  ///< empty: the corpus
  TransitionSummary summary;
};

Rows transition_rows(const std::vector<NamedSummary>& summaries);
/// How the hands move: displacement, path and average velocity of each hand over the whole transition (the paper,
/// section 5.1); only the heading if nothing was measured.
Rows hand_rows(const std::vector<NamedSummary>& summaries);
Rows pair_rows(const std::vector<PairStats>& pairs);
Rows gloss_rows(const std::vector<GlossStats>& glosses);
Rows ngram_rows(const std::vector<NgramStats>& ngrams);
/// The middle of each end is written as a locus is: azimuth/elevation/distance.
Rows loci_rows(const std::vector<GlossLoci>& glosses);

/// Complete rows: one for each part (whole, retraction, preparation) and measure (duration; for each hand displacement,
/// path and speed if known), with every number of its distribution.
Rows transition_csv(const std::vector<NamedSummary>& summaries);
Rows pair_csv(const std::vector<PairStats>& pairs);
Rows gloss_csv(const std::vector<GlossStats>& glosses);
Rows ngram_csv(const std::vector<NgramStats>& ngrams);
Rows loci_csv(const std::vector<GlossLoci>& glosses);

}  // namespace signweave::calls
