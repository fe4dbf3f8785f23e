// The messages of a trajectory, for tests of the server.
#pragma once

#include "tests/gateway/server/client_bench.hpp"

namespace tactus {

inline constexpr auto kJoints = static_cast<std::size_t>(kDof);

/// A swing of joint 1 about home, at rest at both ends: 0.2 sin^3 (pi t / T).
inline JointSpace::Point swing(double t, double duration_s) {
  const double w = 3.14159265358979323846 / duration_s, s = std::sin(w * t), c = std::cos(w * t);
  JointSpace::Point point = ServerBench::home();
  point.q[0] += 0.2 * s * s * s;
  point.dq[0] = 0.6 * w * s * s * c;
  point.ddq[0] = 0.6 * w * w * (2.0 * s * c * c - s * s * s);
  return point;
}

/// Waypoints `first` to `last` at 1 kHz, of `at(t)`, with velocities and accelerations.
template <class At>
RawMessage part(int first, int last, At at) {
  static std::array<double, 60> times;
  static std::array<double, 60 * 3 * kJoints> numbers;
  std::size_t count = 0;
  for (int i = first; i < last; ++i, ++count) {
    const JointSpace::Point point = at(1e-3 * i);
    times[count] = 1e-3 * i;
    for (std::size_t k = 0; k < kJoints; ++k) {
      numbers[3 * kJoints * count + k] = point.q[static_cast<int>(k)];
      numbers[3 * kJoints * count + kJoints + k] = point.dq[static_cast<int>(k)];
      numbers[3 * kJoints * count + 2 * kJoints + k] = point.ddq[static_cast<int>(k)];
    }
  }
  RawMessage message;
  message.reals(1, times.data(), count).reals(2, numbers.data(), 3 * kJoints * count);
  return message;
}

inline RawMessage begin(std::uint32_t window = 0) {
  return RawMessage().number(6, 1).number(7, 1).number(10, window);
}

}  // namespace tactus
