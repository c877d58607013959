#pragma once

// The engines' own functions without signweave: a plain loop of gets. One function per engine.

#include <lmdb.h>
#if SIGNWEAVE_BERKELEY
#include <db.h>
#endif
#if SIGNWEAVE_TOKYO
#include <tchdb.h>
#endif

#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "signweave/core/bytes.h"

namespace signweave::bench {

class BareStore {
 public:
  virtual ~BareStore() = default;
  /// Copies a value to `buffer`, which must have room for it, and returns its size.
  virtual std::size_t get(ByteSpan key, Bytes& buffer) = 0;
};

class BareLmdb final : public BareStore {
 public:
  explicit BareLmdb(const std::filesystem::path& folder) {
    check(::mdb_env_create(&environment_));
    check(::mdb_env_set_mapsize(environment_, std::size_t{1} << 34));
    check(::mdb_env_open(environment_, folder.c_str(), MDB_RDONLY, 0));
    check(::mdb_txn_begin(environment_, nullptr, MDB_RDONLY, &transaction_));
    check(::mdb_dbi_open(transaction_, nullptr, 0, &database_));
  }
  ~BareLmdb() override {
    ::mdb_txn_abort(transaction_);
    ::mdb_env_close(environment_);
  }
  std::size_t get(ByteSpan key, Bytes& buffer) override {
    MDB_val name{key.size(), const_cast<std::byte*>(key.data())};
    MDB_val value{};
    check(::mdb_get(transaction_, database_, &name, &value));
    std::memcpy(buffer.data(), value.mv_data, value.mv_size);
    return value.mv_size;
  }

 private:
  static void check(int code) {
    if (code != 0) throw std::runtime_error(::mdb_strerror(code));
  }
  MDB_env* environment_ = nullptr;
  MDB_txn* transaction_ = nullptr;
  MDB_dbi database_ = 0;
};

#if SIGNWEAVE_BERKELEY
class BareBerkeley final : public BareStore {
 public:
  explicit BareBerkeley(const std::filesystem::path& folder) {
    const std::uint64_t cache = std::filesystem::file_size(folder / "data.bdb") * 5 / 4 + (std::uint64_t{64} << 20);
    check(::db_env_create(&environment_, 0));
    check(environment_->set_cachesize(environment_, static_cast<std::uint32_t>(cache >> 30),
                                      static_cast<std::uint32_t>(cache & ((1u << 30) - 1)), 1));
    check(environment_->open(environment_, folder.c_str(), DB_PRIVATE | DB_THREAD | DB_CREATE | DB_INIT_MPOOL, 0));
    check(::db_create(&database_, environment_, 0));
    check(database_->open(database_, nullptr, "data.bdb", nullptr, DB_HASH, DB_THREAD | DB_RDONLY, 0));
  }
  ~BareBerkeley() override {
    database_->close(database_, 0);
    environment_->close(environment_, 0);
  }
  std::size_t get(ByteSpan key, Bytes& buffer) override {
    DBT name{}, value{};
    name.data = const_cast<std::byte*>(key.data());
    name.size = static_cast<std::uint32_t>(key.size());
    value.data = buffer.data();
    value.ulen = static_cast<std::uint32_t>(buffer.size());
    value.flags = DB_DBT_USERMEM;
    check(database_->get(database_, nullptr, &name, &value, 0));
    return value.size;
  }

 private:
  static void check(int code) {
    if (code != 0) throw std::runtime_error(::db_strerror(code));
  }
  DB_ENV* environment_ = nullptr;
  DB* database_ = nullptr;
};
#endif

#if SIGNWEAVE_TOKYO
class BareTokyo final : public BareStore {
 public:
  explicit BareTokyo(const std::filesystem::path& folder) : file_(::tchdbnew()) {
    ::tchdbsetxmsiz(file_, std::int64_t{1} << 40);
    if (!::tchdbopen(file_, (folder / "data.tch").c_str(), HDBOREADER | HDBOLCKNB)) fail();
  }
  ~BareTokyo() override { ::tchdbdel(file_); }
  std::size_t get(ByteSpan key, Bytes& buffer) override {
    const int size =
        ::tchdbget3(file_, key.data(), static_cast<int>(key.size()), buffer.data(), static_cast<int>(buffer.size()));
    if (size < 0) fail();
    return static_cast<std::size_t>(size);
  }

 private:
  [[noreturn]] void fail() const { throw std::runtime_error(::tchdberrmsg(::tchdbecode(file_))); }
  TCHDB* file_;
};
#endif

/// Opens the files that signweave wrote. `folder` must not be open already.
inline std::unique_ptr<BareStore> open_bare(std::string_view engine, const std::filesystem::path& folder) {
  if (engine == "lmdb") return std::make_unique<BareLmdb>(folder);
#if SIGNWEAVE_BERKELEY
  if (engine == "berkeley") return std::make_unique<BareBerkeley>(folder);
#endif
#if SIGNWEAVE_TOKYO
  if (engine == "tokyo") return std::make_unique<BareTokyo>(folder);
#endif
  throw std::runtime_error("bench/store_bare.h has no bare loop for the engine " + std::string(engine));
}

}  // namespace signweave::bench
