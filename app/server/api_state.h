#pragma once

#include <mutex>

#include "app/server/api.h"
#include "app/server/jobs.h"
#include "app/server/uploads.h"

namespace signweave::server {

/// What the calls of one Api share. Threads may share it.
struct ApiState {
  ServedDatabases& databases;
  ApiLimits limits;
  std::filesystem::path scratch;
  std::mutex evaluating;  ///< one at a time: it takes long, and the threads that answer are few
  Uploads uploads;
  Jobs jobs;  ///< the last: its thread ends before what it uses
};

struct Api::State : ApiState {};

}  // namespace signweave::server
