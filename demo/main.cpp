// synthetic_signer: writes the demo corpus: a weather forecast and a list of cities after the paper's section 5.1, and
// further recordings of the same kinds.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "demo/channels.h"
#include "demo/corpus.h"
#include "demo/sheets.h"
#include "demo/space.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/error.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/formats/face/face_csv.h"

namespace {

using namespace signweave;

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

struct CorpusOptions {
  FrameRate rate;
  std::uint64_t seed = 1;
  double minutes = 44;
  bool channels = false;
  bool space = false;
  bool sheets = false;
};

void write_recording(const std::filesystem::path& folder, const demo::SyntheticRecording& recording, bool sheets) {
  const auto path = [&](const char* extension) { return folder / (recording.name + extension); };
  bvh::write(path(".bvh"), recording.motion, bvh::default_layout(recording.motion.skeleton()));
  eaf::write(path(".eaf"), recording.document);
  write_file(path(".truth.csv"), recording.truth);
  if (!recording.space.empty()) write_file(path(".space.csv"), recording.space);
  if (!recording.motion.tracks().empty()) write_file(path(".face.csv"), face_csv::write_text(recording.motion));
  if (sheets) {
    write_file(path(".svg"), demo::stroke_sheet(recording));
    write_file(path(".sentence.svg"), demo::sentence_sheet(recording, 1));
    write_file(path(".side.svg"), demo::sentence_sheet(recording, 1, 75));
  }
  fmt::print("{}: {} signs, {} frames, {:.1f} s\n", recording.name, recording.timeline.signs.size(),
             recording.motion.frame_count(), recording.motion.duration().count());
}

/// Generates one recording after another, so that only one is in memory.
void write_corpus(const std::filesystem::path& folder, const CorpusOptions& options) {
  std::error_code refused;
  std::filesystem::create_directories(folder, refused);
  if (refused) throw Error(ErrorCode::io, folder.string() + ": " + refused.message() + "; name a writable folder");
  if (options.sheets) write_file(folder / "handshapes.svg", demo::handshape_sheet());
  double seconds = 0;
  std::size_t count = 0;
  const auto write = [&](const demo::SyntheticRecording& recording) {
    write_recording(folder, recording, options.sheets);
    seconds += recording.motion.duration().count();
    ++count;
  };
  if (options.space) {
    for (const demo::SpaceScript& script : {demo::espace_index(), demo::espace_verbes(1), demo::espace_verbes(2)}) {
      write(demo::make_space(script, options.rate, options.seed));
    }
  } else if (options.channels) {
    for (const demo::ChannelScript& script : {demo::mains(), demo::visage()}) {
      write(demo::make_channels(script, options.rate, options.seed));
    }
  } else {
    for (const demo::Script& script : demo::corpus_scripts(options.minutes)) {
      write(demo::make_recording(script, options.rate, options.seed));
    }
  }
  fmt::print("{} recordings, {:.1f} minutes\n", count, seconds / 60);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Writes a synthetic corpus, meteo and villes and more, each as .bvh, .eaf, .face.csv\n"
      "and .truth.csv (the ground truth).\n"
      "The shapes are placeholders, not signs of LSF.\n"
      "Example: synthetic_signer out/corpus --seed 7"};
  std::string folder;
  CorpusOptions options;
  std::string rate_text = "100";
  app.add_option("OUT_FOLDER", folder, "output folder; created if it does not exist")->required();
  app.add_option("--seed", options.seed, "random seed; another seed gives another recording of the same signs")
      ->capture_default_str();
  app.add_option("--rate", rate_text, "frames per second")->capture_default_str();
  app.add_option("--minutes", options.minutes, "total length of all recordings; 2 gives meteo and villes only")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 10'000.0));
  app.add_flag(
      "--channels", options.channels,
      "write the two recordings mains and visage instead, in which hands, mouth, brows, head and gaze have times "
      "of their own");
  app.add_flag(
         "--space", options.space,
         "write the recordings espace_index, espace_verbes_1 and espace_verbes_2 instead, whose signs are aimed at "
         "places in the signing space")
      ->excludes("--channels");
  app.add_flag(
      "--sheets", options.sheets,
      "also write contact sheets (.svg): every stroke, a sentence from the front and from the side, handshapes");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const std::optional<FrameRate> rate = parse_frame_rate(rate_text);
    if (!rate) {
      throw Error(ErrorCode::bad_input,
                  "--rate '" + rate_text + "' is not a frame rate; give frames per second, such as 100");
    }
    options.rate = *rate;
    write_corpus(folder, options);
  } catch (const Error& error) {
    fmt::print(stderr, "synthetic_signer: {}\n", error.what());
    return 1;
  }
  return 0;
}
