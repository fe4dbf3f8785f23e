#include "sim_plant/ur/controller/controller.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {
namespace {

constexpr double kSlider_s = 0.2;  // time in which the slider takes effect
constexpr int kCommandsPerCycle = 32;
constexpr double kLimiter = 0.95;  // fraction of a safety limit at which slowing down begins

}  // namespace

Status Controller::start() {
  const Settings& settings = machine_.settings;
  TRY(machine_.body.load(settings.initial_q, settings.surroundings));
  machine_.motion.rest(settings.initial_q);
  machine_.set_tcp(settings.tcp_offset);
  machine_.set_payload(settings.payload_kg, settings.payload_cog);
  show();
  return Status::kOk;
}

void Controller::tick() {
  ++machine_.cycle;
  machine_.messages.set_time(static_cast<std::uint64_t>(machine_.time_s() * 1e6 + 0.5));
  machine_.power.tick(machine_.cycle_s());
  if (!machine_.power.powered() && machine_.safety.protective_stopped()) machine_.safety.restart();
  machine_.body.push(faults_.push);
  dq_before_ = machine_.motion.dq() * machine_.speed_scaling;
  run_program();
  if (machine_.power.mode() == RobotMode::kRunning) {
    if (machine_.freedrive)
      carry_arm();
    else
      machine_.body.move(machine_.motion.q(), machine_.cycle_s());
    watch_arm();
  } else {
    machine_.body.stand();
    machine_.motion.rest(machine_.body.q());
  }
  machine_.sensors.sample(machine_.body.dq(), machine_.cycle_s());
  say_changes();
  show();
}

void Controller::run_program() {
  const bool able = machine_.power.running() && machine_.safety.normal();
  if (!able && runner_.running()) runner_.stop(machine_);
  if (able) runner_.poll(machine_);
  scale_speed();
  if (machine_.power.mode() != RobotMode::kRunning) return;
  if (machine_.safety.normal())
    move_targets();
  else
    machine_.motion.brake(machine_.cycle_s());
  machine_.motion.yield(machine_.force_mode, machine_.force_damping, machine_.measured_wrench(),
                        machine_.cycle_s() * machine_.speed_scaling);
  if (const Stop fault = machine_.motion.take_fault()) machine_.protective_stop(fault);
  if (machine_.motion.take_overlap())
    machine_.messages.error({Code::kBlend, kOverlappingBlends}, ReportLevel::kWarning);
}

/// Freedrive: the drives carry the arm's weight, and the targets follow the arm.
void Controller::carry_arm() {
  Body& body = machine_.body;
  body.drift(machine_.settings.freedrive_s, machine_.cycle_s());
  const double scaling = machine_.speed_scaling;
  machine_.motion.carry(body.q(), scaling > kNothing_s ? Joints(body.dq() / scaling) : body.dq());
}

/// Moves the time base towards the slider's speed; a pause slows it to zero, and a tool near the
/// speed limit of the safety system slows it too.
void Controller::scale_speed() {
  double goal = runner_.paused() ? 0.0 : machine_.io.speed_fraction;
  double& scaling = machine_.speed_scaling;
  const Motion& motion = machine_.motion;
  if (!runner_.running() && motion.resting()) scaling = goal;
  const double most = machine_.cycle_s() / kSlider_s;
  scaling += std::clamp(goal - scaling, -most, most);
  const double speed = (jacobian(motion.q(), motion.tool()) * motion.dq()).head<3>().norm();
  const double fastest = kLimiter * limits_.limits().tcp_speed;
  if (speed * scaling > fastest) scaling = fastest / speed;
}

/// Distributes the cycle's share of the stretched time to the commands of the program.
void Controller::move_targets() {
  Motion& motion = machine_.motion;
  double left_s = machine_.cycle_s() * machine_.speed_scaling;
  if (left_s < kNothing_s) left_s = 0.0;
  for (int n = 0; n < kCommandsPerCycle && left_s > kNothing_s; ++n) {
    if (!motion.busy()) runner_.command(machine_);
    if (!motion.busy()) {
      motion.idle(left_s, runner_.running());
      break;
    }
    left_s -= motion.advance(left_s);
  }
}

/// Checks path deviation and collision, then the limits of the safety system.
void Controller::watch_arm() {
  const Settings& settings = machine_.settings;
  const Joints q = machine_.body.q() + faults_.encoder_offset;
  const Joints off = (q - machine_.motion.q()).cwiseAbs() / settings.path_deviation;
  const Joints hit = (machine_.body.residual().array().abs() / settings.collision.array()).matrix();
  Eigen::Index joint = 0;
  image_.joint_position_deviation_ratio = off.maxCoeff(&joint);
  if (!(image_.joint_position_deviation_ratio < 1.0))
    machine_.protective_stop({Code::kPathDeviation, static_cast<std::int32_t>(joint)});
  image_.collision_detection_ratio = hit.maxCoeff(&joint);
  if (!(image_.collision_detection_ratio < 1.0))
    machine_.protective_stop({Code::kCollision, static_cast<std::int32_t>(joint)});
  watch_force_limits(q);
  watch_limits(q);
}

/// Checks the limits of a program for the deviation of the tip on axes that are not compliant.
void Controller::watch_force_limits(const Joints& q) {
  const ForceMode& mode = machine_.force_mode;
  const Motion& motion = machine_.motion;
  if (!mode.active) return;
  const Frame tip = forward(q) * motion.tool(), target = forward(motion.q()) * motion.tool();
  Vector6 off;
  off << motion.task_axes().transpose() * (tip.p - target.p),
      motion.task_axes().transpose() * rotation_vector(tip.r * target.r.transpose());
  for (int i = 0; i < 6; ++i)
    if (!mode.compliant(i) && mode.limits[i] > 0.0 && !(std::abs(off[i]) <= mode.limits[i]))
      machine_.protective_stop({Code::kPathDeviation, 0});
}

void Controller::watch_limits(const Joints& q) {
  const Joints dq = machine_.body.dq();
  const double tcp_speed = (jacobian(q, machine_.motion.tool()) * dq).head<3>().norm();
  const std::int32_t violated =
      limits_.check(q, dq, tcp_speed, image_.actual_momentum, machine_.cycle_s());
  if (violated == 0 || !machine_.safety.violation()) return;
  machine_.last_stop = {Code::kSafetyViolation, violated};
  machine_.stop_unsaid = true;
  machine_.power.switch_off();
}

void Controller::say_changes() {
  const bool changed = machine_.safety.tick(machine_.cycle_s());
  const Stop& stop = machine_.last_stop;
  if (changed)
    machine_.messages.safety_mode(machine_.safety.mode(), machine_.safety.normal() ? Stop{} : stop);
  if (machine_.stop_unsaid)
    machine_.messages.error(
        stop, stop.code == Code::kFromScript ? ReportLevel::kWarning : ReportLevel::kViolation);
  machine_.stop_unsaid = false;
  if (!machine_.safety.normal() && runner_.running()) runner_.stop(machine_);
}

}  // namespace tactus::ur
