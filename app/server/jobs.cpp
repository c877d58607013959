#include "app/server/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/server/answer.h"
#include "signweave/core/text.h"

namespace signweave::server {

using nlohmann::json;

/// Its parts are shared with threads that are answering, so that copying them needs no lock.
struct Jobs::Result {
  std::shared_ptr<const json> reported;
  std::map<std::string, std::vector<std::shared_ptr<const json>>> lists;

  json whole(std::size_t from) const {
    json all = *reported;
    for (const auto& [name, parts] : lists) {
      json& list = all[name] = json::array();
      for (std::size_t i = name == "recordings" ? from : 0; i < parts.size(); ++i) list.push_back(*parts[i]);
    }
    return all;
  }
};

struct Jobs::Job {
  std::string id;
  JobKind kind;
  std::string database;
  Work work;
  State state = State::waiting;
  std::atomic<double> fraction{0};
  std::atomic<bool> cancelled{false};
  Result result;
  std::optional<json> error;

  bool over() const { return state != State::waiting && state != State::running; }
};

class Jobs::Context : public JobContext {
 public:
  Context(Jobs& jobs, Job& job) : jobs_(jobs), job_(job) {}

  void advance(double fraction) override {
    job_.fraction.store(fraction, std::memory_order_relaxed);
    if (job_.cancelled.load(std::memory_order_relaxed)) {
      throw Error(ErrorCode::cancelled, "the job was cancelled; what was done before is preserved");
    }
  }
  void report(json result) override {
    auto reported = std::make_shared<const json>(std::move(result));
    const std::lock_guard lock(jobs_.mutex_);
    job_.result = {std::move(reported), {}};
  }
  void add(const std::string& list, json one) override {
    auto part = std::make_shared<const json>(std::move(one));
    const std::lock_guard lock(jobs_.mutex_);
    job_.result.lists[list].push_back(std::move(part));
  }

 private:
  Jobs& jobs_;
  Job& job_;
};

Jobs::Jobs(std::function<std::string(std::string)> redact, std::function<void()> tidy)
    : redact_(std::move(redact)), tidy_(std::move(tidy)) {}

void Jobs::begin() {
  thread_ = std::thread([this] { run(); });
}

Jobs::~Jobs() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const std::shared_ptr<Job>& job : jobs_) job->cancelled = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

std::string Jobs::start(JobKind kind, std::string database, Work work) {
  const std::lock_guard lock(mutex_);
  const auto waiting = std::ranges::count_if(jobs_, [](const auto& job) { return !job->over(); });
  if (static_cast<std::size_t>(waiting) >= kMostWaiting) {
    throw Error(ErrorCode::conflict, fmt::format("{} jobs are waiting already; try again when one has ended", waiting));
  }
  for (const std::shared_ptr<Job>& job : jobs_) {
    if (!kind.alone || job->over() || job->kind.name != kind.name) continue;
    throw Error(ErrorCode::conflict,
                fmt::format("job {} is of the same kind, and only one may run at a time; try again when it has ended",
                            job->id));
  }
  auto job = std::make_shared<Job>();
  job->id = std::to_string(next_++);
  job->kind = std::move(kind);
  job->database = std::move(database);
  job->work = std::move(work);
  std::string id = job->id;
  jobs_.push_back(std::move(job));
  for (auto over = static_cast<std::size_t>(std::ranges::count_if(jobs_, [](const auto& one) { return one->over(); }));
       over > kMostKept; --over) {
    jobs_.erase(std::ranges::find_if(jobs_, [](const auto& one) { return one->over(); }));
  }
  changed_.notify_all();
  return id;
}

std::shared_ptr<Jobs::Job> Jobs::at(const std::string& id) const {
  for (const std::shared_ptr<Job>& job : jobs_) {
    if (job->id == id) return job;
  }
  throw Error(ErrorCode::not_found, fmt::format("no job '{}'; only the last {} are kept", printable(id), kMostKept));
}

JobAnswer Jobs::answer_of(const Job& job) {
  constexpr std::string_view kNames[] = {"waiting", "running", "done", "failed", "cancelled"};
  JobAnswer answer{.job = job.id,
                   .kind = job.kind.name,
                   .database = job.database,
                   .state = kNames[static_cast<std::size_t>(job.state)],
                   .fraction = job.fraction.load(std::memory_order_relaxed),
                   .result = {},
                   .error = {}};
  if (job.error) answer.error.emplace().json = *job.error;
  return answer;
}

JobAnswer Jobs::describe(const std::string& id, std::size_t from) const {
  Result result;
  JobAnswer answer;
  {
    const std::lock_guard lock(mutex_);
    const std::shared_ptr<Job> job = at(id);
    answer = answer_of(*job);
    result = job->result;
  }
  if (result.reported) answer.result.emplace().json = result.whole(from);
  return answer;
}

JobsAnswer Jobs::describe_all() const {
  const std::lock_guard lock(mutex_);
  JobsAnswer answer;
  for (const std::shared_ptr<Job>& job : jobs_) answer.jobs.push_back(answer_of(*job));
  return answer;
}

void Jobs::cancel(const std::string& id) {
  const std::lock_guard lock(mutex_);
  at(id)->cancelled = true;  // a waiting job still begins, and is stopped at its first step
}

std::optional<std::string> Jobs::changing(const std::string& database) const {
  const std::lock_guard lock(mutex_);
  for (const std::shared_ptr<Job>& job : jobs_) {
    if (!job->over() && job->kind.changes && job->database == database) return job->id;
  }
  return std::nullopt;
}

void Jobs::finish(Job& job, State state, json result, const std::optional<Error>& error) {
  const std::lock_guard lock(mutex_);
  job.state = state;
  if (!result.is_null()) job.result = {std::make_shared<const json>(std::move(result)), {}};
  if (error) job.error = error_json(*error, redact_);
  if (state == State::done) job.fraction = 1;
  job.work = {};
}

void Jobs::run() {
  using namespace std::chrono_literals;
  for (;;) {
    std::shared_ptr<Job> job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, 30s, [&] {
        return stopping_ || std::ranges::any_of(jobs_, [](const auto& one) { return one->state == State::waiting; });
      });
      if (stopping_) return;
      const auto at = std::ranges::find_if(jobs_, [](const auto& one) { return one->state == State::waiting; });
      if (at != jobs_.end()) {
        job = *at;
        job->state = State::running;
      }
    }
    if (!job) {
      tidy_();
      continue;
    }
    try {
      Context context(*this, *job);
      json result = job->work(context);
      finish(*job, State::done, std::move(result), {});
    } catch (const Error& error) {
      finish(*job, error.code() == ErrorCode::cancelled ? State::cancelled : State::failed, {}, error);
    } catch (const std::exception& error) {
      finish(*job, State::failed, {}, Error(ErrorCode::io, error.what()));
    }
  }
}

}  // namespace signweave::server
