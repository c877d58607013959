#include "app/server/uploads.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "app/server/answer.h"
#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/formats/file_format.h"

namespace signweave::server {
namespace {

namespace fs = std::filesystem;

/// Another client's upload cannot be guessed.
std::string random_id() {
  std::random_device device;
  std::string id;
  for (int i = 0; i < 4; ++i) id += fmt::format("{:08x}", device());
  return id;
}

[[noreturn]] void refuse_file() {
  throw Error(ErrorCode::io, "the file could not be stored (is the server's disk full?)");
}

void write_file(const fs::path& path, std::string_view body) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(body.data(), static_cast<std::streamsize>(body.size()));
  out.close();
  if (!out) refuse_file();
}

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code fault;
  fs::rename(from, to, fault);
  if (!fault) return;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, fault);  // another file system
  std::error_code ignored;
  fs::remove(from, ignored);
  if (fault) refuse_file();
}

/// Atomic: a reader of an existing file of this name continues to read the old one. Clients cannot use the temporary
/// name.
void keep_file(const fs::path& from, std::string_view body, const fs::path& to) {
  const fs::path coming = to.parent_path() / ".coming";
  if (from.empty()) {
    write_file(coming, body);
  } else {
    move_file(from, coming);
  }
  std::error_code fault;
  fs::rename(coming, to, fault);
  if (fault) refuse_file();
}

}  // namespace

Uploads::Uploads(fs::path folder, std::size_t most, std::uint64_t most_bytes, Seconds idle)
    : folder_(std::move(folder)), most_(most), most_bytes_(most_bytes), idle_(idle) {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Uploads::~Uploads() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Uploads::require_plain(std::string_view name) {
  constexpr std::size_t kMostBytes = 200;
  const bool plain = !name.empty() && name.size() <= kMostBytes && name.front() != '.' && is_utf8(name) &&
                     std::ranges::none_of(name, [](char c) {
                       return static_cast<unsigned char>(c) < 0x20 || c == 0x7F || c == '/' || c == '\\' || c == ':';
                     });
  if (plain) return;
  throw Error(ErrorCode::bad_input,
              fmt::format("'{}' is not a plain file name: no folders, no ':', no leading dot, at most {} bytes",
                          printable(name), kMostBytes));
}

const Uploads::Upload& Uploads::at(const std::string& database, const std::string& id) const {
  const auto found = uploads_.find(id);
  if (found == uploads_.end() || found->second.database != database) {
    throw Error(ErrorCode::not_found,
                fmt::format("no upload '{}' for '{}'; it may have ended, or was not used for too long", printable(id),
                            printable(database)));
  }
  return found->second;
}

Uploads::Upload& Uploads::at(const std::string& database, const std::string& id) {
  return const_cast<Upload&>(std::as_const(*this).at(database, id));
}

const Uploads::Upload& Uploads::at_open(const std::string& database, const std::string& id) const {
  const Upload& upload = at(database, id);
  if (upload.held) throw Error(ErrorCode::conflict, "the upload is being imported; open another one");
  return upload;
}

void Uploads::require_readable(const std::string& name) {
  // In addition to the formats: tables of pairs and labels, mapping files, buffers of glTF, specifications of ANVIL.
  constexpr std::string_view kOthers[] = {"", ".csv", ".tsv", ".txt", ".rig", ".bin", ".xml"};
  const FileFormat* format = file_format(name);
  if (format != nullptr && format->reads) return;
  const std::string extension = fold_case(fs::path(name).extension().string());
  if (std::ranges::find(kOthers, extension) != std::end(kOthers)) return;
  throw Error(
      ErrorCode::unsupported,
      fmt::format("{}: no import reads files ending in '{}'; send motion {}, annotation {}, faces {}, tables and "
                  "mappings (.csv, .txt, .rig)",
                  printable(name), printable(extension), readable_extensions(FileKind::motion),
                  readable_extensions(FileKind::annotation), readable_extensions(FileKind::face)));
}

void Uploads::require_open(const std::string& database, const std::string& id, const std::string& name) const {
  require_plain(name);
  require_readable(name);
  const std::lock_guard lock(mutex_);
  at_open(database, id);
}

std::string Uploads::open(const std::string& database) {
  sweep();
  const std::lock_guard lock(mutex_);
  if (uploads_.size() >= most_) make_room();
  if (uploads_.size() >= most_) {
    throw StatusError(503, "busy", fmt::format("{} uploads are open already; finish one, or wait", uploads_.size()));
  }
  std::string id = random_id();
  Upload upload{.database = database, .folder = folder_ / id, .files = {}, .touched = std::chrono::steady_clock::now()};
  std::error_code fault;
  fs::create_directories(upload.folder, fault);
  if (fault) throw Error(ErrorCode::io, "the folder for the upload could not be created: " + fault.message());
  uploads_.emplace(id, std::move(upload));
  return id;
}

UploadedFile Uploads::put(const std::string& database, const std::string& id, const std::string& name,
                          const fs::path& from, std::string_view body) {
  require_plain(name);
  require_readable(name);
  const std::lock_guard lock(mutex_);
  at_open(database, id);
  Upload& upload = at(database, id);
  const std::uint64_t bytes = from.empty() ? body.size() : fs::file_size(from);
  std::uint64_t all = bytes;
  for (const auto& [other, size] : upload.files) all += other == name ? 0 : size;
  if (all > most_bytes_) {
    throw too_large(fmt::format("the upload would have {} bytes; the limit is {}", all, most_bytes_));
  }
  if (upload.files.size() >= 10'000) throw too_large("the upload has 10000 files already; open another one");
  keep_file(from, body, upload.folder / name);
  upload.files[name] = bytes;
  upload.touched = std::chrono::steady_clock::now();
  return {.file = name, .bytes = bytes, .upload_bytes = all};
}

void Uploads::take_away(const std::string& database, const std::string& id, const std::string& name) {
  const std::lock_guard lock(mutex_);
  at_open(database, id);
  Upload& upload = at(database, id);
  const auto file = upload.files.find(name);
  if (file == upload.files.end()) {
    std::vector<std::string> known;
    for (const auto& [other, bytes] : upload.files) known.push_back(other);
    throw Error(ErrorCode::not_found,
                fmt::format("the upload has no file '{}'{}", printable(name), did_you_mean(name, known)));
  }
  std::error_code fault;
  fs::remove(upload.folder / name, fault);
  if (fault) throw Error(ErrorCode::io, "the file could not be removed: " + fault.message());
  upload.files.erase(file);
  upload.touched = std::chrono::steady_clock::now();
}

UploadAnswer Uploads::describe(const std::string& database, const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const Upload& upload = at(database, id);
  UploadAnswer answer{.upload = id, .files = {}};
  for (const auto& [name, bytes] : upload.files) answer.files.push_back({name, bytes});
  return answer;
}

void Uploads::discard(const std::string& database, const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (at(database, id).held) throw Error(ErrorCode::conflict, "the upload is being imported; cancel its job first");
  remove(uploads_.find(id));
}

fs::path Uploads::hold(const std::string& database, const std::string& id) {
  const std::lock_guard lock(mutex_);
  Upload& upload = at(database, id);
  if (upload.held) throw Error(ErrorCode::conflict, "the upload is being imported already");
  if (upload.files.empty()) throw Error(ErrorCode::bad_input, "the upload has no files yet; put some first");
  upload.held = true;
  return upload.folder;
}

fs::path Uploads::look(const std::string& database, const std::string& id) {
  const std::lock_guard lock(mutex_);
  Upload& upload = at(database, id);
  upload.touched = std::chrono::steady_clock::now();
  return upload.folder;
}

void Uploads::release(const std::string& id, bool remove) {
  const std::lock_guard lock(mutex_);
  const auto found = uploads_.find(id);
  if (found == uploads_.end()) return;
  found->second.held = false;
  found->second.touched = std::chrono::steady_clock::now();
  if (remove) this->remove(found);
}

void Uploads::remove(std::map<std::string, Upload>::iterator upload) {
  std::error_code ignored;
  fs::remove_all(upload->second.folder, ignored);
  uploads_.erase(upload);
}

void Uploads::make_room() {
  auto oldest = uploads_.end();
  for (auto one = uploads_.begin(); one != uploads_.end(); ++one) {
    if (!one->second.held && (oldest == uploads_.end() || one->second.touched < oldest->second.touched)) oldest = one;
  }
  if (oldest == uploads_.end() || std::chrono::steady_clock::now() - oldest->second.touched < idle_ / 6) return;
  remove(oldest);
}

void Uploads::sweep() {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  std::erase_if(uploads_, [&](const auto& entry) {
    if (entry.second.held || now - entry.second.touched < idle_) return false;
    std::error_code ignored;
    fs::remove_all(entry.second.folder, ignored);
    return true;
  });
}

}  // namespace signweave::server
