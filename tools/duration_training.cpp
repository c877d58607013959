#include "tools/duration_training.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

/// Kinect positions are noisy: each is the mean of five frames, and a velocity is taken over five.
constexpr std::size_t kSmooth = 2;

struct Path {
  std::vector<Eigen::Vector3f> places;      ///< [frame] metres from the spine
  std::vector<Eigen::Vector3f> velocities;  ///< metres per second
};

bool torn(const LabelledTrack& track, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    if (track.track.times[i + 1] - track.track.times[i] > kTornStep) return true;
  }
  return false;
}

/// The frames around one frame, not beyond a gap.
struct Window {
  std::size_t first;
  std::size_t last;
};
Window window_at(const LabelledTrack& track, std::size_t frame) {
  Window window{frame - std::min(frame, kSmooth), std::min(frame + kSmooth, track.labels.size() - 1)};
  while (torn(track, window.first, frame)) ++window.first;
  while (torn(track, frame, window.last)) --window.last;
  return window;
}

Path path_of(const LabelledTrack& track, std::size_t side) {
  Path path;
  const std::size_t frames = track.labels.size();
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const Window window = window_at(track, frame);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = window.first; i <= window.last; ++i) {
      sum += track.track.bodies[i].hands[side] - track.track.bodies[i].spine;
    }
    path.places.push_back(sum / static_cast<float>(window.last - window.first + 1));
  }
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const Window window = window_at(track, frame);
    const double seconds = (track.track.times[window.last] - track.track.times[window.first]).count();
    path.velocities.push_back(seconds > 0 ? Eigen::Vector3f((path.places[window.last] - path.places[window.first]) /
                                                            static_cast<float>(seconds))
                                          : Eigen::Vector3f::Zero());
  }
  return path;
}

/// The frames that enclose a transition: the last before it and the first after it.
struct Borders {
  std::size_t before;
  std::size_t after;
};
std::vector<Borders> borders_in(const LabelledTrack& track, Between what) {
  const auto inside = [&](MotionPhase phase) {
    return phase == MotionPhase::preparation || (phase == MotionPhase::retraction && what != Between::preparations) ||
           (phase == MotionPhase::hold && what == Between::strokes);
  };
  std::vector<Borders> result;
  for (std::size_t frame = 1; frame < track.labels.size(); ++frame) {
    if (!inside(track.labels[frame]) || inside(track.labels[frame - 1])) continue;
    std::size_t after = frame;
    while (after < track.labels.size() && inside(track.labels[after])) ++after;
    if (after == track.labels.size() || torn(track, frame - 1, after)) continue;
    const bool strokes = track.labels[frame - 1] == MotionPhase::stroke && track.labels[after] == MotionPhase::stroke;
    if (what != Between::strokes || strokes) result.push_back({frame - 1, after});
  }
  return result;
}

HandTask task_of(const Path& path, Borders at) {
  const Eigen::Vector3f displacement = path.places[at.after] - path.places[at.before];
  HandTask task{.known = true,
                .distance = displacement.norm(),
                .speed_before = path.velocities[at.before].norm(),
                .speed_after = path.velocities[at.after].norm()};
  if (task.distance > 1e-6f) {
    task.approach = (path.velocities[at.before] + path.velocities[at.after]).dot(displacement) / task.distance;
  }
  return task;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Eigen::Vector4d log_linear_inputs(const TransitionTask& task) {
  const HandTask& hand = task.hands[task.hands[1].distance >= task.hands[0].distance ? 1 : 0];
  return {1.0, std::log(static_cast<double>(hand.distance) + 0.02), static_cast<double>(hand.speed_before),
          static_cast<double>(hand.speed_after)};
}

Eigen::Vector4d log_linear(std::span<const TimedTransition> rows) {
  Eigen::Matrix4d squares = 1e-6 * Eigen::Matrix4d::Identity();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const TimedTransition& row : rows) {
    const Eigen::Vector4d x = log_linear_inputs(row.task);
    squares += x * x.transpose();
    right += std::log(row.duration.count()) * x;
  }
  return squares.ldlt().solve(right);
}

}  // namespace

std::vector<TimedTransition> transitions_of(std::span<const LabelledTrack> tracks, Between what) {
  std::vector<TimedTransition> result;
  for (const LabelledTrack& track : tracks) {
    const std::array<Path, 2> paths = {path_of(track, 0), path_of(track, 1)};
    for (const Borders& at : borders_in(track, what)) {
      TimedTransition one{.duration = track.track.times[at.after] - track.track.times[at.before],
                          .recording = static_cast<std::size_t>(track.user())};
      for (std::size_t side = 0; side < 2; ++side) one.task.hands[side] = task_of(paths[side], at);
      result.push_back(one);
    }
  }
  return result;
}

DurationScores score_users_left_out(std::span<const TimedTransition> transitions) {
  DurationScores scores{.count = transitions.size()};
  std::vector<std::size_t> users;
  for (const TimedTransition& one : transitions) {
    if (std::ranges::find(users, one.recording) == users.end()) users.push_back(one.recording);
  }
  for (const std::size_t user : users) {
    std::vector<TimedTransition> others;
    std::vector<double> seconds;
    for (const TimedTransition& one : transitions) {
      if (one.recording == user) continue;
      others.push_back(one);
      seconds.push_back(one.duration.count());
    }
    if (others.empty()) continue;
    const DurationFit fit = fit_durations(others);
    const Seconds median(median_of(seconds));
    const Eigen::Vector4d weights = log_linear(others);
    for (const TimedTransition& one : transitions) {
      if (one.recording != user) continue;
      const auto error = [&](Seconds predicted) { return Seconds(std::abs((predicted - one.duration).count())); };
      scores.mean += error(fit.mean);
      scores.median += error(median);
      scores.log_linear += error(Seconds(std::exp(weights.dot(log_linear_inputs(one.task)))));
      scores.fitted += error(duration_of(fit, one.task));
    }
  }
  const double count = std::max(1.0, static_cast<double>(scores.count));
  for (Seconds* score : {&scores.mean, &scores.median, &scores.log_linear, &scores.fitted}) *score /= count;
  return scores;
}

HandLags hand_lags_of(std::span<const LabelledTrack> tracks) {
  constexpr float kMoves = 0.05f;      // minimum distance a hand moves, metres
  constexpr float kOfItsPeak = 0.25f;  // fraction of its peak speed below which a hand has not begun or has arrived
  std::vector<double> begins;
  std::vector<double> ends;
  for (const LabelledTrack& track : tracks) {
    const std::array<Path, 2> paths = {path_of(track, 0), path_of(track, 1)};
    for (const Borders& at : borders_in(track, Between::movements)) {
      std::array<Seconds, 2> begin{};
      std::array<Seconds, 2> end{};
      std::array<float, 2> distance{};
      for (std::size_t side = 0; side < 2; ++side) {
        const Path& path = paths[side];
        distance[side] = (path.places[at.after] - path.places[at.before]).norm();
        float peak = 0;
        for (std::size_t i = at.before; i <= at.after; ++i) peak = std::max(peak, path.velocities[i].norm());
        std::size_t first = at.before;
        std::size_t last = at.after;
        while (first < last && path.velocities[first].norm() < kOfItsPeak * peak) ++first;
        while (first < last && path.velocities[last].norm() < kOfItsPeak * peak) --last;
        begin[side] = track.track.times[first];
        end[side] = track.track.times[last];
      }
      if (std::min(distance[0], distance[1]) < kMoves ||
          2 * std::min(distance[0], distance[1]) > std::max(distance[0], distance[1]))
        continue;
      const std::size_t less = distance[1] < distance[0] ? 1 : 0;
      begins.push_back((begin[less] - begin[1 - less]).count());
      ends.push_back((end[less] - end[1 - less]).count());
    }
  }
  const auto spread = [](std::vector<double> values) {
    if (values.empty()) return Seconds(0);
    std::ranges::sort(values);
    return Seconds(0.5 * (values[values.size() * 3 / 4] - values[values.size() / 4]));
  };
  return {.count = begins.size(),
          .begin = Seconds(median_of(begins)),
          .end = Seconds(median_of(ends)),
          .begin_spread = spread(begins),
          .end_spread = spread(ends)};
}

}  // namespace signweave
