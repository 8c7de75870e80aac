// Parts that a worker process shares with its supervisor: the protocol, its messages and its
// limits.
#pragma once

#include "jobs/queue/attempt_side.h"
#include "jobs/queue/worker_limits.h"
#include "jobs/queue/worker_messages.h"
#include "jobs/queue/worker_protocol.h"
