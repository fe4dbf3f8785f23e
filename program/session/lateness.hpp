// Lateness and overshoot: how far a joint leaves the range between where it is and where its
// reference gets, for [collision].
//
// A joint of inertia m under kp and kd, or a position servo, leaves its reference q_d by e = q_d -
// q:
//
//   m e'' + kd e' + kp e = m q_d'' + (1 - c) kd q_d' + disturbance
//
// where c = 1 if the law takes the velocity of the reference and 0 if it does not. The equation is
// linear, so that every motion is a sum of three, and the joint overshoots by at most the sum of
//
//   lateness |dq|       the reference rests where the joint is   e(0) = 0  e'(0) = -1
//   overshoot |q_d - q| the joint rests beside its reference     e(0) = 1  e'(0) = 0
//   overshoot times the way of the reference, a sum of steps     e(0) = 1  e'(0) = -c kd/m
//
// The factors are -min e(t) of these responses; of the last two the last is the larger one. A
// constant disturbance, and an integral, which is frozen while the arm brakes, move e alone.
#pragma once

#include "kernel/core/text.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

/// The inertia that the model lacks, kg m^2: the rotor seen at the joint. The figure that the
/// plants take (sim_plant/arm/plant_params.hpp).
inline constexpr double kRotorInertia = 0.1;

/// Returns the lateness, s, of a joint of `inertia` > 0, kg m^2, under `kp` and `kd` > 0. [init]
double lateness(double inertia, double kp, double kd);

/// Returns the overshoot of such a joint, as a share of a step of its reference. [init]
double overshoot(double inertia, double kp, double kd, bool takes_velocity);

/// Returns the largest inertia about every joint, kg m^2, over the postures within the joints'
/// limits: of the arm, the tool of the file, and `payload_kg` at its tip. Sampled, and made a tenth
/// larger. [init]
JointVector largest_inertia(const Tool& tool, double payload_kg);

/// How the joints follow their reference, by the equation above; m = 0: at once.
struct Following {
  JointVector m = JointVector::Zero();                 ///< kg m^2, or s^2 of a servo
  JointVector kp = JointVector::Ones();                ///< N m/rad, or 1
  JointVector kd = JointVector::Zero();                ///< N m s/rad, or s
  bool damps_error = false;                            ///< c = 1
  bool of_torques = false;                             ///< not a servo of the robot
  JointVector lateness_s = JointVector::Zero();        ///< NaN: not known
  JointVector overshoot = JointVector::Constant(1.0);  ///< the worst, where it is not known
  JointVector compliance = JointVector::Zero();        ///< rad/(N m), to a torque at once
  Message why;                                         ///< it is not known
};

/// Returns how the loop of a loaded pipeline follows. `servo_s` is the time constant of the robot's
/// servo for positions and velocities, s; 0 also: not known. [init]
Following following(const Pipeline& pipeline, double servo_s);

/// Gives [collision] lateness, overshoot and compliance of the loop where the file gives none.
/// Prints why not, with path and line, and returns false, if the lateness is not known. [init]
bool settle_lateness(const char* path, std::string_view text, const Following& loop,
                     Pipeline& pipeline);

/// Prints what the section uses, what makes it so, and how that compares with the loop.
void print_lateness(const char* path, const Following& loop, const CollisionSection& section);

}  // namespace tactus
