// A thread without priority, for the work around the cycle that may wait.
#pragma once

#include <pthread.h>

namespace tactus {

/// Starts `run(argument)` in a thread with ordinary scheduling, whatever the caller's, and a small
/// stack. Call it before the calling thread is bound to a CPU, since threads inherit the binding.
/// Returns 0 or an errno. [init]
int start_ordinary_thread(pthread_t& thread, void* (*run)(void*), void* argument);

}  // namespace tactus
