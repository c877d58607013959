#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>

#include "signweave/backup/part_file.h"
#include "signweave/backup/state_file.h"
#include "signweave/kv/test_folder.h"

namespace signweave::backup_files {
namespace {

using kv::TestFolder;

using Records = std::vector<std::pair<std::string, std::string>>;

Stamp write(const std::filesystem::path& path, const Records& records) {
  PartWriter writer(path);
  for (const auto& [key, value] : records) writer.add(bytes_of(key), bytes_of(value));
  return writer.commit();
}

Records read(const std::filesystem::path& path) {
  Records records;
  read_part(path, [&](ByteSpan key, ByteSpan value) { records.emplace_back(text_of(key), text_of(value)); });
  return records;
}

RC_GTEST_PROP(PartFile, ReturnsWhatWasAdded, ()) {
  const auto keys = *rc::gen::container<std::vector<std::string>>(
      rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::arbitrary<char>())));
  Records records;
  for (const std::string& key : keys) records.emplace_back(key, *rc::gen::arbitrary<std::string>());
  const TestFolder folder;
  const Stamp stamp = write(folder / "part", records);
  RC_ASSERT(read(folder / "part") == records);
  RC_ASSERT(fault_of_part(folder / "part", stamp).empty());
}

RC_GTEST_PROP(PartFile, AnyChangedByteIsDetectedAndHarmless, ()) {
  const TestFolder folder;
  const Stamp stamp = write(folder / "part", {{"one", std::string(50, 'x')}, {"two", ""}, {"three", "value"}});
  std::string bytes = read_file(folder / "part");
  const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
  const bool cut = *rc::gen::arbitrary<bool>();
  if (cut) {
    bytes.resize(at);
  } else {
    bytes[at] = static_cast<char>(bytes[at] ^ *rc::gen::inRange(1, 256));
  }
  std::ofstream(folder / "part", std::ios::binary) << bytes;
  RC_ASSERT(!fault_of_part(folder / "part", stamp).empty());
  try {
    read(folder / "part");
  } catch (const Error& error) {
    RC_ASSERT(error.code() == ErrorCode::corrupt);
  }
}

State some_state() {
  return {.number = 12,
          .made = "2026-11-26T14:45:36Z",
          .database = "corpus with blanks.db",
          .engine = "lmdb",
          .recordings = 2,
          .parts = {{"catalogue-9-00ff", {100, 1}}, {"motion-4-0123456789abcdef", {~std::uint64_t{0}, 2}}},
          .catalogue = "catalogue-9-00ff",
          .left_out = {"b: motion: a stored record is missing or damaged"}};
}

TEST(StateFile, ReturnsWhatItWasGiven) {
  EXPECT_EQ(state_of_text(text_of_state(some_state()), "here"), some_state());
}

RC_GTEST_PROP(StateFile, AnyChangedByteIsDetected, ()) {
  std::string text = text_of_state(some_state());
  const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
  if (*rc::gen::arbitrary<bool>()) {
    text.resize(at);
  } else {
    text[at] = static_cast<char>(text[at] ^ *rc::gen::inRange(1, 256));
  }
  try {
    state_of_text(text, "here");
    RC_FAIL("it was read");
  } catch (const Error& error) {
    RC_ASSERT(error.code() == ErrorCode::corrupt);
  }
}

/// Appends a matching checksum, as `text_of_state` does.
std::string with_checksum(std::string text) {
  return text + fmt::format("checksum {:016x}\n", checksum(bytes_of(text)));
}

TEST(StateFile, NamesThatLeadOutsideAreRefused) {
  const std::string head = "signweave backup 1\nstate 1\ncatalogue c-1-0\npart c-1-0 10 00\n";
  EXPECT_NO_THROW(state_of_text(with_checksum(head), "here"));
  for (const char* const name : {"../../etc/passwd", "", "A", "a/b", "..", "a.b"}) {
    EXPECT_THROW(state_of_text(with_checksum(head + "part " + name + " 10 00\n"), "here"), Error) << name;
  }
  EXPECT_THROW(state_of_text(with_checksum("signweave backup 1\nstate 1\ncatalogue c-1-0\n"), "here"), Error);
  EXPECT_THROW(state_of_text(with_checksum("signweave backup 2\nstate 1\n"), "here"), Error);
}

}  // namespace
}  // namespace signweave::backup_files
