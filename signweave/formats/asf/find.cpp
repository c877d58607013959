#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/formats/asf/asf.h"
#include "signweave/formats/asf/lines.h"

namespace signweave::asf {
namespace {

namespace fs = std::filesystem;

/// The skeletons of a folder, by name.
std::vector<fs::path> skeletons_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code fault;
  fs::directory_iterator files(folder, fault);
  for (; !fault && files != fs::directory_iterator(); files.increment(fault)) {
    std::error_code no_matter;
    if (same_word(files->path().extension().string(), ".asf") && !files->is_directory(no_matter)) {
      found.push_back(files->path());
    }
  }
  if (fault) throw Error(ErrorCode::io, fmt::format("{}: cannot be read: {}", folder.string(), fault.message()));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::filesystem::path skeleton_of(const std::filesystem::path& amc) {
  const fs::path folder = amc.has_parent_path() ? amc.parent_path() : fs::path(".");
  const std::vector<fs::path> skeletons = skeletons_in(folder);
  const std::string whole = amc.stem().string();
  std::string looked_for;
  for (std::string stem = whole; !stem.empty();) {
    for (const fs::path& skeleton : skeletons) {
      if (skeleton.stem().string() == stem) return amc.has_parent_path() ? skeleton : skeleton.filename();
    }
    looked_for += (looked_for.empty() ? "" : ", ") + stem + ".asf";
    const std::size_t cut = stem.rfind('_');
    stem.resize(cut == std::string::npos ? 0 : cut);
  }
  if (skeletons.size() == 1) return amc.has_parent_path() ? skeletons[0] : skeletons[0].filename();
  throw Error(
      ErrorCode::not_found,
      fmt::format("{}: no skeleton belongs to it: looked for {} in {}, where {} .asf file{}", amc.string(), looked_for,
                  folder.string(), skeletons.empty() ? "is no" : fmt::format("are {} other", skeletons.size()),
                  skeletons.empty() ? "" : "s"),
      {{"skeleton", ""}});
}

}  // namespace signweave::asf
