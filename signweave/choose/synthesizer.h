#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "signweave/choose/concatenate.h"
#include "signweave/choose/durations.h"
#include "signweave/choose/edit.h"
#include "signweave/choose/open_score.h"
#include "signweave/choose/select.h"
#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/notation/utterance.h"
#include "signweave/score/junction_choice.h"

namespace signweave {

struct SynthesisOptions {
  const TransitionMethod* method = nullptr;  ///< null: the default
  DurationModel duration;
  double tempo = 1;               ///< kSlowestTempo to kFastestTempo
  JunctionChoices junctions;      ///< what is told for one alone; those are made even between recorded neighbours
  std::optional<FrameRate> rate;  ///< the highest of the sources where not given
  Alignment alignment = Alignment::automatic;
  std::int64_t most_frames = kMostFrames;  ///< a result that would have more is refused before a frame is read
  bool explain = false;                    ///< fill Selection::explained
};

/// Throws Error{bad_input} where an option is out of range; junctions that there are not are told when it is known how
/// many there are.
void check(const SynthesisOptions& options);

/// How long each step took: the columns of the paper's Table 1.
struct Timings {
  Seconds semantic_query{0};
  Seconds selection{0};
  Seconds retrieval{0};
  Seconds concatenation{0};
  Seconds total{0};
};

/// A synthesis and how it came about.
struct Synthesized {
  std::shared_ptr<const Contents> contents;  ///< what it was made from: candidates name its recordings
  Synthesis result;
  std::vector<Choice> choices;  ///< what there was to choose from
  Selection selection;
  DurationFit durations;  ///< that the transitions were timed with; of a fixed duration only its mean is known
  /// Captured transitions that the method had to go by; none where it asks for none.
  std::optional<std::size_t> captured_transitions;
  Timings timings;
  /// The recording that gave the skeleton: its file layout serves for writing BVH.
  std::string layout_from;
};

/// Signs an utterance: the few lines that call the rest. Throws MissingGlosses for glosses that the database lacks,
/// Error{bad_input} for skeletons that cannot be joined, options out of range, a junction that there is not. `used` is
/// an older result whose memory may be used again.
Synthesized synthesize(const Database& database, const Utterance& utterance, const SynthesisOptions& options = {},
                       Synthesis used = {});

/// Renders all of a score of this database's recordings; see OpenScore, which renders parts of one too.
Synthesized synthesize(const Database& database, const Score& score, Synthesis used = {});

/// Edits a recording.
Synthesized synthesize(const Database& database, std::string_view recording, const Edit& edit,
                       const SynthesisOptions& options = {}, Synthesis used = {});

}  // namespace signweave
