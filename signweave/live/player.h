#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/time.h"
#include "signweave/live/frame_codec.h"
#include "signweave/live/shared_signing_cache.h"
#include "signweave/score/score.h"

namespace signweave {

/// What happens when nothing is left to sign.
enum class Idle {
  living_rest,  ///< ease into rest, breathe and blink, and ease out again
  end,          ///< end with the last retraction; no frames until something is appended
};

struct PlayerOptions {
  SynthesisOptions synthesis;     ///< as for a file; `explain` and `junctions` are ignored
  Idle idle = Idle::living_rest;  ///< `end`: the frames equal those of `synthesize` for the same tokens
  std::size_t look_ahead = 3;     ///< following places known before a place is decided, unless it is due; 1 to 16
  bool loop = false;
  /// The stream has the tracks of authored movements of the face, whichever the recordings have. They are there also if
  /// the first utterance asks for such movements; later ones are shown as far as there are tracks.
  bool face = false;
  std::string recording;  ///< its signer is shown at rest before anything is signed; empty: that of the first place
};

/// Describes a stream's frames. Known once the first place is decided, or immediately if a recording was named.
struct StreamHeader {
  std::shared_ptr<const Skeleton> skeleton;
  FrameRate rate;
  std::vector<std::string> tracks;
  std::string layout_from;    ///< the recording that the skeleton comes from
  Declarations declarations;  ///< of the recordings: sorted, each once

  FrameShape shape() const noexcept { return {skeleton->joint_count(), skeleton->translation_count(), tracks.size()}; }
};

/// An event of a player, in the order of the frames.
struct PlayerEvent {
  enum class Kind {
    place,   ///< the first stroke frame of a place
    rest,    ///< the first frame at rest
    end,     ///< the frame after the last retraction (Idle::end)
    seek,    ///< the first frame after a jump
    notice,  ///< a message that does not stop the stream: `text`
  };
  Kind kind = Kind::notice;
  std::uint64_t frame = 0;  ///< of the stream
  std::size_t place = 0;    ///< counted from 0 since the last `sign`
  std::string gloss;
  std::size_t token = 0;  ///< as in `MATIN#3`; 0 for a piece
  std::string recording;
  std::size_t clip = 0;  ///< for a place: its clip, numbered from 0 since the stream began; see ShownScore
  Milliseconds at{0};    ///< time in the utterance, as for `seek`
  std::string text;
  std::string code = {};  ///< of a notice of lint_channels; empty for most
};

/// The score of what a stream shows since its last jump, or since it switched from the middle of a sign to another
/// utterance. It grows at its end and contains at most the last 64 clips.
struct ShownScore {
  Score score;
  std::int64_t next = 0;  ///< the frame of the score that is shown next
  /// The frames from here on still change if something follows. The score ends later if lanes differ at its end.
  std::int64_t known = 0;
  std::size_t first_clip = 0;  ///< number of its first clip in the stream, see PlayerEvent::clip
};

/// Signs an utterance while it grows (the paper, sections 4.2 and 5). Tokens are chosen with a look-ahead of
/// `look_ahead` places and the costs of `select`, and never changed once a frame of them was taken. Used by one thread
/// at a time.
///
///     player.sign(parse_utterance("DEMAIN MATIN"));
///     player.append(parse_utterance("PLUIE"));
///     for (;;) { player.prepare(32); while (player.next(frame)) send(frame); }
class Player {
 public:
  Player(SharedSigningCache& cache, PlayerOptions options);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  // Control. Throws what `synthesize` throws; then nothing has changed. May allocate.

  /// Replaces the rest of the utterance, with a transition from the current pose.
  void sign(const Utterance& utterance);
  /// Appends to the utterance.
  void append(const Utterance& utterance);
  /// Stops and continues the frames.
  void pause() noexcept;
  void resume() noexcept;
  /// Jumps to a time of the utterance, measured from its first frame and clamped to its decided part.
  void seek(Milliseconds at);
  /// Sets the playback speed, 0.25 to 2, effective immediately. Throws Error{bad_input} outside this range.
  void set_tempo(double tempo);
  void set_loop(bool loop);
  /// Drops all places that have not begun; the signer goes to rest, or ends.
  void stop();

  /// The stream's header, or null before it is known; then it never changes.
  const StreamHeader* header() const noexcept;

  /// Makes frames until at least `frames` (at most kMostReady) are ready, or no more can be made. Selection, reading
  /// and transitions happen here: it may allocate, and throws Error{corrupt}, Error{bad_input} if a place cannot be
  /// signed; that place is skipped, and the next call continues. Returns the number of ready frames.
  std::size_t prepare(std::size_t frames);

  /// Takes the next frame; `out` must have the header's shape. Returns false if none is ready: paused, at the end, or
  /// not prepared. Does not allocate or lock.
  bool next(MutableFrameView out) noexcept;
  /// The same without a copy if the stored frame can be shown as it is: returns a view of it, valid until prepare() or
  /// a control function is called. Otherwise writes the frame to `room` and returns it.
  std::optional<FrameView> next_in(MutableFrameView room) noexcept;
  /// For callers that play many streams in turn, whose memory is not cached: prefetches what next() and take_event()
  /// will read, in two steps. The second reads what the first prefetched.
  void prefetch_state() const noexcept;
  void prefetch_frame() const noexcept;

  /// The number of the next frame.
  std::uint64_t frame() const noexcept;
  /// Takes the next event before frame(); none if there is none.
  std::optional<PlayerEvent> take_event() noexcept;

  /// The score of what was shown and, as far as known, will be shown. Rendering it from frame `next` gives what the
  /// stream shows from here on at tempo 1, bit for bit up to the signs of quaternions. None before anything is known.
  std::optional<ShownScore> score(std::size_t most_clips = kMostScoreClips) const;
  /// The frames of the score's clips of SourceRef::Kind::rest; null if the stream never rests.
  std::shared_ptr<const MotionSource> rest() const noexcept;

  bool paused() const noexcept;
  /// True if nothing is left to sign: at rest, or at the end.
  bool idle() const noexcept;

  static constexpr std::size_t kMostReady = 64;
  static constexpr std::size_t kMostScoreClips = 64;

 private:
  struct State;
  struct LetGo;
  std::unique_ptr<State> state_;
};

}  // namespace signweave
