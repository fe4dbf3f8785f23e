// TRG: the task-space reference generator as a block with its ports and parameters; the generator
// itself is ReferenceGenerator (kernel/reference/generator/).   [Risi et al. 2026, section II]
#pragma once

#include "kernel/core/port.hpp"
#include "kernel/reference/blocks/generator_settings.hpp"
#include "kernel/reference/blocks/stream_outputs.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

struct TaskReferenceGenerator : StreamOutputs<> {
  static constexpr const char* kType = "task_reference_generator";

  struct Params {
    TaskSpace::Tolerance start_tolerance;            ///< for trajectories that begin at t = 0
    TaskSpace::Band path_tolerance = {0.05, 0.3};    ///< 0: not checked
    TaskSpace::Band goal_tolerance = {0.005, 0.02};  ///< 0: not checked
    GeneratorSettings generator;
  } params;
  In<Quantity::kPose> x;                // measured: the reference at start
  In<Quantity::kTwist> v;               // measured, for the goal and feedback
  In<Quantity::kWrench> h;              // measured, for feedback
  In<Quantity::kScalar> speed_scaling;  // of the robot, 0..1: scales the speed of trajectories
  Out<Quantity::kPose> x_d;             ///< the quaternion is unit and its sign never jumps
  Out<Quantity::kTwist> v_d;
  Out<Quantity::kTaskAcceleration> a_d;
  Out<Quantity::kWrench> h_d;  ///< what the environment is to exert on the tool
  Out<Quantity::kWrenchRate> dh_d;

  template <class Visitor>
  void describe(Visitor& visit) {
    Params& p = params;
    visit.param("start_position_tolerance", p.start_tolerance.position_m, Range{0.0, 0.5}, "m");
    visit.param("start_angle_tolerance", p.start_tolerance.angle_rad, Range{0.0, 0.5}, "rad");
    visit.param("path_position_tolerance", p.path_tolerance.position_m, kNonNegative, "m");
    visit.param("path_angle_tolerance", p.path_tolerance.angle_rad, kNonNegative, "rad");
    visit.param("goal_position_tolerance", p.goal_tolerance.position_m, kNonNegative, "m");
    visit.param("goal_angle_tolerance", p.goal_tolerance.angle_rad, kNonNegative, "rad");
    p.generator.describe(visit, "m", "m/s");
    visit.in("x", x);
    visit.optional("v", v);
    visit.optional("h", h);
    visit.optional("speed_scaling", speed_scaling);
    visit.out("x_d", x_d);
    visit.out("v_d", v_d);
    visit.out("a_d", a_d);
    visit.out("h_d", h_d);
    visit.out("dh_d", dh_d);
    describe_outputs(visit);
    visit.channel(channel);
  }

  /// Makes the measured pose, at rest and without wrench, the reference. kStateNotFinite. [init]
  Status start();
  /// Outputs the reference of this cycle. kReferenceFault. [cyclic]
  Status step(double dt_s);
  /// Brings the reference to rest and refuses requests with `why` until the next start. Must be
  /// called in every cycle in which they are refused. [cyclic]
  void brake(Status why, BrakeWay way) {
    if (channel != nullptr) generator_.attach(*channel);
    generator_.brake(why, way);
  }
  bool at_rest() const { return generator_.reference().standing(); }
  MotionState motion_state() const { return generator_.motion_state(); }

  ReferenceChannel<TaskSpace>* channel = nullptr;  ///< bound by the loader

 private:
  TaskSpace::Point measured() const;
  void write(const Eigen::Quaterniond& last);

  ReferenceGenerator<TaskSpace> generator_;
};

}  // namespace tactus
