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

#include "app/server/answers.h"
#include "signweave/core/error.h"

namespace signweave::server {

/// The callbacks of a job while it works; belongs to the job's thread.
class JobContext {
 public:
  virtual ~JobContext() = default;
  /// Reports the finished fraction, in [0, 1]. Throws Error{cancelled} if the job was cancelled.
  virtual void advance(double fraction) = 0;
  /// Reports what is known of the result so far: shown with the job while it runs, and kept if it fails or is
  /// cancelled.
  virtual void report(nlohmann::json result) = 0;
  /// Appends an item to a list of the reported result. Earlier items are not touched, so a long list costs no more than
  /// its length.
  virtual void add(const std::string& list, nlohmann::json one) = 0;
};

/// The properties of a job.
struct JobKind {
  std::string name;
  bool changes = true;  ///< changes the database: other changes have to wait
  bool alone = false;   ///< only one at a time, over all databases
};

/// Work that outlives its request: imports, relayouts, evaluations. Jobs run one after another on their own thread.
/// Thread-safe.
class Jobs {
 public:
  /// Returns the result; null: the result is what was reported.
  using Work = std::function<nlohmann::json(JobContext&)>;

  /// `redact` removes private details such as folders from a text. `tidy` is called from time to time when there is no
  /// work.
  Jobs(std::function<std::string(std::string)> redact, std::function<void()> tidy);
  /// Cancels the running and the waiting jobs, and waits for the thread.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Starts the thread: to be called once, when everything that the callbacks use exists.
  void begin();
  /// Returns the number of a new job. Throws Error{conflict} if kMostWaiting jobs have not ended yet, or one of the
  /// same kind that has to be alone.
  std::string start(JobKind kind, std::string database, Work work);
  /// The state of a job. The result's list `recordings` is returned from index `from` on. Throws Error{not_found}.
  JobAnswer describe(const std::string& id, std::size_t from = 0) const;
  /// All jobs, without their results, which may be long.
  JobsAnswer describe_all() const;
  /// Cancels a job as soon as possible; does nothing if it has ended. Throws Error{not_found}.
  void cancel(const std::string& id);
  /// The number of a waiting or running job that changes this database.
  std::optional<std::string> changing(const std::string& database) const;

  static constexpr std::size_t kMostWaiting = 16;
  static constexpr std::size_t kMostKept = 100;  ///< jobs that have ended

 private:
  enum class State { waiting, running, done, failed, cancelled };
  struct Result;
  struct Job;
  class Context;

  void run();
  void finish(Job& job, State state, nlohmann::json result, const std::optional<Error>& error);
  static JobAnswer answer_of(const Job& job);
  std::shared_ptr<Job> at(const std::string& id) const;

  std::function<std::string(std::string)> redact_;
  std::function<void()> tidy_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Job>> jobs_;  ///< in the order of their numbers
  std::uint64_t next_ = 1;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace signweave::server
