// synthetic_signer: writes the demo corpus, a weather forecast and a list of cities after the paper's section 5.1.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "demo/corpus.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/error.h"
#include "signweave/formats/bvh.h"
#include "signweave/formats/eaf.h"
#include "signweave/formats/face_csv.h"

namespace {

using namespace signweave;

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void write_corpus(const std::filesystem::path& folder, FrameRate rate, std::uint64_t seed, bool sheets) {
  std::error_code refused;
  std::filesystem::create_directories(folder, refused);
  if (refused) throw Error(ErrorCode::io, folder.string() + ": " + refused.message() + "; name a folder you may write");
  for (const demo::Script& script : {demo::meteo(), demo::villes()}) {
    const demo::SyntheticRecording recording = demo::make_recording(script, rate, seed);
    const auto path = [&](const char* ending) { return folder / (recording.name + ending); };
    bvh::write(path(".bvh"), recording.motion, bvh::default_layout(recording.motion.skeleton()));
    eaf::write(path(".eaf"), recording.document);
    write_file(path(".truth.csv"), recording.truth);
    if (!recording.motion.tracks().empty()) write_file(path(".face.csv"), face_csv::write_text(recording.motion));
    if (sheets) write_file(path(".svg"), demo::stroke_sheet(recording));
    fmt::print("{}: {} signs, {} frames, {:.1f} s\n", recording.name, recording.timeline.signs.size(),
               recording.motion.frame_count(), recording.motion.duration().count());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Writes a made corpus: meteo and villes as .bvh, .eaf and .truth.csv.\n"
      "The shapes are placeholders, not signs of LSF.\n"
      "Example: synthetic_signer out/corpus --seed 7"};
  std::string folder;
  std::uint64_t seed = 1;
  std::string rate_text = "100";
  bool sheets = false;
  app.add_option("OUT_FOLDER", folder, "where the files go; made where it does not exist")->required();
  app.add_option("--seed", seed, "another seed makes another recording of the same signs")->capture_default_str();
  app.add_option("--rate", rate_text, "frames a second")->capture_default_str();
  app.add_flag("--sheets", sheets, "also meteo.svg and villes.svg: stick figures of every stroke");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const std::optional<FrameRate> rate = parse_frame_rate(rate_text);
    if (!rate) {
      throw Error(ErrorCode::bad_input, "--rate '" + rate_text + "': no frame rate; give frames a second, such as 100");
    }
    write_corpus(folder, *rate, seed, sheets);
  } catch (const Error& error) {
    fmt::print(stderr, "synthetic_signer: {}\n", error.what());
    return 1;
  }
  return 0;
}
