// JRG: the joint-space reference generator as a block. What the references may be and how they are
// interpolated is in reference_generator.hpp; this file is its ports.   [Risi et al. 2026, section
// II]
#pragma once

#include "kernel/port.hpp"
#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/reference_generator.hpp"

namespace tactus {

struct JointReferenceGenerator {
  struct Params {
    JointVector start_tolerance = JointVector::Constant(0.01);  ///< rad
    OnlineMode online = OnlineMode::kForward;
    double timeout_ms = 0.0;  ///< of a stream of online points; 0: none
  } params;
  In<Quantity::kJointPosition> q;  // measured: the reference at start
  Out<Quantity::kJointPosition> q_d;
  Out<Quantity::kJointVelocity> dq_d;
  Out<Quantity::kJointAcceleration> ddq_d;
  Out<Quantity::kJointEffort> tau_d;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("start_tolerance", params.start_tolerance, Range{0.0, 0.5}, "rad");
    visit.choice("online", params.online, kOnlineModeWords);
    visit.param("timeout_ms", params.timeout_ms, kNonNegative, "ms");
    visit.in("q", q);
    visit.out("q_d", q_d), visit.out("dq_d", dq_d), visit.out("ddq_d", ddq_d);
    visit.out("tau_d", tau_d);
    visit.channel(channel);
  }

  /// The reference is the measured position, at rest. kStateNotFinite. [init]
  Status start();
  /// The reference of this cycle. kReferenceFault. [cyclic]
  Status step(double dt_s);

  ReferenceChannel<JointSpace>* channel = nullptr;  ///< bound by the loader

 private:
  void write();

  ReferenceGenerator<JointSpace> generator_;
};

}  // namespace tactus
