// JRG: the joint-space reference generator as a block with its ports and parameters; the generator
// itself is ReferenceGenerator (kernel/reference/generator/). The block also gives its reference as
// pose and twist of the tool tip, for a chain of Cartesian blocks.   [Risi et al. 2026, section II]
#pragma once

#include "kernel/core/port.hpp"
#include "kernel/reference/blocks/generator_settings.hpp"
#include "kernel/reference/blocks/stream_outputs.hpp"
#include "kernel/reference/space/joint_space.hpp"

namespace tactus {

struct JointReferenceGenerator : StreamOutputs<> {
  static constexpr const char* kType = "joint_reference_generator";

  struct Params {
    JointVector start_tolerance = JointVector::Constant(0.01);  ///< rad
    JointVector path_tolerance = JointVector::Constant(0.5);    ///< rad; 0: not checked
    JointVector goal_tolerance = JointVector::Constant(0.01);   ///< rad; 0: not checked
    GeneratorSettings generator;
  } params;
  In<Quantity::kJointPosition> q;       // measured: the reference at start
  In<Quantity::kJointVelocity> dq;      // measured, for the goal and feedback
  In<Quantity::kJointEffort> tau;       // measured, for feedback
  In<Quantity::kTool> tool;             // without it the tip is the flange
  In<Quantity::kScalar> speed_scaling;  // of the robot, 0..1: scales the speed of trajectories
  Out<Quantity::kJointPosition> q_d;
  Out<Quantity::kJointVelocity> dq_d;
  Out<Quantity::kJointAcceleration> ddq_d;
  Out<Quantity::kJointEffort> tau_d;
  Out<Quantity::kPose> x_d;   ///< pose of the tip at q_d; the quaternion's sign never jumps
  Out<Quantity::kTwist> v_d;  ///< J(q_d) dq_d

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("start_tolerance", params.start_tolerance, Range{0.0, 0.5}, "rad");
    visit.param("path_tolerance", params.path_tolerance, kNonNegative, "rad");
    visit.param("goal_tolerance", params.goal_tolerance, kNonNegative, "rad");
    params.generator.describe(visit, "rad", "rad/s");
    visit.in("q", q);
    visit.optional("dq", dq);
    visit.optional("tau", tau);
    visit.optional("tool", tool);
    visit.optional("speed_scaling", speed_scaling);
    visit.out("q_d", q_d);
    visit.out("dq_d", dq_d);
    visit.out("ddq_d", ddq_d);
    visit.out("tau_d", tau_d);
    visit.out("x_d", x_d);
    visit.out("v_d", v_d);
    describe_outputs(visit);
    visit.channel(channel);
  }

  /// Makes the measured position, at rest, the reference. kStateNotFinite. [init]
  Status start();
  /// Outputs the reference of this cycle. kReferenceFault. [cyclic]
  Status step(double dt_s);
  /// Brings the reference to rest and refuses requests with `why` until the next start. Must be
  /// called in every cycle in which they are refused. [cyclic]
  void brake(Status why, BrakeWay way) {
    if (channel != nullptr) generator_.attach(*channel);
    generator_.brake(why, way);
  }
  Verdict held() const { return generator_.held(); }
  bool at_rest() const { return generator_.reference().standing(); }
  MotionState motion_state() const { return generator_.motion_state(); }
  /// Keeps the reference where it has come to rest. [init]
  Status resume();

  ReferenceChannel<JointSpace>* channel = nullptr;  ///< bound by the loader

 private:
  Status start_from(const JointSpace::Point& point);
  JointSpace::Point measured() const;
  void write();

  ReferenceGenerator<JointSpace> generator_;
};

}  // namespace tactus
