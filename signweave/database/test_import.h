#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "signweave/database/import.h"
#include "signweave/database/test_recording.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/eaf/eaf.h"

namespace signweave::testing_database {

/// A database and a folder of small files to import.
class ImportTest : public testing::Test {
 protected:
  ImportTest() {
    Database::create(folder_ / "db", {});
    std::filesystem::create_directories(files());
  }
  std::filesystem::path files() const { return folder_ / "files"; }

  void write_motion(const std::string& name, int seed, std::int64_t frames = 200) {
    const Motion motion = small_motion(frames, seed);
    std::filesystem::create_directories((files() / name).parent_path());
    bvh::write(files() / name, motion, bvh::default_layout(motion.skeleton()));
  }
  void write_annotation(const std::string& name, const std::vector<std::string>& glosses,
                        const std::vector<LinkedFile>& linked = {}) {
    AnnotationDocument document = small_document(glosses);
    document.linked_files = linked;
    std::filesystem::create_directories((files() / name).parent_path());
    eaf::write(files() / name, document);
  }
  void write_text(const std::string& name, const std::string& text) { std::ofstream(files() / name) << text; }

  /// Imports everything and returns the outcomes; the notices are in notices_.
  std::vector<ImportOutcome> import_all(const ImportOptions& options = {}) {
    Database database(folder_ / "db", kv::Access::read_write);
    std::vector<ImportOutcome> outcomes;
    notices_.clear();
    for (const ImportJob& job : pair_files({files()}).jobs) {
      ImportReport report = import_recording(database, job, options);
      outcomes.push_back(report.outcome);
      for (const Notice& notice : report.notices) notices_.push_back(notice.text);
    }
    return outcomes;
  }
  TestFolder folder_;
  std::vector<std::string> notices_;
};

/// A face capture of one track that has one value.
inline std::string face_text(const std::string& value, int rows = 120) {
  std::string text = "Timecode,BlendShapeCount,JawOpen\n";
  for (int i = 0; i < rows; ++i) {
    text += "10:00:" + std::to_string(10 + i / 60) + ':' + std::to_string(i % 60) + ",1," + value + '\n';
  }
  return text;
}

}  // namespace signweave::testing_database
