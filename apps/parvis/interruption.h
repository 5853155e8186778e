// The user's wish that long work ends (Ctrl+C, kill).
#pragma once

#include <atomic>

namespace parvis {

/// A flag that SIGINT and SIGTERM set from the first call on, so that work ends with its files in order.
const std::atomic<bool>& interruption();

}  // namespace parvis
