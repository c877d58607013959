#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "signweave/choose/concatenate.h"
#include "signweave/choose/durations.h"
#include "signweave/choose/edit.h"
#include "signweave/choose/inflect.h"
#include "signweave/choose/non_manuals.h"
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
  double tempo = 1;                ///< kSlowestTempo to kFastestTempo
  JunctionChoices junctions;       ///< options of single junctions; these are made even between recorded neighbours
  std::optional<FrameRate> rate;   ///< none: the highest rate of the sources
  std::optional<Side> handedness;  ///< signers with the other dominant hand are mirrored; none: all as captured
  Alignment alignment = Alignment::automatic;
  std::int64_t most_frames = kMostFrames;  ///< longer results are rejected before a frame is read
  bool explain = false;                    ///< fill Selection::explained
  NonManualOptions non_manuals;
  bool strict = false;  ///< what lint_channels finds, and what `inflect` does, is an error
  SpaceOptions space;
};

/// Throws Error{bad_input} if an option is out of range. Junction numbers that are too high are reported later, once
/// the number of junctions is known.
void check(const SynthesisOptions& options);

/// The duration of each step: the columns of the paper's Table 1.
struct Timings {
  Seconds semantic_query{0};
  Seconds selection{0};
  Seconds retrieval{0};
  Seconds concatenation{0};
  Seconds total{0};
};

/// A synthesis with the choices made for it.
struct Synthesized {
  std::shared_ptr<const Contents> contents;  ///< its source; candidates refer to its recordings
  Synthesis result;
  std::vector<Choice> choices;  ///< the candidates of each place
  Selection selection;
  DurationFit durations;  ///< used to time the transitions; for a fixed duration only the mean is set
  /// Number of captured transitions available to the method; none if it needs none.
  std::optional<std::size_t> captured_transitions;
  Timings timings;
  /// The recording that defines the skeleton; its file layout is used for writing BVH.
  std::string layout_from;
};

/// Signs an utterance. Throws MissingGlosses for unknown glosses; Error{bad_input} for skeletons that cannot be joined,
/// options out of range, and unknown junctions. `used` is an older result whose memory may be reused.
Synthesized synthesize(const Database& database, const Utterance& utterance, const SynthesisOptions& options = {},
                       Synthesis used = {});

/// Renders all of a score of this database's recordings. OpenScore can render parts of one.
Synthesized synthesize(const Database& database, const Score& score, Synthesis used = {});

/// Edits a recording.
Synthesized synthesize(const Database& database, std::string_view recording, const Edit& edit,
                       const SynthesisOptions& options = {}, Synthesis used = {});

/// Takes a recording apart into the signs of its tiers, those of each hand if they have tiers of their own, and
/// composes them again. Gives the recording's motion, bit for bit.
Synthesized recompose(const Database& database, std::string_view recording);

}  // namespace signweave
