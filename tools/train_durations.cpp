// Reports how well the duration of a transition can be predicted from the task of the hands. docs/durations.md shows
// the results.
//
//   train_durations FOLDER    of "Gesture Phase Segmentation" (its raw/ contains *_raw.csv); one user left out
#include <fmt/format.h>

#include <iostream>

#include "tools/duration_training.h"

namespace {

using namespace signweave;

double ms(Seconds time) {
  return 1000.0 * time.count();
}

void print(const char* name, const DurationScores& scores) {
  std::cout << fmt::format("{:<28}{:>5}{:>8.0f}{:>8.0f}{:>12.0f}{:>8.0f}\n", name, scores.count, ms(scores.mean),
                           ms(scores.median), ms(scores.log_linear), ms(scores.fitted));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: train_durations FOLDER\n";
    return 2;
  }
  try {
    const std::vector<LabelledTrack> tracks = read_gesture_phases(argv[1]);
    std::cout << "mean absolute error, ms; one user left out\n"
              << fmt::format("{:<28}{:>5}{:>8}{:>8}{:>12}{:>8}\n", "", "n", "mean", "median", "log-linear", "fitted");
    print("movements", score_users_left_out(transitions_of(tracks, Between::movements)));
    print("preparations alone", score_users_left_out(transitions_of(tracks, Between::preparations)));
    print("from stroke to stroke", score_users_left_out(transitions_of(tracks, Between::strokes)));
    const HandLags lags = hand_lags_of(tracks);
    std::cout << fmt::format(
        "\nthe hand that goes at most half as far, in {} movements of both: begins {:+.0f} ms (±{:.0f}), ends {:+.0f} "
        "ms "
        "(±{:.0f}) "
        "after the other\n",
        lags.count, ms(lags.begin), ms(lags.begin_spread), ms(lags.end), ms(lags.end_spread));
  } catch (const std::exception& error) {
    std::cerr << "train_durations: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
