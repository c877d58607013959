#pragma once

#include "app/server/api.h"
#include "app/server/jobs.h"
#include "app/server/uploads.h"

namespace signweave::server {

/// What the calls of one Api share. Threads may share it.
struct ApiState {
  ServedDatabases& databases;
  ApiLimits limits;
  std::filesystem::path scratch;
  Uploads uploads;
  Jobs jobs;  ///< the last: its thread ends before what it uses
};

struct Api::State : ApiState {};

}  // namespace signweave::server
