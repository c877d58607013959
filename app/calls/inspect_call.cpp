#include "app/calls/inspect_call.h"

#include <set>

#include "app/calls/import_call.h"
#include "app/calls/info_call.h"

namespace signweave::calls {

using nlohmann::ordered_json;

namespace {

/// A folder that goes whatever happens.
struct Scratch {
  std::filesystem::path folder;
  explicit Scratch(std::filesystem::path path) : folder(std::move(path)) {}
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

ordered_json name_or_null(const std::optional<std::filesystem::path>& path) {
  return path ? ordered_json(path->filename().string()) : ordered_json(nullptr);
}

ordered_json layout_json(const bvh::Layout& layout) {
  return {{"up", layout.up == bvh::UpAxis::z ? "z" : "y"},
          {"unit", layout.unit},
          {"root_unit", layout.root_unit},
          {"mirrored", layout.mirrored},
          {"root_order", layout.root_columns == bvh::RootColumns::declared ? "declared" : "rotation_first"}};
}

/// Which tiers there are, and which were taken for signs and phases.
ordered_json tiers_json(const AnnotationDocument& document, const TierNames& names) {
  ordered_json tiers = ordered_json::array();
  for (const Tier& tier : document.tiers) {
    std::set<std::string_view> labels;
    for (const Annotation& annotation : tier.annotations) labels.insert(annotation.label);
    const auto sign = std::ranges::find(names.sign_tiers, tier.id, &TierNames::SignTier::id);
    const bool phases = std::ranges::find(names.phase_tiers, tier.id) != names.phase_tiers.end();
    tiers.push_back({{"tier", tier.id},
                     {"parent", tier.parent.empty() ? ordered_json(nullptr) : ordered_json(tier.parent)},
                     {"annotations", tier.annotations.size()},
                     {"labels", labels.size()},
                     {"role", sign != names.sign_tiers.end() ? "signs"
                              : phases                       ? "phases"
                                                             : ""},
                     {"hand", name_of(sign != names.sign_tiers.end() ? sign->hand : Hand::both)}});
  }
  return tiers;
}

/// Of a recording that was imported into the scratch database.
void describe(const Database& scratch, const ImportReport& imported, ordered_json& report) {
  const RecordingDetails details = run(scratch, RecordingCall{imported.name});
  const RecordingInfo& info = details.info;
  const ordered_json all = json_of(details);
  report["signer"] = info.signer;
  for (const char* figure : {"frames", "frames_per_second", "seconds", "clock_origin_ms"}) {
    if (all.contains(figure)) report[figure] = all[figure];
  }
  report["tracks"] = info.motion ? info.motion->tracks : std::vector<std::string>();
  report["signs"] = imported.signs;
  report["phases"] = all["phases"];
  report["not_measured"] = imported.not_measured;
  report["notices"] = json_of(imported.notices);
  report["layout"] = info.layout ? layout_json(*info.layout) : ordered_json(nullptr);
  report["rig"] = all.contains("rig") ? all["rig"] : ordered_json(nullptr);
  report["joints"] = ordered_json::array();
  if (details.skeleton) {
    for (const Joint& joint : details.skeleton->joints()) report["joints"].push_back(joint.name);
  }
  report["defects"] = all.contains("defects") ? all["defects"] : ordered_json::array();
  report["tiers"] = info.document == 0 ? ordered_json::array() : tiers_json(scratch.document(info.name), info.tiers);
  report["declarations"] = declarations_json(info.declarations);
}

}  // namespace

void inspect(const Database& database, const Pairing& pairing, const ImportOptions& options,
             const std::filesystem::path& scratch, const Listener& listener,
             const std::function<void(ordered_json)>& done) {
  const Scratch folder(scratch);
  Database::create(folder.folder, {});
  Database store(folder.folder, kv::Access::read_write);
  const auto report = [&](const ImportJob& job) {
    return ordered_json{{"name", job.name},
                        {"files",
                         {{"motion", name_or_null(job.motion)},
                          {"annotation", name_or_null(job.annotation)},
                          {"face", name_or_null(job.face)}}},
                        {"known", database.info(job.name).has_value()}};
  };
  std::size_t at = 0;
  ImportOptions here = options;
  here.if_annotation.reset();  // that is about the database, and what is there is not changed
  run(store, pairing, here, listener, [&](const Imported& imported) {
    ordered_json one = report(pairing.jobs[at++]);
    if (imported.error) {
      one["error"] = imported.error->what();
      if (!imported.error->remedies().empty()) one["remedies"] = json_of(imported.error->remedies());
    } else {
      describe(store, *imported.report, one);
      store.remove(imported.name);  // what is not looked at any more takes no room
    }
    done(std::move(one));
  });
}

}  // namespace signweave::calls
