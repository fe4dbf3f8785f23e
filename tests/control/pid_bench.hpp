// The PID law wired to values that a test sets, and joints of unit inertia that it drives.
#pragma once

#include "kernel/control/pid.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline const JointVector kJointZero = JointVector::Zero(), kJointOnes = JointVector::Ones();

/// Gains 100, 0 and 10, limits that are never reached. dq, dq_d and g are wired, the other optional
/// inputs are not.
struct PidBench {
  JointVector q_d = kJointZero, q = kJointZero, dq_d = kJointZero, dq = kJointZero,
              ddq_d = kJointZero, tau_d = kJointZero, g = kJointZero, tau_measured = kJointZero;
  Pid pid;

  PidBench() {
    gains(100.0, 0.0, 10.0);
    pid.params.output_limit.setConstant(1e6);
    pid.params.integral_limit.setConstant(1e6);
    pid.q_d.source = &q_d;
    pid.q.source = &q;
    pid.dq_d.source = &dq_d;
    pid.dq.source = &dq;
    pid.g.source = &g;
  }
  void gains(double kp, double ki, double kd) {
    pid.params.gains = {kp * kJointOnes, ki * kJointOnes, kd * kJointOnes};
  }
  void torque_is(const JointVector& expected) const {
    ASSERT_NEAR((pid.tau.value - expected).cwiseAbs().maxCoeff(), 0.0, 1e-12);
  }
  void step(double dt_s) { ASSERT_OK(pid.step(dt_s)); }
  void step_gives(double dt_s, const JointVector& expected) {
    step(dt_s);
    torque_is(expected);
  }
};

/// Free joints of 1 kg m^2 under the law, each period integrated exactly.
struct PidAndInertia : PidBench {
  double load = 0.0;  ///< N m, against the joints

  void cycle(double dt_s) {
    step(dt_s);
    const JointVector ddq = pid.tau.value - load * kJointOnes;
    q += dt_s * (dq + 0.5 * dt_s * ddq);
    dq += dt_s * ddq;
  }
};

inline constexpr double kPeriods_s[] = {8e-3, 2e-3, 1e-3};  // 125 Hz, 500 Hz, 1 kHz

/// Free inertia of 1 kg m^2 under gains that put all three poles at -p: to a step of the reference,
/// with the derivative on measurement, it answers 1 - exp(-pt) (1 + pt - (pt)^2).
inline constexpr double kPole = 5.0;
inline void place_poles(PidBench& b) {
  b.gains(3.0 * kPole * kPole, kPole * kPole * kPole, 3.0 * kPole);
  b.pid.params.derivative = Derivative::kMeasurement;
}

}  // namespace tactus
