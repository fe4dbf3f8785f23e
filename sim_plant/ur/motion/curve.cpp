#include "sim_plant/ur/motion/curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::ur {
namespace {

constexpr int kSamples = 64, kMostSamples = 2048;
constexpr double kBetween = 0.95;  // fraction of a limit, as a margin between two samples
constexpr double kAlike = 0.97;    // agreement with twice as many samples that is enough
constexpr double kFlat = 1e-12;    // a smaller slope or bend limits nothing

bool sampled(const Curve& curve, int samples, double share, const MotionLimits& limits, Joints& q,
             Rates& rates) {
  constexpr double kAny = std::numeric_limits<double>::max();
  rates = {kAny, kAny};
  const double step = curve.length() / samples;
  Joints before = Joints::Zero();
  for (int i = 0; i <= samples; ++i) {
    Joints slope;
    if (!curve.at(i * step, q, q, slope)) return false;
    const double steep = slope.cwiseAbs().maxCoeff();
    const double slow = slope.cwiseAbs().cwiseQuotient(limits.speed).maxCoeff();
    if (slow > kFlat) rates.v = std::min(rates.v, 1.0 / slow);
    if (steep > kFlat) rates.a = std::min(rates.a, (1.0 - share) * limits.acceleration / steep);
    const double bend = i > 0 ? (slope - before).cwiseAbs().maxCoeff() / step : 0.0;
    if (bend > kFlat) rates.v = std::min(rates.v, std::sqrt(share * limits.acceleration / bend));
    before = slope;
  }
  return true;
}

}  // namespace

/// Doubles the samples until the result is stable: next to a singularity many are needed to find
/// the speed of a joint.
bool fastest(const Curve& curve, double share, const MotionLimits& limits, Joints& q,
             Rates& rates) {
  const Joints from = q;
  if (!sampled(curve, kSamples, share, limits, q, rates)) return false;
  if (share == 0.0) return true;  // straight in the joints
  for (int samples = 2 * kSamples; samples <= kMostSamples; samples *= 2) {
    const Rates before = rates;
    q = from;
    if (!sampled(curve, samples, share, limits, q, rates)) return false;
    if (rates.v >= kAlike * before.v && rates.a >= kAlike * before.a) break;
  }
  rates = {kBetween * rates.v, kBetween * rates.a};
  return true;
}

}  // namespace tactus::ur
