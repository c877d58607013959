#pragma once

#include "app/server/api.h"
#include "app/server/jobs.h"
#include "app/server/uploads.h"

namespace signweave::server {

/// State shared by the calls of one Api. Thread-safe.
struct ApiState {
  ServedDatabases& databases;
  ApiLimits limits;
  std::filesystem::path scratch;
  Uploads uploads;
  Jobs jobs;  ///< declared last: its thread ends before what it uses is destroyed
};

struct Api::State : ApiState {};

}  // namespace signweave::server
