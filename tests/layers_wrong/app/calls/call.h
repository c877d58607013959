#pragma once

#include "app/server/server.h"
