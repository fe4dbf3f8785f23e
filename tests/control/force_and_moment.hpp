// A wrench of its two vectors, for tests.
#pragma once

#include "kernel/core/vectors.hpp"

namespace tactus {

inline Vector6 wrench(const Vector3& f, const Vector3& m) {
  Vector6 both;
  both << f, m;
  return both;
}

}  // namespace tactus
