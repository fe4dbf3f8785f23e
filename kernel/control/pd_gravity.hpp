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
#include "kernel/math/bumpless_transfer.hpp"

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
    visit.tunable("kp", params.kp, kPositive, "N m/rad");
    visit.tunable("kd", params.kd, kPositive, "N m s/rad");
    visit.in("q_d", q_d);
    visit.in("q", q);
    visit.in("dq", dq);
    visit.optional("g", g);
    visit.out("tau", tau);
  }

  /// If the reference is at the measured position and the robot at rest, the first torque is
  /// gravity. [init]
  Status start() {
    transfer_.clear();
    return step(0.0);
  }
  /// The torque continues, with what is left of a change of the gains. [init]
  Status resume() { return step(0.0); }

  /// Returns kCommandNotFinite if the torque is not finite. [cyclic]
  Status step(double dt_s) {
    transfer_.step(dt_s);
    tau.value = torque(params);
    if (transfer_.runs()) tau.value += transfer_.value();
    return tau.value.allFinite() ? Status::kOk : Status::kCommandNotFinite;
  }
  /// No effect: the block has no motion of its own. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) {}

  /// Judges a change of the gains as judge_torque(). [between two cycles], after a step
  Verdict judge_change(const Params& next, const JointLimits& limits) const {
    return judge_torque(torque(next), torque(params), limits);
  }
  /// Changes the gains: the torque continues from the last one, and the difference fades with at
  /// most half of limits.dtau_max. [between two cycles], after a step
  void retune(const Params& next, const JointLimits& limits) {
    const JointVector difference = tau.value - torque(next);
    params = next;
    transfer_.start(difference, transfer_time(difference, limits));
  }

 private:
  JointVector torque(const Params& with) const {
    return with.kp.cwiseProduct(*q_d - *q) - with.kd.cwiseProduct(*dq) + *g;
  }

  BumplessTransfer<JointVector> transfer_;
};

}  // namespace tactus
