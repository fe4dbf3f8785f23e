#include "sim_plant/ur/motion/servo_law.hpp"

#include <cmath>

namespace tactus::ur {

void ServoLaw::step(double set_point, double h_s, double& q, double& dq) const {
  // e'' + 2 d e' + g e = 0 with e = q - c; e(t) = exp(-d t) (e C + (e' + d e) S).
  const double d = 0.5 * gain * lookahead_s, w2 = gain - d * d, e = q - set_point;
  const double w = std::sqrt(std::abs(w2)), x = w * h_s;
  double c = 1.0, s = h_s;  // C and S at h: cos and sin(w h)/w, or the hyperbolic functions
  if (x > 1e-6) {
    c = w2 > 0.0 ? std::cos(x) : std::cosh(x);
    s = (w2 > 0.0 ? std::sin(x) : std::sinh(x)) / w;
  }
  const double decay = std::exp(-d * h_s), v = dq + d * e;
  q = set_point + decay * (e * c + v * s);
  dq = decay * (dq * c - (gain * e + d * dq) * s);
}

}  // namespace tactus::ur
