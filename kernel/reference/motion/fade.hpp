// A difference that fades: the Hermite quintic that takes it, with its two derivatives, to zero and
// to rest, so that what it is added to stays continuous up to its acceleration.
#pragma once

namespace tactus {

/// Returns what is left of a difference after the fraction x, 0..1, of the time T. [any]
template <class Difference>
Difference faded(const Difference& e, double x, double T) {
  const double y = 1.0 - x;
  return {y * y * y *
              ((1.0 + 3.0 * x + 6.0 * x * x) * e.x + T * x * (1.0 + 3.0 * x) * e.dx +
               0.5 * T * T * x * x * e.ddx),
          y * y *
              (-30.0 * x * x / T * e.x + (1.0 + 2.0 * x - 15.0 * x * x) * e.dx +
               0.5 * T * x * (2.0 - 5.0 * x) * e.ddx),
          y * (-60.0 * x * (1.0 - 2.0 * x) / (T * T) * e.x + x * (-36.0 + 60.0 * x) / T * e.dx +
               (1.0 - 8.0 * x + 10.0 * x * x) * e.ddx)};
}

}  // namespace tactus
