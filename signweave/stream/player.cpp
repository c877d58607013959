#include "signweave/stream/player.h"

#include <algorithm>

#include "signweave/core/error.h"

namespace signweave {

// The thinnest path: each utterance is synthesised whole.

struct SigningBase::State {
  const Database& database;
};
SigningBase::SigningBase(const Database& database) : state_(new State{database}) {}
SigningBase::~SigningBase() = default;
const Database& SigningBase::database() const noexcept {
  return state_->database;
}
void SigningBase::warm_up() {}

struct Player::State {
  SigningBase& base;
  PlayerOptions options;
  Motion motion;
  std::optional<StreamHeader> header;
  std::int64_t at = 0;
  std::uint64_t frame = 0;
  bool paused = false;
};

Player::Player(SigningBase& base, PlayerOptions options)
    : state_(new State{.base = base, .options = std::move(options), .motion = {}, .header = {}}) {}
Player::~Player() = default;
void Player::sign(const Utterance& utterance) {
  Synthesized made = synthesize(state_->base.database(), utterance, state_->options.synthesis);
  state_->motion = std::move(made.result.motion);
  state_->at = 0;
  if (state_->header) return;
  StreamHeader header{.skeleton = state_->motion.shared_skeleton(),
                      .rate = state_->motion.rate(),
                      .tracks = {},
                      .layout_from = made.layout_from,
                      .declarations = made.result.declarations};
  for (const ScalarTrack& track : state_->motion.tracks()) header.tracks.push_back(track.name);
  state_->header = std::move(header);
}
void Player::append(const Utterance& utterance) {
  sign(utterance);
}
void Player::pause() noexcept {
  state_->paused = true;
}
void Player::resume() noexcept {
  state_->paused = false;
}
void Player::seek(Milliseconds) {
  state_->at = 0;
}
void Player::set_tempo(double) {}
void Player::set_loop(bool) noexcept {}
void Player::stop() {
  state_->at = state_->motion.frame_count();
}
const StreamHeader* Player::header() const noexcept {
  return state_->header ? &*state_->header : nullptr;
}
std::size_t Player::prepare(std::size_t) {
  return static_cast<std::size_t>(state_->motion.frame_count() - state_->at);
}
bool Player::next(MutableFrameView out) noexcept {
  State& state = *state_;
  if (state.paused || state.at >= state.motion.frame_count()) return false;
  const PoseView pose = std::as_const(state.motion).pose(state.at);
  std::ranges::copy(pose.rotations, out.pose.rotations.begin());
  std::ranges::copy(pose.translations, out.pose.translations.begin());
  for (std::size_t i = 0; i < out.tracks.size(); ++i) {
    out.tracks[i] = state.motion.tracks()[i].values[static_cast<std::size_t>(state.at)];
  }
  ++state.at;
  ++state.frame;
  return true;
}
std::uint64_t Player::frame() const noexcept {
  return state_->frame;
}
std::optional<PlayerEvent> Player::take_event() noexcept {
  return std::nullopt;
}
bool Player::paused() const noexcept {
  return state_->paused;
}
bool Player::idle() const noexcept {
  return state_->at >= state_->motion.frame_count();
}

}  // namespace signweave
