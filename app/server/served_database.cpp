#include "app/server/served_database.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::server {

ServedDatabase::ServedDatabase(std::string name, const std::filesystem::path& folder, bool writable)
    : name_(std::move(name)),
      writable_(writable),
      database_(folder, writable ? kv::Access::read_write : kv::Access::read_only),
      signing_(database_) {}

void ServedDatabase::change(const std::function<void(Database&)>& change) {
  if (!writable_) {
    throw Error(ErrorCode::unsupported,
                fmt::format("'{}' is served for reading only; serve it with --writable to change it", name_));
  }
  const std::lock_guard lock(changing_);
  change(database_);
  signing_.warm_up();  // here, not when the next stream waits for its first frame
}

std::shared_ptr<const calls::SignerStance> ServedDatabase::stance(const std::shared_ptr<const Contents>& contents,
                                                                  const std::string& recording) {
  {
    const std::lock_guard lock(stances_lock_);
    if (stances_of_ != contents) {
      stances_.clear();
      stances_of_ = contents;
    }
    if (const auto known = stances_.find(recording); known != stances_.end()) return known->second;
  }
  auto made = std::make_shared<const calls::SignerStance>(calls::stance_of(database_, contents->at(recording)));
  const std::lock_guard lock(stances_lock_);
  if (stances_of_ == contents) stances_.emplace(recording, made);
  return made;
}

void ServedDatabases::add(const std::filesystem::path& folder, bool writable) {
  std::filesystem::path path = folder.lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const std::string name = path.stem().string();
  const bool plain = !name.empty() && std::ranges::all_of(name, [](char c) {
    return static_cast<unsigned char>(c) > 0x20 && c != '/' && c != '\\' && c != '%' && c != '?' && c != '#';
  });
  if (!plain) throw Error(ErrorCode::bad_input, fmt::format("{}: the name cannot be used in a URL", folder.string()));
  if (std::ranges::any_of(all_, [&](const auto& one) { return one->name() == name; })) {
    throw Error(ErrorCode::bad_input,
                fmt::format("two databases would be served as '{}'; rename one of the folders", name));
  }
  all_.push_back(std::make_unique<ServedDatabase>(name, folder, writable));
}

ServedDatabase& ServedDatabases::at(std::string_view name) const {
  std::vector<std::string> known;
  for (const auto& one : all_) {
    if (one->name() == name) return *one;
    known.push_back(one->name());
  }
  throw Error(ErrorCode::not_found,
              fmt::format("no database '{}' is served{}", printable(name), did_you_mean(std::string(name), known)));
}

}  // namespace signweave::server
