// From a folder of recordings to a signed utterance: the whole way through the library, read from top to bottom.
//
//   quickstart FOLDER DATABASE OUT.bvh
#include <filesystem>
#include <iostream>

#include "signweave/choose/synthesizer.h"
#include "signweave/database/database.h"
#include "signweave/database/import.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/query/parse.h"

int main(int argc, char** argv) {
  using namespace signweave;
  if (argc != 4) {
    std::cerr << "usage: quickstart FOLDER DATABASE OUT.bvh\n";
    return 2;
  }
  try {
    // 1. An empty database, and the recordings of a folder in it.
    std::filesystem::remove_all(argv[2]);
    Database::create(argv[2], {});
    Database database(argv[2], kv::Access::read_write);
    for (const ImportJob& job : pair_files({argv[1]}).jobs) {
      const ImportReport report = import_recording(database, job, {});
      std::cout << job.name << ": " << report.frames << " frames, " << report.signs << " signs\n";
    }

    // 2. Find: a query on the semantic side gives segments, a segment gives frames.
    const std::vector<Segment> strokes = database.find(parse("gloss = \"VANNES\" & phase = stroke"));
    for (const Segment& stroke : strokes) {
      std::cout << stroke.recording << ' ' << stroke.span.begin.count()
                << " ms: " << database.read(stroke).frame_count() << " frames\n";
    }

    // 3. Sign: glosses in, motion out.
    const Synthesized made = synthesize(database, parse_utterance("VANNES MATIN PLUIE"));
    const RecordingInfo source = *database.info(made.layout_from);
    bvh::write(argv[3], made.result.motion,
               source.layout ? *source.layout : bvh::default_layout(made.result.motion.skeleton()));
    std::cout << made.result.motion.frame_count() << " frames, " << made.result.junctions.size() << " junctions\n";
  } catch (const Error& error) {
    std::cerr << "quickstart: " << error.what() << '\n';
    return 1;
  }
}
