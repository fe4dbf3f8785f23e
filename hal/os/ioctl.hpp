// Ioctl: a request to a driver, behind a function that a test replaces.
#pragma once

#include <sys/ioctl.h>

namespace tactus {

/// As ioctl(2): -1 and errno on failure.
using Ioctl = int (*)(int file, unsigned long request, void* argument);

/// Asks the driver. [init]
inline int system_ioctl(int file, unsigned long request, void* argument) {
  return ioctl(file, request, argument);
}

}  // namespace tactus
