#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>

#include "signweave/kv/fault.h"

/// Internal to this module.
namespace signweave::kv {

/// The stores of one kind that this process has open. Engines forbid opening one store twice in a process, or fail (the
/// second close would drop the locks of the first), so all users share one, which closes when the last one releases it.
/// Counted by hand under one mutex, because a weak_ptr expires before the store is closed, and another thread could
/// open it again in between.
template <typename Store>
class OpenStores {
 public:
  /// The store whose main file is `file`: the one already open, or the result of `open` (a unique_ptr<Store>()). A
  /// child process opens its own store and never uses its parent's.
  template <typename Open>
  static std::shared_ptr<Store> acquire(const std::filesystem::path& file, Open open) {
    const std::lock_guard lock(instance().mutex_);
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) fail_system(file.parent_path(), "opening the store", errno);
    auto& entries = instance().entries_;
    auto entry = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) {
      return e.device == status.st_dev && e.inode == status.st_ino && e.process == ::getpid();
    });
    if (entry == entries.end()) {
      entries.push_back(
          {.device = status.st_dev, .inode = status.st_ino, .process = ::getpid(), .holders = 0, .store = open()});
      entry = std::prev(entries.end());
    }
    ++entry->holders;
    return {entry->store.get(), release};
  }

  /// Runs `act` if this process does not have the store open, and prevents it from being opened meanwhile (all stores
  /// of this kind wait). Returns false if it is open.
  template <typename Act>
  static bool while_closed(const std::filesystem::path& file, Act act) {
    const std::lock_guard lock(instance().mutex_);
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) fail_system(file.parent_path(), "opening the store", errno);
    for (const Entry& entry : instance().entries_) {
      const bool same = entry.device == status.st_dev && entry.inode == status.st_ino;
      if (same && entry.process == ::getpid()) return false;
    }
    act();
    return true;
  }

 private:
  struct Entry {
    dev_t device = 0;
    ino_t inode = 0;
    pid_t process = 0;
    std::size_t holders = 0;
    std::unique_ptr<Store> store;
  };

  static OpenStores& instance() {
    static auto* const stores = new OpenStores;  // never destroyed: stores may be closed by static destructors
    return *stores;
  }

  static void release(const Store* store) {
    const std::lock_guard lock(instance().mutex_);
    instance().entries_.remove_if([&](Entry& entry) { return entry.store.get() == store && --entry.holders == 0; });
  }

  std::mutex mutex_;
  std::list<Entry> entries_;
};

}  // namespace signweave::kv
