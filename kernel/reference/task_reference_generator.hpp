// TRG: the task-space reference generator as a block. What the references may be and how they are
// interpolated is in reference_generator.hpp; this file is its ports.   [Risi et al. 2026, section
// II]
#pragma once

#include "kernel/port.hpp"
#include "kernel/reference/generator_settings.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {

struct TaskReferenceGenerator {
  static constexpr const char* kType = "task_reference_generator";

  struct Params {
    TaskSpace::Tolerance start_tolerance;            ///< of a trajectory that begins at t = 0
    TaskSpace::Band path_tolerance;                  ///< 0: not checked
    TaskSpace::Band goal_tolerance = {0.005, 0.02};  ///< 0: not checked
    GeneratorSettings generator;
  } params;
  In<Quantity::kPose> x;                // measured: the reference at start
  In<Quantity::kTwist> v;               // measured, for the goal and feedback
  In<Quantity::kWrench> h;              // measured, for feedback
  In<Quantity::kScalar> speed_scaling;  // of the robot: trajectories pass that much slower
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
    p.generator.describe(visit, "m/s");
    visit.in("x", x);
    visit.optional("v", v);
    visit.optional("h", h);
    visit.optional("speed_scaling", speed_scaling);
    visit.out("x_d", x_d), visit.out("v_d", v_d), visit.out("a_d", a_d);
    visit.out("h_d", h_d), visit.out("dh_d", dh_d);
    visit.channel(channel);
  }

  /// The reference is the measured pose, at rest, without wrench. kStateNotFinite. [init]
  Status start();
  /// The reference of this cycle. kReferenceFault. [cyclic]
  Status step(double dt_s);
  /// The reference comes to rest; references are refused with `why` until the next start. To be
  /// called in every cycle in which they are. [cyclic]
  void brake(Status why, BrakeWay way) { generator_.brake(why, way); }

  ReferenceChannel<TaskSpace>* channel = nullptr;  ///< bound by the loader

 private:
  TaskSpace::Point measured() const;
  void write(const Eigen::Quaterniond& last);

  ReferenceGenerator<TaskSpace> generator_;
};

}  // namespace tactus
