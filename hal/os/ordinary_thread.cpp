#include "hal/os/ordinary_thread.hpp"

#include <cstddef>

namespace tactus {
namespace {

constexpr std::size_t kStack = 256 * 1024;  // the default of 8 MiB would be locked in memory

}  // namespace

int start_ordinary_thread(pthread_t& thread, void* (*run)(void*), void* argument) {
  pthread_attr_t attributes;
  const sched_param none{};
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStack);
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  pthread_attr_setschedparam(&attributes, &none);
  const int error = pthread_create(&thread, &attributes, run, argument);
  pthread_attr_destroy(&attributes);
  return error;
}

}  // namespace tactus
