#include "program/session/lateness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "kernel/load/ini.hpp"
#include "kernel/model/inverse_dynamics.hpp"
#include "kernel/model/joint_trig.hpp"
#include "kernel/model/link_frames.hpp"
#include "program/session/torque_law.hpp"

namespace tactus {
namespace {

Following of_torques(const Pipeline& pipeline) {
  const TorqueLaw law = torque_law(pipeline);
  Following result;
  if (law.block == nullptr) result.why << "no pd_gravity and no pid gives the torque";
  if (law.nonlinear != nullptr) result.why << "[" << *law.block << "]: " << law.nonlinear;
  if (!result.why.empty()) {
    result.lateness_s.setConstant(kRequired);
    return result;
  }
  result.m = largest_inertia(pipeline.robot.tool.value, pipeline.collision.unknown_payload);
  result.kp = law.kp;
  result.kd = law.kd;
  result.damps_error = law.damps_error;
  result.of_torques = true;
  return result;
}

/// A servo of time constant T is critically damped, and a velocity's of first order.
Following of_servo(const Pipeline& pipeline, double servo_s) {
  Following result;
  const bool positions = pipeline.robot.mode() == CommandMode::kPosition;
  result.m.setConstant(positions ? servo_s * servo_s : 0.0);
  result.kd.setConstant(positions ? 2.0 * servo_s : 0.0);
  result.damps_error = pipeline.robot.dq_ff.wired();
  if (!positions) result.lateness_s.setConstant(servo_s);
  return result;
}

/// Returns the least e of m e'' + kd e' + kp e = 0 from e(0) = `begin` >= 0 and e'(0) = `slope` <=
/// 0 on, or 0.
double least_error(double m, double kp, double kd, double begin, double slope) {
  constexpr double kCritical = 1e-6;  // of the decay: so near, both roots count as two
  const double decay = 0.5 * kd / m, square = decay * decay - kp / m;
  const double w = std::max(std::sqrt(std::abs(square)), kCritical * decay);
  if (square < 0.0) {
    // e = exp(-decay t) (begin cos w t + b sin w t), first at rest where tan w t = -slope / k
    const double b = (slope + decay * begin) / w, k = -(decay * b + w * begin);
    const double angle = std::atan2(std::abs(slope), k);
    const double e = begin * std::cos(angle) + b * std::sin(angle);
    return std::min(0.0, std::exp(-decay * angle / w) * e);
  }
  // e = a exp(slow t) + b exp(fast t)
  const double slow = -decay + w, fast = -decay - w;
  const double a = (slope - fast * begin) / (slow - fast), b = begin - a;
  const double ratio = -b * fast / (a * slow);
  if (!(ratio > 1.0)) return 0.0;
  const double t = std::log(ratio) / (slow - fast);
  return std::min(0.0, a * std::exp(slow * t) + b * std::exp(fast * t));
}

}  // namespace

double lateness(double inertia, double kp, double kd) {
  return std::abs(least_error(inertia, kp, kd, 0.0, -1.0));
}

double overshoot(double inertia, double kp, double kd, bool takes_velocity) {
  return std::abs(least_error(inertia, kp, kd, 1.0, takes_velocity ? -kd / inertia : 0.0));
}

JointVector largest_inertia(const Tool& tool, double payload_kg) {
  constexpr int kPostures = 2000;
  constexpr double kReserve = 1.1;
  std::mt19937_64 random(1);
  const JointLimits limits;
  Tool weightless = assumed(tool);
  weightless.gravity.setZero();
  const Vector3 tip = dense(from_flange<Robot>(weightless.tip.p));
  JointVector largest = JointVector::Zero();
  for (int n = 0; n < kPostures; ++n) {
    JointVector q;
    for (int i = 0; i < kDof; ++i)
      q[i] = std::uniform_real_distribution<double>(limits.q_min[i], limits.q_max[i])(random);
    const JointTrig<Robot> trig = joint_trig<Robot>(q);
    const LinkFrames<Robot> frames = link_frames<Robot>(trig);
    for (int i = 0; i < kDof; ++i) {
      const JointVector unit = JointVector::Unit(i);
      const double own = inverse_dynamics<Robot>(trig, JointVector::Zero(), unit, weightless)[i];
      const LinkFrame& joint = frames[static_cast<std::size_t>(i) + 1];
      const Vector3 arm = frames[kDof].at(tip) - joint.p;
      const Vector3 axis = joint.r.col(2);
      const double lever = is_prismatic<Robot>(i) ? 1.0 : axis.cross(arm).norm();
      const double loaded = own + payload_kg * lever * lever;
      largest[i] = std::max(largest[i], kReserve * loaded + kRotorInertia);
    }
  }
  return largest;
}

Following following(const Pipeline& pipeline, double servo_s) {
  const bool of_efforts = pipeline.robot.mode() == CommandMode::kEffort;
  Following loop = of_efforts ? of_torques(pipeline) : of_servo(pipeline, servo_s);
  if (!loop.why.empty()) return loop;
  for (int i = 0; i < kDof; ++i) {
    const bool moves = loop.m[i] > 0.0;
    if (moves) loop.lateness_s[i] = lateness(loop.m[i], loop.kp[i], loop.kd[i]);
    loop.overshoot[i] =
        moves ? overshoot(loop.m[i], loop.kp[i], loop.kd[i], loop.damps_error) : 0.0;
  }
  if (loop.of_torques)  // it swings
    loop.compliance = (1.0 + loop.overshoot.array()) / loop.kp.array();
  return loop;
}

bool settle_lateness(const char* path, std::string_view text, const Following& loop,
                     Pipeline& pipeline) {
  Ini ini;
  LoadError error;
  if (!pipeline.collision.present || ini.parse(text, error) != Status::kOk) return true;
  const IniSection& section = *ini.find("collision");
  if (ini.find(section, "overshoot") == nullptr) pipeline.collision.overshoot = loop.overshoot;
  if (ini.find(section, "compliance") == nullptr) pipeline.collision.compliance = loop.compliance;
  if (ini.find(section, "lateness") != nullptr) return true;
  pipeline.collision.lateness = loop.lateness_s;
  if (loop.why.empty()) return true;
  std::fprintf(stderr,
               "%s:%d: [collision] lateness: missing; that of the loop cannot be computed: %s; "
               "state it (docs/collision.md)\n",
               path, section.line, loop.why.c_str());
  return false;
}

namespace {

/// Prints one key of the section as it is used, and warns where the file gives less than computed.
void print_key(const char* path, const char* key, const char* unit, const JointVector& used,
               const JointVector& computed, const Following& loop) {
  std::printf("%s: [collision] %s =", path, key);
  for (const double value : used) std::printf(" %.2g", value);
  const bool own = loop.why.empty() && (used.array() == computed.array()).all();
  std::printf("%s, %s\n", unit,
              !own              ? "as the file gives it"
              : loop.of_torques ? "from gains and largest inertias"
                                : "of the robot's servo");
  constexpr double kRounded = 0.9;  // of a figure with two digits
  if (!loop.why.empty() || (used.array() >= kRounded * computed.array()).all()) return;
  std::fprintf(stderr, "%s: note: [collision] %s: by gains and inertia it is", path, key);
  for (const double value : computed) std::fprintf(stderr, " %.2g", value);
  std::fprintf(stderr, "%s\n", unit);
}

}  // namespace

void print_lateness(const char* path, const Following& loop, const CollisionSection& section) {
  print_key(path, "lateness", " s", section.lateness, loop.lateness_s, loop);
  print_key(path, "overshoot", "", section.overshoot, loop.overshoot, loop);
  if (section.unknown_payload > 0.0)
    print_key(path, "compliance", " rad/(N m)", section.compliance, loop.compliance, loop);
}

}  // namespace tactus
