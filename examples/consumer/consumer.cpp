// A program of one's own on the installed library: store a recording made in memory, and find a sign in it.
#include <signweave/signweave.h>

#include <iostream>

int main(int argc, char** argv) {
  using namespace signweave;
  if (argc != 2) return 2;
  try {
    const auto skeleton = std::make_shared<const Skeleton>(
        std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true}, {"Hand", 0, {0.5f, 0, 0}, false}}, std::vector<Tip>{});
    AnnotationDocument document;
    document.types = {{"gloss", Stereotype::none, {}}};
    document.tiers = {
        {.id = "Gloss", .type = "gloss", .annotations = {{.id = "a1", .label = "VANNES", .span = {0ms, 400ms}}}}};
    Recording recording{.name = "made"};
    recording.motion = MotionPart{.motion = Motion(skeleton, {100, 1}, 50)};
    recording.annotation = AnnotationPart{.document = document, .tiers = guess_tier_names(document)};
    recording.clock = {.frame_time = Seconds(0.01)};

    Database::create(argv[1], {});
    Database database(argv[1], kv::Access::read_write);
    database.put(recording);
    std::cout << database.contents()->recordings.size() << " recording, "
              << database.find(parse("gloss = \"VANNES\"")).size() << " answer\n";
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
