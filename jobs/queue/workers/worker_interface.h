// All headers that a worker process shares with its supervisor: protocol, messages, limits.
#pragma once

#include "jobs/queue/confine/worker_limits.h"
#include "jobs/queue/workers/worker_attempt.h"
#include "jobs/queue/workers/worker_messages.h"
#include "jobs/queue/workers/worker_protocol.h"
