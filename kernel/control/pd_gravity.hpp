// PD control with gravity compensation.
//
//   tau = Kp (q_d - q) - Kd dq + g(q)                                  [Risi et al. 2026, eq. 2;
//   Kelly et al. 2005]
//
// Static law: no state, the same at every period. The guard limits torque and torque rate, as for
// every law.
#pragma once

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"

namespace tactus {

struct PdGravity {
  static constexpr const char* kType = "pd_gravity";

  struct Params {
    JointVector kp = JointVector::Constant(kRequired);  ///< N m/rad
    JointVector kd = JointVector::Constant(kRequired);  ///< N m s/rad
  } params;
  In<Quantity::kJointPosition> q_d, q;
  In<Quantity::kJointVelocity> dq;
  In<Quantity::kJointEffort> g;  ///< gravity torque; not wired: the robot compensates by itself
  Out<Quantity::kJointEffort> tau;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("kp", params.kp, kPositive, "N m/rad");
    visit.param("kd", params.kd, kPositive, "N m s/rad");
    visit.in("q_d", q_d);
    visit.in("q", q);
    visit.in("dq", dq);
    visit.optional("g", g);
    visit.out("tau", tau);
  }

  /// If the reference is at the measured position and the robot at rest, the first torque is
  /// gravity. [init]
  Status start() { return step(0.0); }

  /// Returns kCommandNotFinite if the torque is not finite. [cyclic]
  Status step(double /*dt_s*/) {
    tau.value = params.kp.cwiseProduct(*q_d - *q) - params.kd.cwiseProduct(*dq) + *g;
    return tau.value.allFinite() ? Status::kOk : Status::kCommandNotFinite;
  }
  /// No effect: the block has no motion of its own. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) {}
};

}  // namespace tactus
