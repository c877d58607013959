#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signweave/choose/synthesizer.h"
#include "signweave/core/time.h"
#include "signweave/live/frame_codec.h"
#include "signweave/live/shared_signing_cache.h"
#include "signweave/score/score.h"

namespace signweave {

/// What happens when nothing is left to sign.
enum class Idle {
  living_rest,  ///< ease into rest, breathe and blink there, and ease out of it
  end,          ///< the last retraction is the end: no frame until something is appended
};

struct PlayerOptions {
  SynthesisOptions synthesis;  ///< as for a file; `explain` and `junctions` are not looked at
  Idle idle =
      Idle::living_rest;       ///< with `end`, an utterance has just the frames that `synthesize` makes of its tokens
  std::size_t look_ahead = 3;  ///< a place is decided once so many more are known, or when its time comes; 1 to 16
  bool loop = false;
  std::string recording;  ///< whose signer rests before anything is signed; empty: of the first place
};

/// What a stream's frames are of. Known once the first place is decided, or at once where a recording was named.
struct StreamHeader {
  std::shared_ptr<const Skeleton> skeleton;
  FrameRate rate;
  std::vector<std::string> tracks;
  std::string layout_from;  ///< the recording whose skeleton it is
  /// What the sources' documents say of themselves, such as that a demo's shapes are placeholders.
  std::vector<std::pair<std::string, std::string>> declarations;

  FrameShape shape() const noexcept { return {skeleton->joint_count(), skeleton->translation_count(), tracks.size()}; }
};

/// Something that a player tells, in the order of the frames.
struct PlayerEvent {
  enum class Kind {
    place,   ///< the first stroke frame of a place
    rest,    ///< the first frame at rest
    end,     ///< the frame after the last retraction (Idle::end)
    seek,    ///< the first frame after a jump
    notice,  ///< something that stopped nothing: `text`
  };
  Kind kind = Kind::notice;
  std::uint64_t frame = 0;  ///< of the stream
  std::size_t place = 0;    ///< counted from 0 since the last `sign`
  std::string gloss;
  std::size_t token = 0;  ///< as in `MATIN#3`; 0 for a piece
  std::string recording;
  std::size_t clip = 0;  ///< of a place: the clip that shows it, counted from 0 since the stream began; see ShownScore
  Milliseconds at{0};    ///< of the utterance: what `seek` takes
  std::string text;
};

/// What a stream shows, as a score: since its last jump, or since it went over from the middle of a sign to another
/// utterance. It grows at its end; of more than 64 clips it has the last.
struct ShownScore {
  Score score;
  std::int64_t next = 0;       ///< its frame that is shown next
  std::size_t first_clip = 0;  ///< which clip of the stream its first one is, see PlayerEvent::clip
};

/// Signs an utterance while it grows (the paper, sections 4.2 and 5). Places are chosen `look_ahead` places ahead with
/// the costs of `select`, and never changed once a frame of them was taken. Belongs to one thread at a time.
///
///     player.sign(parse_utterance("DEMAIN MATIN"));
///     player.append(parse_utterance("PLUIE"));
///     for (;;) { player.prepare(32); while (player.next(frame)) send(frame); }
class Player {
 public:
  Player(SharedSigningCache& base, PlayerOptions options);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  // Control. Throws what `synthesize` throws, and then nothing has changed. May allocate.

  /// Signs this instead of what is left of the utterance: goes over from where the signer is now.
  void sign(const Utterance& utterance);
  /// Signs this after what is left.
  void append(const Utterance& utterance);
  /// Frames stop, and go on.
  void pause() noexcept;
  void resume() noexcept;
  /// Jumps to a moment of the utterance, counted from its first frame; clamped to what is decided of it.
  void seek(Milliseconds at);
  /// 0.25 to 2, at once: frames pass so much faster. Throws Error{bad_input} outside.
  void set_tempo(double tempo);
  void set_loop(bool loop);
  /// Leaves out what was not begun; the signer goes to rest, or ends.
  void stop();

  /// The stream's header, once it is known; it never changes then.
  const StreamHeader* header() const noexcept;

  /// Makes frames, until at least `frames` can be taken (at most kMostReady), or no more can be known. Selection,
  /// reading and transitions are here: it may allocate, and throws Error{corrupt}, Error{bad_input} where a place
  /// cannot be signed; that place is then left out, and the next call goes on. Returns how many can be taken.
  std::size_t prepare(std::size_t frames);

  /// The frame path: takes the next frame, which must have the header's shape. False where none is ready: paused, at
  /// the end, or to be prepared. Allocates nothing, locks nothing.
  bool next(MutableFrameView out) noexcept;
  /// The same without a copy where the frame is there as it is to be shown: that one, which stays until prepare() or
  /// a control is called; else `room`, with the frame in it.
  std::optional<FrameView> next_in(MutableFrameView room) noexcept;
  /// For who plays many streams in turn, whose memory is far away by then: brings near what next() and take_event()
  /// will read, in two steps. The second reads what the first brought.
  void prefetch_state() const noexcept;
  void prefetch_frame() const noexcept;

  /// The number of the frame that `next` gives next.
  std::uint64_t frame() const noexcept;
  /// The next thing to tell that belongs before frame(): none where there is nothing. Moves it out.
  std::optional<PlayerEvent> take_event() noexcept;

  /// What is shown and, as far as that is known, will be: rendered, frame `next` of it and those after it are what the
  /// stream shows from here on at tempo 1, with the same bits up to the signs of quaternions. None before anything is
  /// known.
  std::optional<ShownScore> score(std::size_t most_clips = kMostScoreClips) const;
  /// The frames of its clips of SourceRef::Kind::rest; null where the stream never rests.
  std::shared_ptr<const MotionSource> rest() const noexcept;

  bool paused() const noexcept;
  /// True where nothing is left to sign: at rest, or at the end.
  bool idle() const noexcept;

  static constexpr std::size_t kMostReady = 64;
  static constexpr std::size_t kMostScoreClips = 64;

 private:
  struct State;
  struct LetGo;
  std::unique_ptr<State> state_;
};

}  // namespace signweave
