#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/choose/channel_clips.h"
#include "signweave/choose/select.h"
#include "signweave/database/database.h"
#include "signweave/notation/utterance.h"

/// What parts of the signer sign besides the places of an utterance: from the text to clips of channels.
namespace signweave {

/// The channel of a part; `dominant` is the hand that signs as the dominant one.
Channel channel_of(BodyPart part, Side dominant) noexcept;

/// The candidates of each sign of a place's parts, in their order.
struct PartChoice {
  std::size_t place = 0;  ///< the first place that the part accompanies
  std::size_t last = 0;   ///< inclusive
  Channel channel = Channel::left;
  std::vector<std::vector<Candidate>> signs;  ///< empty: the hand rests
  std::vector<std::vector<ClipSync>> sync;  ///< [sign]; `with` is a place. Of the first, empty: it begins with the part
  std::vector<bool> continues = {};         ///< [sign] see MotionClip; empty: none
};
/// `dominant` is the dominant hand of places that name none. Throws Error{not_found} for unknown glosses,
/// Error{bad_input} for parts that name the same channel of a place twice.
std::vector<PartChoice> part_choices(const Contents& contents, const Utterance& utterance, Side dominant);

/// The places at which a clip must begin because a part or a hold begins or ends there.
std::set<std::size_t> clip_borders(const Utterance& utterance);

/// A chosen sign of a part.
struct ChosenPart {
  const PartChoice* part = nullptr;
  std::size_t sign = 0;  ///< its number within the part
  Candidate candidate;
  /// The hand of the part shows the sign mirrored if the other hand signs it alone, and as captured if this one does.
  /// None: both hands sign it, or the part is no hand.
  std::optional<bool> mirrored = {};
  bool rest = false;  ///< the hand rests
};
/// Chooses a candidate for each sign of the parts: the token of the place itself if the part signs the same, else the
/// one that joins best with what is signed before and after it. A part that signs nothing but its place's token with it
/// is left out. `chosen` are the candidates of the places.
std::vector<ChosenPart> choose_parts(const Snapshot& snapshot, std::span<const PartChoice> parts,
                                     std::span<const Candidate* const> chosen, std::span<const Choice> places,
                                     const SelectOptions& options);

/// The ties and ranges of a chosen part's clip, without the clip; `clip_of` is the number of the whole-body clip of
/// each place.
ChannelClip channel_clip(const ChosenPart& chosen, std::span<const std::size_t> clip_of);
/// The holds of an utterance, between places instead of clips.
std::vector<ChannelHold> channel_holds(const Utterance& utterance, Side dominant);

}  // namespace signweave
