#include "signweave/formats/write_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "signweave/core/atomic_file.h"
#include "signweave/core/error.h"
#include "signweave/database/test_signing.h"
#include "signweave/formats/file_format.h"

namespace signweave {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing_database::recording_of;
using testing_database::TestFolder;
namespace fs = std::filesystem;

constexpr const char* kExtensions = ".bvh .glb .gltf .eaf .json .csv .rotations.csv .face.csv .svg";

/// A motion with a scalar track.
Motion smiling() {
  Motion motion = recording_of("one", 1, {"A", "B"}).motion->motion;
  motion.add_track({"smile", std::vector<float>(static_cast<std::size_t>(motion.frame_count()), 0.5F)});
  return motion;
}

/// What is thrown; empty where nothing is.
std::string fault_from(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input) << error.what();
    return error.what();
  }
  return "";
}

bool is_json(const std::string& text) {
  return nlohmann::json::accept(text);
}

TEST(WrittenFiles, OfEveryExtensionHaveAWriterOfTheirOwn) {
  const Motion motion = smiling();
  const AnnotationDocument document = recording_of("one", 1, {"A", "B"}).annotation->document;
  const FileContent content{.motion = &motion, .document = &document, .title = "one"};
  Synthesis made;
  made.motion = motion;
  const TestFolder folder;
  for (const std::string_view extension : writable_extensions()) {
    const bool json = extension == ".json" || extension == ".gltf";
    const std::string text = file_text(extension, content, "one");
    EXPECT_EQ(is_json(text), json) << extension;
    const std::string path = folder / ("one" + std::string(extension));
    write_file(path, content);
    EXPECT_EQ(read_file(path), text) << extension;
    EXPECT_EQ(is_json(file_text(extension, content_of(made), "x")), json) << extension;
    save(made, {path});
    EXPECT_EQ(is_json(read_file(path)), json) << extension;
  }
}

TEST(WrittenFiles, OfNoOtherExtensionAreWritten) {
  const Motion motion = smiling();
  const FileContent content{.motion = &motion, .title = "one"};
  Synthesis made;
  made.motion = motion;
  const TestFolder folder;
  for (const std::string extension : {".fbx", ".amc", ".asf", ".anvil", ".mp4", ".frames", ".truth"}) {
    const std::string wrong = "'" + extension + "' cannot be written here; use " + kExtensions;
    EXPECT_EQ(fault_from([&] { file_text(extension, content, "one"); }), "one: " + wrong);
    EXPECT_THAT(fault_from([&] { file_text(extension, content_of(made), "x"); }), HasSubstr(wrong));
    const std::string path = folder / ("one" + extension);
    EXPECT_EQ(fault_from([&] { write_file(path, content); }), path + ": " + wrong);
    // Nothing else is written either.
    const std::string good = folder / "good.bvh";
    EXPECT_EQ(fault_from([&] { save(made, {good, path}); }), path + ": " + wrong);
    EXPECT_FALSE(fs::exists(path) || fs::exists(good)) << extension;
  }
  const std::string path = folder / "one";
  EXPECT_EQ(fault_from([&] { write_file(path, content); }), path + ": has no extension; use " + kExtensions);
  EXPECT_FALSE(fs::exists(path));
}

TEST(CheckExtension, NamesTheFileItsExtensionAndThoseAllowed) {
  EXPECT_EQ(check_extension("a/b.SVG", {".svg"}), "");
  EXPECT_EQ(check_extension("a/b.png", {".svg"}), "a/b.png: '.png' cannot be written here; use .svg");
  EXPECT_EQ(check_extension("film.avi", {".webm", ".png"}), "film.avi: '.avi' cannot be written here; use .webm .png");
  EXPECT_EQ(check_extension("one.face.csv", {".csv"}), "one.face.csv: '.face.csv' cannot be written here; use .csv");
  EXPECT_EQ(check_extension(".svg", {".svg"}), ".svg: has no extension; use .svg");
  EXPECT_THAT(check_extension("b.\n", {".svg"}), StartsWith("b.\\"));
}

}  // namespace
}  // namespace signweave
