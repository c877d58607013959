#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "signweave/core/error.h"

namespace signweave::server {

/// What a job may call while it works; belongs to its thread.
class JobContext {
 public:
  virtual ~JobContext() = default;
  /// The part that is done, in [0, 1]. Throws Error{cancelled} where the job was cancelled.
  virtual void advance(double fraction) = 0;
  /// What is known of the result so far: told with the job while it runs, and kept where it fails or is cancelled.
  virtual void tell(nlohmann::json result) = 0;
  /// One more of a list of what was told. Those before it are not touched, so a long list costs no more than its
  /// length.
  virtual void add(const std::string& list, nlohmann::json one) = 0;
};

/// What a job is.
struct JobKind {
  std::string name;
  bool changes = true;  ///< the database: what else changes it has to wait
  bool alone = false;   ///< there is one of them at a time, over all databases
};

/// Work that is not done when its request is answered: imports, relayouts, evaluations. One after the other, on a
/// thread of their own. Threads may share it.
class Jobs {
 public:
  /// Returns the result; null where it is what was told.
  using Work = std::function<nlohmann::json(JobContext&)>;

  /// `redact` takes what is nobody's business, such as folders, out of a text. `tidy` is called now and then when there
  /// is nothing to do.
  Jobs(std::function<std::string(std::string)> redact, std::function<void()> tidy);
  /// Cancels what runs and what waits, and waits for the thread.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Starts the thread: call it once, when what the callbacks use is there.
  void begin();
  /// A new job's number. Throws Error{conflict} where kMostWaiting are waiting already, or one that has to be alone.
  std::string start(JobKind kind, std::string database, Work work);
  /// As JSON: job, kind, database, state (waiting, running, done, failed, cancelled), fraction, result, error. Of the
  /// result's list `recordings` only what is at `from` and after it. Throws Error{not_found}.
  nlohmann::json describe(const std::string& id, std::size_t from = 0) const;
  /// All jobs, without their results, which may be long.
  nlohmann::json describe_all() const;
  /// Stops it as soon as may be; nothing where it is over. Throws Error{not_found}.
  void cancel(const std::string& id);
  /// The number of a job that waits or runs and changes this database.
  std::optional<std::string> changing(const std::string& database) const;

  static constexpr std::size_t kMostWaiting = 16;
  static constexpr std::size_t kMostKept = 100;  ///< that are over

 private:
  enum class State { waiting, running, done, failed, cancelled };
  struct Result;
  struct Job;
  class Context;

  void run();
  void finish(Job& job, State state, nlohmann::json result, const std::optional<Error>& error);
  static nlohmann::json json_of(const Job& job);
  std::shared_ptr<Job> at(const std::string& id) const;

  std::function<std::string(std::string)> redact_;
  std::function<void()> tidy_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Job>> jobs_;  ///< in the order of their numbers
  std::uint64_t next_ = 1;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace signweave::server
