// From a folder of recordings to a signed utterance.
//
//   quickstart FOLDER DATABASE OUT.bvh
#include <signweave/signweave.h>

#include <iostream>

int main(int argc, char** argv) {
  using namespace signweave;
  if (argc != 4) {
    std::cerr << "usage: quickstart FOLDER DATABASE OUT.bvh\n";
    return 2;
  }
  try {
    std::filesystem::remove_all(argv[2]);
    Database::create(argv[2], {});
    Database database(argv[2], kv::Access::read_write);
    for (const ImportJob& job : pair_files({argv[1]}).jobs) {
      const ImportReport report = import_recording(database, job, {});
      std::cout << job.name << ": " << report.frames << " frames, " << report.signs << " signs\n";
    }

    for (const Segment& stroke : database.find(parse("gloss = \"VANNES\" & phase = stroke"))) {
      std::cout << stroke.recording << ' ' << stroke.span.begin.count()
                << " ms: " << database.read(stroke).frame_count() << " frames\n";
    }

    const Synthesized made = synthesize(database, parse_utterance("VANNES MATIN PLUIE"));
    save(made.result, {argv[3]});
    std::cout << made.result.motion.frame_count() << " frames, " << made.result.junctions.size() << " junctions\n";
  } catch (const Error& error) {
    std::cerr << "quickstart: " << error.what() << '\n';
    return 1;
  }
}
