// JointServo: the velocity and position loop of one drive, which knows nothing of the arm:
//
//   tau = kv (v_c - dq) + I,   dI/dt = kv ki (v_c - dq),   v_c = kp (q_c - q) + v_ff
#pragma once

#include <algorithm>

namespace tactus::drives {

struct ServoGains {
  double kv;         ///< N m s/rad
  double ki = 25.0;  ///< 1/s
  double kp = 35.0;  ///< 1/s
};

struct JointServo {
  double integral_Nm = 0.0;

  /// Begins without a step: with the torque that acts now. [any]
  void start(double tau_Nm) { integral_Nm = tau_Nm; }

  /// Returns the torque, N m, within +-limit, for the next `dt_s`; rad/s. [cyclic]
  double step(const ServoGains& gains, double v_c, double dq, double limit_Nm, double dt_s) {
    const double error = v_c - dq;
    integral_Nm = std::clamp(integral_Nm + gains.kv * gains.ki * error * dt_s, -limit_Nm, limit_Nm);
    return std::clamp(gains.kv * error + integral_Nm, -limit_Nm, limit_Nm);
  }
};

}  // namespace tactus::drives
