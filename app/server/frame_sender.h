#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/server/context.h"
#include "app/server/control_message.h"
#include "app/server/served_database.h"
#include "app/server/stream_socket.h"
#include "signweave/live/frame_codec.h"
#include "signweave/live/player.h"
#include "signweave/retarget/retarget.h"

namespace signweave::server {

/// Sends the frames of a player to one client, at their time or as fast as the client accepts them. At most one
/// message of frames is being sent; frames that fall due meanwhile are taken from the player and dropped. Belongs to
/// its I/O thread; the socket must outlive it.
/// More than fifteen members: one object per stream, which keeps together what each frame needs.
class FrameSender final : public Paced {
 public:
  FrameSender(IoThread& thread, ServedDatabase& database, StreamSocket& out, const StreamOptions& options);
  ~FrameSender() override;

  /// Executes a message other than "open", "score" and "ping". Throws what the player throws; then nothing has changed.
  void control(const ControlMessage& message);
  /// To be called after a message was answered: sends what can be sent now.
  void go();
  /// Called when everything queued on the socket has been sent.
  void drained();
  /// Stops sending.
  void stop() noexcept;
  std::uint64_t frame() const noexcept { return player_.frame(); }
  std::optional<ShownScore> score(std::size_t most_clips) const { return player_.score(most_clips); }

  Clock::time_point tick(Clock::time_point now) noexcept override;
  bool work() override;
  void prefetch(Step step) const noexcept override;

 private:
  Clock::time_point due() const noexcept;
  Clock::time_point send_due(Clock::time_point now) noexcept;
  void start_clock(Clock::time_point now) noexcept;
  void passed(std::size_t frames) noexcept;
  Utterance found(const ControlMessage& message);
  void prepare(std::size_t frames);
  void announce();
  void send_events();
  std::size_t take(std::size_t most, bool keep, std::size_t after = 0) noexcept;
  void send(std::size_t frames, std::uint64_t first) noexcept;
  bool send_fast();

  // Members needed for each frame come first and are adjacent in memory (Paced::kNearBytes).
  IoThread& thread_;
  StreamSocket& out_;
  Player player_;
  std::vector<std::byte> message_;  // room for a WebSocket header, the message's header, the frames
  std::size_t batch_;
  std::size_t frame_bytes_ = 0;
  // Frame `since_` after `start_` is due at start_ + since_ / rate.
  Clock::time_point start_;
  std::int64_t since_ = 0;
  FrameRate rate_;
  std::size_t ready_ = 0;             // frames known to be ready
  std::size_t ahead_ = 64;            // frames computed at a time
  Clock::time_point asked_ = kNever;  // when glosses arrived whose first frame is still to be sent
  std::uint32_t left_out_ = 0;
  Pace pace_;
  bool flowing_ = false;    // the clock is running
  bool starved_ = false;    // the clock stopped because no frames were ready
  bool first_ = true;       // nothing was sent since a control message
  bool announced_ = false;  // the header was sent
  bool stopped_ = false;
  std::optional<PlayerEvent> event_;  // the next event to report

  std::string database_;
  bool was_idle_ = true;
  FrameShape shape_;
  ServedDatabase& served_;
  calls::SharedCharacter character_;        // the character whose joints the frames have; null: the recording's
  std::unique_ptr<Retargeter> retargeter_;  // onto the character
  Pose shown_;                              // the frame on the character
  Pose pose_;                               // a frame that the player has still to compute
  std::vector<float> tracks_;
  std::size_t events_left_out_ = 0;
};

}  // namespace signweave::server
