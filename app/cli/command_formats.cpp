#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/table.h"

namespace signweave::cli {

Run formats(CLI::App&) {
  return [](Io& io) {
    const std::vector<std::vector<std::string>> rows = {
        {"ending", "reads", "writes", "holds", "is lost"},
        {".bvh", "yes", "yes", "skeleton and motion", "annotation; rotations beyond 1e-4 degrees"},
        {".glb .gltf", "no", "yes", "skeleton, motion, a simple body and face; for viewers", "annotation"},
        {".eaf", "yes", "yes", "annotation", "motion"},
        {".json", "no", "yes", "a synthesis: poses, signs, sources, junctions", "nothing"},
        {".csv", "no", "yes", "joint positions per frame, metres", "rotations, annotation"},
        {".face.csv", "yes", "yes", "scalar tracks, as Live Link Face writes them", "everything else"},
        {".svg", "no", "yes", "contact sheet: frames as pictures", "everything but the picture"},
    };
    if (!io.json) {
      io.out << format_table(rows);
      return;
    }
    nlohmann::json list = nlohmann::json::array();
    for (std::size_t i = 1; i < rows.size(); ++i) {
      list.push_back({{"ending", rows[i][0]},
                      {"reads", rows[i][1] == "yes"},
                      {"writes", rows[i][2] == "yes"},
                      {"holds", rows[i][3]},
                      {"lost", rows[i][4]}});
    }
    io.out << list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  };
}

}  // namespace signweave::cli
