// Trains the model of `signweave segment` and reports its quality. docs/segmenting.md shows its use.
//
//   train_segmenter FOLDER                     prints the scores with a user left out and with a file left out
//   train_segmenter FOLDER --write FILE.inc    trains on everything and writes the weights
#include <fmt/format.h>

#include <fstream>
#include <iostream>

#include "tools/phase_score.h"

namespace {

using namespace signweave;

void write_weights(const std::string& path, const PhaseModel& model) {
  constexpr std::size_t kWidth = 2000;  // long lines, which keep the generated file small
  std::string text =
      "// Made by tools/train_segmenter.cpp from \"Gesture Phase Segmentation\" (Madeo, Wagner, Peres 2014).\n";
  std::string line;
  for (const int number : packed(model)) {
    line += fmt::format("{},", number);
    if (line.size() < kWidth) continue;
    text += line + '\n';
    line.clear();
  }
  text += line + '\n';
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw Error(ErrorCode::io, path + ": cannot be written");
  std::cout << fmt::format("{}: {} bytes\n", path, text.size());
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() != 1 && !(words.size() == 3 && words[1] == "--write")) {
    std::cerr << "usage: train_segmenter FOLDER [--write FILE.inc]\n";
    return 2;
  }
  try {
    const std::vector<LabelledTrack> recordings = read_gesture_phases(words[0]);
    if (words.size() == 3) {
      std::vector<const LabelledTrack*> all;
      for (const LabelledTrack& recording : recordings) all.push_back(&recording);
      write_weights(words[2], train(all));
      return 0;
    }
    std::cout << "F1 of each phase, frame by frame\n"
              << table_of(score_users_left_out(recordings)) << '\n'
              << table_of(score_files_left_out(recordings));
  } catch (const std::exception& error) {
    std::cerr << "train_segmenter: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
