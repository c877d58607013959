#include "app/server/frame_sender.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/server/stream_text.h"
#include "signweave/choose/missing_glosses.h"
#include "signweave/core/prefetch.h"

namespace signweave::server {
namespace {

constexpr unsigned kBinary = 2;
constexpr std::size_t kRoomForHeader = 10;  // of a WebSocket frame, at most
/// A client with more unread text than this is sent no events.
constexpr std::size_t kMostEvents = 16 * 1024;
/// A frame later than this is dropped: after a delay, a viewer wants to see what is signed now.
constexpr std::chrono::milliseconds kStale{100};
/// How long a client that accepts everything may keep others waiting.
constexpr std::chrono::milliseconds kFastTurn{1};
/// The most consecutive places that cannot be signed and are reported in one turn; further ones follow in the next.
constexpr int kMostFaults = 16;

std::size_t batch_of(std::size_t wanted, std::size_t frame_bytes, std::size_t message_bytes) {
  return std::clamp<std::size_t>((message_bytes - kMessageHeaderBytes) / std::max<std::size_t>(frame_bytes, 1), 1,
                                 wanted);
}

}  // namespace

FrameSender::FrameSender(IoThread& thread, ServedDatabase& database, StreamSocket& out, const StreamOptions& options)
    : thread_(thread),
      out_(out),
      player_(database.signing(), options.player),
      batch_(options.batch),
      pace_(options.pace),
      database_(database.name()),
      served_(database) {
  if (!options.character.empty()) character_ = thread.context.databases.characters.at(options.character);
}

FrameSender::~FrameSender() {
  thread_.pacer.forget(*this);
}

void FrameSender::stop() noexcept {
  stopped_ = true;
  flowing_ = false;
  thread_.pacer.forget(*this);
}

/// The utterance of a message, with all its glosses known. Throws MissingGlosses.
Utterance FrameSender::found(const ControlMessage& message) {
  const std::shared_ptr<const Segments> segments = served_.database().segments();
  if (!message.folds) {
    require_glosses(message.utterance, *segments);
    return message.utterance;
  }
  std::vector<Notice> notices;
  Utterance utterance = with_folded_glosses(message.utterance, *segments, notices);
  for (Notice& notice : notices) {
    out_.send_text(
        event_text({.kind = PlayerEvent::Kind::notice, .frame = player_.frame(), .text = std::move(notice.text)}));
  }
  return utterance;
}

void FrameSender::control(const ControlMessage& message) {
  was_idle_ = player_.idle();
  const Clock::time_point now = Clock::now();
  switch (message.control) {
    case Control::sign:
      player_.sign(found(message));
      break;
    case Control::append:
      player_.append(found(message));
      break;
    case Control::pause:
      player_.pause();
      break;
    case Control::resume:
      player_.resume();
      break;
    case Control::seek:
      player_.seek(message.at);
      break;
    case Control::tempo:
      player_.set_tempo(message.tempo);
      break;
    case Control::loop:
      player_.set_loop(message.loop);
      break;
    case Control::stop:
      player_.stop();
      break;
    case Control::open:
    case Control::score:
    case Control::ping:
      return;
  }
  const bool glosses = message.control == Control::sign || message.control == Control::append;
  if (glosses && (message.control == Control::sign || was_idle_)) asked_ = now;
  first_ = true;
}

void FrameSender::go() {
  if (stopped_) return;
  if (player_.paused()) {
    flowing_ = false;
    thread_.pacer.wake_at(*this, kNever);
    return;
  }
  prepare(1);
  if (!announced_) return;
  if (pace_ == Pace::fast) {
    if (send_fast()) thread_.pacer.want_work(*this);
    return;
  }
  // If the player was idle, the first frame of new glosses is sent now; otherwise the pace is unchanged.
  const Clock::time_point now = Clock::now();
  if (!flowing_ || (was_idle_ && asked_ != kNever)) start_clock(now);
  thread_.pacer.wake_at(*this, tick(now));
}

void FrameSender::drained() {
  if (!stopped_ && pace_ == Pace::fast) thread_.pacer.want_work(*this);
}

Clock::time_point FrameSender::due() const noexcept {
  const Seconds since = static_cast<double>(since_) * rate_.frame_time();
  return start_ + std::chrono::duration_cast<Clock::duration>(since);
}

void FrameSender::start_clock(Clock::time_point now) noexcept {
  flowing_ = true;
  start_ = now;
  since_ = 0;
}

void FrameSender::passed(std::size_t frames) noexcept {
  since_ += static_cast<std::int64_t>(frames);
  while (since_ >= rate_.numerator) {  // whole seconds, so that rounding errors do not accumulate
    since_ -= rate_.numerator;
    start_ += std::chrono::seconds(rate_.denominator);
  }
}

void FrameSender::prefetch(Step step) const noexcept {
  if (step == Step::near) {
    player_.prefetch_state();
    out_.prefetch();
    signweave::prefetch(message_.data(), std::min<std::size_t>(message_.size(), 1'024));
    signweave::prefetch(&event_, sizeof event_);
  } else {
    player_.prefetch_frame();
  }
}

Clock::time_point FrameSender::tick(Clock::time_point now) noexcept {
  const Clock::time_point next = send_due(now);
  if (next == kNever ? starved_ : ready_ < ahead_ / 4) thread_.pacer.want_work(*this);
  return next;
}

Clock::time_point FrameSender::send_due(Clock::time_point now) noexcept {
  if (!flowing_ || stopped_) return kNever;
  Metrics& metrics = thread_.metrics;
  Clock::time_point at = due();
  while (at <= now) {
    const auto next =
        at + std::chrono::duration_cast<Clock::duration>(static_cast<double>(batch_) * rate_.frame_time());
    out_.settle();  // if two messages of this stream are due
    const bool keep = out_.idle() && (now - at <= kStale || next > now);
    const std::uint64_t first = player_.frame();
    const std::size_t frames = take(batch_, keep);
    if (frames == 0) {
      flowing_ = false;
      starved_ = !player_.paused();
      return kNever;
    }
    const Seconds late = Clock::now() - at;
    metrics.ticks.add();
    metrics.lateness.observe(late.count());
    if (late > rate_.frame_time() / 2) metrics.late.add();
    if (keep) {
      send(frames, first);
    } else {
      left_out_ += static_cast<std::uint32_t>(frames);
      metrics.left_out.add(frames);
    }
    passed(frames);
    at = due();
  }
  return at;
}

bool FrameSender::work() {
  if (stopped_ || player_.paused()) return false;
  if (pace_ == Pace::fast) return send_fast();
  prepare(ahead_);
  if (flowing_ || !announced_ || ready_ == 0) return false;
  // The clock had stopped because no frames were ready: it continues now.
  if (std::exchange(starved_, false)) thread_.metrics.starved.add();
  const Clock::time_point now = Clock::now();
  start_clock(now);
  thread_.pacer.wake_at(*this, send_due(now));
  return false;
}

bool FrameSender::send_fast() {
  const Clock::time_point end = Clock::now() + kFastTurn;
  while (announced_ && out_.idle()) {
    const std::uint64_t number = player_.frame();
    // The first frame does not wait until a batch is full.
    std::size_t frames = take(batch_, true);
    while (frames < batch_ && !(first_ && frames > 0) && !player_.idle()) {
      prepare(std::min(batch_ - frames, Player::kMostReady));
      const std::size_t more = take(batch_ - frames, true, frames);
      if (more == 0) break;
      frames += more;
    }
    if (frames == 0) {
      send_events();
      return false;
    }
    send(frames, number);
    if (Clock::now() >= end) return out_.idle();
  }
  return false;
}

std::size_t FrameSender::take(std::size_t most, bool keep, std::size_t after) noexcept {
  std::byte* to = message_.data() + kRoomForHeader + kMessageHeaderBytes + after * frame_bytes_;
  const MutableFrameView room{pose_.view(), tracks_};
  for (std::size_t taken = 0; taken < most; ++taken) {
    if (!event_) event_ = player_.take_event();
    if (event_) {
      // An event is sent right before the message that begins with its frame, so frames already taken are sent first.
      if (taken + after > 0) return taken;
      send_events();
    }
    // With Pace::fast nothing is sent while the signer is idle.
    std::optional<FrameView> frame;
    if (pace_ == Pace::live || !player_.idle()) frame = player_.next_in(room);
    if (!frame) {
      ready_ = 0;
      return taken;
    }
    if (ready_ > 0) --ready_;
    if (!keep) continue;
    if (retargeter_) {
      retargeter_->pose(frame->pose, shown_.view());
      frame->pose = shown_.view();
    }
    encode(*frame, {to + taken * frame_bytes_, frame_bytes_});
  }
  return most;
}

void FrameSender::send(std::size_t frames, std::uint64_t first) noexcept {
  std::byte* const header = message_.data() + kRoomForHeader;
  const std::size_t size = kMessageHeaderBytes + frames * frame_bytes_;
  encode(MessageHeader{.frames = static_cast<std::uint16_t>(frames), .left_out = left_out_, .first_frame = first},
         {header, kMessageHeaderBytes});
  const std::size_t before = write_frame_header(header, kBinary, size);
  out_.send_frame({header - before, before + size});
  Metrics& metrics = thread_.metrics;
  metrics.frames.add(frames);
  metrics.messages.add();
  metrics.bytes.add(before + size);
  first_ = false;
  if (asked_ != kNever) {
    metrics.first_frame.observe(Seconds(Clock::now() - asked_).count());
    asked_ = kNever;
  }
}

void FrameSender::prepare(std::size_t frames) {
  const Clock::time_point begin = Clock::now();
  for (int fault = 0; fault < kMostFaults; ++fault) {
    try {
      ready_ = player_.prepare(frames);
      break;
    } catch (const Error& error) {  // of one place, which is skipped; the next call continues
      out_.send_text(error_text(error, {}));
    } catch (const std::exception& error) {  // such as lack of memory: this stream cannot continue, others can
      out_.send_text(error_text(ErrorCode::io, error.what(), {}));
      stop();
      return;
    }
  }
  thread_.metrics.prepare.observe(Seconds(Clock::now() - begin).count());
  announce();
  if (ready_ == 0) send_events();
}

void FrameSender::announce() {
  const StreamHeader* header = player_.header();
  if (announced_ || header == nullptr) return;
  StreamHeader shown = *header;
  if (character_) {
    std::shared_ptr<const calls::SignerStance> stance;
    try {
      stance = served_.stance(served_.database().contents(), header->layout_from);
    } catch (const Error& error) {  // its motion is damaged, or was removed
      out_.send_text(error_text(error, {}));
      return stop();
    }
    RetargetOptions options = options_for(stance->frames, stance->signer, character_->character);
    options.face_joints = header->tracks.empty();
    retargeter_ = std::make_unique<Retargeter>(*header->skeleton, stance->signer, character_->character, options);
    shown.skeleton = character_->character.skeleton;
    shown_ = Pose(*shown.skeleton);
  }
  announced_ = true;
  shape_ = shown.shape();
  frame_bytes_ = bytes_of(shape_);
  rate_ = header->rate;
  batch_ = batch_of(batch_, frame_bytes_, thread_.context.options.limits.message_bytes);
  message_.resize(kRoomForHeader + kMessageHeaderBytes + batch_ * frame_bytes_);
  pose_ = Pose(*header->skeleton);
  tracks_.resize(shape_.tracks);
  const auto half_second = static_cast<std::size_t>(rate_.hertz() / 2);
  ahead_ = std::clamp<std::size_t>(std::max(half_second, 2 * batch_), 64, Player::kMostReady);
  out_.send_text(header_text(shown, {.database = database_,
                                     .character = character_ ? character_->name : std::string_view(),
                                     .pace = pace_,
                                     .batch = batch_}));
}

void FrameSender::send_events() {
  for (; event_ || (event_ = player_.take_event()); event_.reset()) {
    if (out_.unread() > kMostEvents) {
      ++events_left_out_;
      continue;
    }
    if (events_left_out_ > 0) {
      const PlayerEvent notice{.frame = event_->frame,
                               .at = event_->at,
                               .text = fmt::format("{} events were left out", std::exchange(events_left_out_, 0))};
      out_.send_text(event_text(notice));
    }
    out_.send_text(event_text(*event_));
  }
}

}  // namespace signweave::server
