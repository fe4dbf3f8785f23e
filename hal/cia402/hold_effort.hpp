// HoldEffort: the torque that holds the arm between enabling and the first command, when torques
// are commanded:
//
//   tau = g(q) + K (q_h - q) - D dq        g(q) = 0 if the drives carry the weight
//
// It begins at zero, while the brakes are still closed, and changes no faster than the robot's
// torque rate, so that brakes and motors hand over without a step.
#pragma once

#include "hal/cia402/cia402_settings.hpp"
#include "kernel/core/joint_limits.hpp"
#include "kernel/model/gravity.hpp"

namespace tactus::cia402 {

class HoldEffort {
 public:
  /// Takes gains, tool and the period, s. [init]
  void configure(const Cia402Settings& settings, const Tool& tool, double period_s) {
    stiffness_ = settings.hold_stiffness;
    damping_ = settings.hold_damping;
    carries_ = settings.gravity == Gravity::kCommand;
    tool_ = tool;
    step_Nm_ = limits_.dtau_max * period_s;
  }
  /// Begins to hold the arm at q, rad, with no torque. [cyclic]
  void start(const JointVector& q) {
    held_ = q;
    tau_.setZero();
  }
  /// Takes the torque that is commanded instead, N m, from which a later hold would go on. [cyclic]
  void track(const JointVector& q, const JointVector& tau) {
    held_ = q;
    tau_ = tau;
  }
  /// Returns the torque of this cycle, N m, within the robot's limits. [cyclic]
  const JointVector& step(const JointVector& q, const JointVector& dq) {
    JointVector wanted = stiffness_.cwiseProduct(held_ - q) - damping_.cwiseProduct(dq);
    if (carries_) wanted += weight(q);
    wanted = wanted.cwiseMin(limits_.tau_max).cwiseMax(-limits_.tau_max);
    tau_ += (wanted - tau_).cwiseMin(step_Nm_).cwiseMax(-step_Nm_);
    return tau_;
  }

  /// Returns g(q), N m, of arm and tool. [cyclic]
  JointVector weight(const JointVector& q) const {
    return gravity<Robot>(joint_trig<Robot>(q), tool_);
  }

 private:
  JointLimits limits_;
  JointVector stiffness_ = JointVector::Zero(), damping_ = JointVector::Zero();
  JointVector step_Nm_ = JointVector::Zero();
  bool carries_ = true;
  Tool tool_;
  JointVector held_ = JointVector::Zero(), tau_ = JointVector::Zero();
};

}  // namespace tactus::cia402
