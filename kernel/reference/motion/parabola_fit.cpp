#include "kernel/reference/motion/parabola_fit.hpp"

namespace tactus {

ParabolaFit fit_parabola(const std::array<double, kFitted>& t) {
  const double mean = 0.25 * (t[0] + t[1] + t[2] + t[3]);
  double square = 0.0, cube = 0.0, squared = 0.0;
  for (const double at : t) {
    const double u = at - mean;
    square += u * u;
    cube += u * u * u;
  }
  const double b = cube / square, c = 0.25 * square;
  const auto bent = [&](double u) { return u * (u - b) - c; };
  for (const double at : t) squared += bent(at - mean) * bent(at - mean);
  const double u0 = t[0] - mean;
  ParabolaFit fit;
  for (std::size_t i = 0; i < kFitted; ++i) {
    const double slope = (t[i] - mean) / square, bend = bent(t[i] - mean) / squared;
    fit.x[i] = 0.25 + slope * u0 + bend * bent(u0);
    fit.dx[i] = slope + bend * (2.0 * u0 - b);
    fit.ddx[i] = 2.0 * bend;
  }
  return fit;
}

}  // namespace tactus
