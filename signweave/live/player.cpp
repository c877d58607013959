#include "signweave/live/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "signweave/core/error.h"
#include "signweave/core/prefetch.h"
#include "signweave/live/frame_ring.h"
#include "signweave/live/live_score.h"
#include "signweave/motion/blend.h"

namespace signweave {
namespace {

constexpr double kSlowest = 0.25;
constexpr double kFastest = 2.0;

PlayerOptions checked(PlayerOptions options) {
  check(options.synthesis);
  if (options.look_ahead < 1 || options.look_ahead > 16) {
    throw Error(ErrorCode::bad_input, fmt::format("a look-ahead of {} places is outside 1 to 16", options.look_ahead));
  }
  return options;
}

}  // namespace

struct Player::State {
  State(SharedSigningCache& cache, const PlayerOptions& options) : score(cache, options) {}

  // Members used for each frame come first, for locality.
  FrameRing ring;
  std::int64_t next = 0;    ///< frame of the timeline that is shown next
  double part = 0;          ///< position between it and the following frame, in [0, 1)
  double tempo = 1;         ///< frames of the timeline per taken frame
  std::uint64_t taken = 0;  ///< frames of the stream
  bool paused = false;
  LiveScore score;

  /// Allocates the ring, once the shape of frames is known.
  void open_ring() {
    if (ring.capacity() > 1 || score.header() == nullptr) return;
    ring = FrameRing(score.header()->shape(), kMostReady * 2 + static_cast<std::size_t>(score.history()) + 2);
  }
  /// Number of frames that can be taken from the ring.
  std::size_t ready() const noexcept {
    const auto there = static_cast<double>(ring.end() - next) - part;
    if (there <= 0) return 0;
    // An interpolated frame needs both neighbours.
    const double last = part == 0 && tempo == 1 ? there - 1 : there - 1 - 1e-9;
    return last < 0 ? (part == 0 ? 1 : 0) : static_cast<std::size_t>(last / tempo) + 1;
  }
  /// The position of the stream: at the end even if the last frame was interpolated.
  std::int64_t position() const noexcept {
    return score.ended() && next + 1 >= score.end() && ready() == 0 ? score.end() : next;
  }
  /// Truncates the ring after the timeline was changed.
  void changed() {
    ring.cut(std::min({ring.end(), score.end(), score.take_changed_from()}));
    if (ring.end() == next) part = 0;
  }
};

/// Releases the database and the taken frames, however a call ends.
struct Player::LetGo {
  State& state;
  ~LetGo() { state.score.let_go(state.next); }
};

Player::Player(SharedSigningCache& cache, PlayerOptions options) {
  const PlayerOptions sound = checked(std::move(options));
  state_ = std::make_unique<State>(cache, sound);
  if (!sound.recording.empty()) state_->score.rest_in(sound.recording);
  state_->open_ring();
}

Player::~Player() = default;

void Player::sign(const Utterance& utterance) {
  state_->score.replace(utterance, state_->next, state_->ring);
  state_->changed();
}

void Player::append(const Utterance& utterance) {
  state_->score.add(utterance, state_->next, state_->ring);
  state_->changed();
}

void Player::stop() {
  sign({});
}

void Player::pause() noexcept {
  state_->paused = true;
}

void Player::resume() noexcept {
  state_->paused = false;
}

void Player::seek(Milliseconds at) {
  State& state = *state_;
  if (state.score.header() == nullptr) return;
  const double frames = Seconds(at).count() * state.score.header()->rate.hertz();
  const LetGo let_go{state};
  if (!state.score.seek(std::llround(std::clamp(frames, 0.0, 1e12)), state.next)) return;
  state.ring.cut(state.next);
  state.part = 0;
}

void Player::set_tempo(double tempo) {
  if (!(tempo >= kSlowest && tempo <= kFastest)) {
    throw Error(ErrorCode::bad_input, fmt::format("a tempo of {} is outside {} to {}", tempo, kSlowest, kFastest));
  }
  state_->tempo = tempo;
  // Returns to whole frames; the next one is up to half a frame early or late.
  if (tempo == 1 && state_->part > 0) {
    if (state_->part >= 0.5 && state_->next + 1 < state_->ring.end()) ++state_->next;
    state_->part = 0;
  }
}

void Player::set_loop(bool loop) {
  state_->score.set_loop(loop, state_->next, state_->ring);
  state_->changed();
}

const StreamHeader* Player::header() const noexcept {
  return state_->score.header();
}

std::size_t Player::prepare(std::size_t frames) {
  State& state = *state_;
  frames = std::min(frames, kMostReady);
  const LetGo let_go{state};
  while (state.ready() < frames) {
    if (state.score.end() <= state.ring.end() && !state.score.extend(state.ring)) break;
    state.open_ring();
    state.ring.forget(state.next - state.score.history());
    const auto wanted =
        static_cast<std::int64_t>(std::ceil(static_cast<double>(frames) * state.tempo + state.part)) + 1;
    const std::int64_t before = state.ring.end();
    state.score.read(std::min(state.score.end(), state.next + wanted), state.ring);
    if (state.ring.end() == before && state.score.end() > before) break;
  }
  return state.ready();
}

bool Player::next(MutableFrameView out) noexcept {
  const std::optional<FrameView> frame = next_in(out);
  if (!frame) return false;
  if (frame->pose.rotations.data() == out.pose.rotations.data()) return true;
  std::ranges::copy(frame->pose.rotations, out.pose.rotations.begin());
  std::ranges::copy(frame->pose.translations, out.pose.translations.begin());
  std::ranges::copy(frame->tracks, out.tracks.begin());
  return true;
}

std::optional<FrameView> Player::next_in(MutableFrameView room) noexcept {
  State& state = *state_;
  if (state.paused || state.ready() == 0) return std::nullopt;
  FrameView shown = state.ring.at(state.next);
  if (state.part > 0) {
    const FrameView before = shown;
    const FrameView after = state.ring.at(state.next + 1);
    const auto part = static_cast<float>(state.part);
    blend(before.pose, after.pose, part, room.pose);
    for (std::size_t i = 0; i < room.tracks.size(); ++i) {
      room.tracks[i] = before.tracks[i] + part * (after.tracks[i] - before.tracks[i]);
    }
    shown = room;
  }
  const double to = state.part + state.tempo;
  const double whole = std::floor(to);
  state.next += static_cast<std::int64_t>(whole);
  state.part = state.tempo == 1 ? 0 : to - whole;
  if (state.next > state.ring.end()) {  // beyond the end at high tempo
    state.next = state.ring.end();
    state.part = 0;
  }
  ++state.taken;
  return shown;
}

void Player::prefetch_state() const noexcept {
  const auto address = [](const void* of) { return static_cast<const std::byte*>(of); };
  prefetch(state_.get(), static_cast<std::size_t>(address(&state_->score) - address(state_.get())));
  state_->score.prefetch_state();
}

void Player::prefetch_frame() const noexcept {
  state_->ring.prefetch_frame(state_->next);
  state_->score.prefetch_event();
}

std::uint64_t Player::frame() const noexcept {
  return state_->taken;
}

std::optional<PlayerEvent> Player::take_event() noexcept {
  std::optional<PlayerEvent> event = state_->score.take_event(state_->position());
  if (event) event->frame = state_->taken;
  return event;
}

std::optional<ShownScore> Player::score(std::size_t most_clips) const {
  return state_->score.score(state_->position(), most_clips);
}

std::shared_ptr<const MotionSource> Player::rest() const noexcept {
  return state_->score.rest();
}

bool Player::paused() const noexcept {
  return state_->paused;
}

bool Player::idle() const noexcept {
  return state_->score.idle(state_->position());
}

}  // namespace signweave
