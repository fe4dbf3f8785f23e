#include "program/cycle_desk.hpp"

#include <algorithm>
#include <string_view>

#include "kernel/core/loop_bound.hpp"
#include "kernel/pipeline/only_block.hpp"
#include "program/session/fault_verdict.hpp"

namespace tactus {
namespace {

/// Returns the value of the first output with this name and quantity; null: there is none.
template <class Value>
const Value* find(const PortTable& ports, std::string_view port, Quantity quantity) {
  for (int i = 0; i < ports.count(); ++i)
    if (ports[i].port == port && ports[i].quantity == quantity && ports[i].offered)
      return static_cast<const Value*>(ports[i].value);
  return nullptr;
}

/// Returns the pose of the block that also has the Jacobian: the robot model.
const Pose* find_tip(const PortTable& ports) {
  for (int i = 0; i < ports.count(); ++i) {
    if (ports[i].quantity != Quantity::kJacobian) continue;
    for (int k = 0; k < ports.count(); ++k)
      if (std::string_view(ports[k].block) == ports[i].block &&
          ports[k].quantity == Quantity::kPose)
        return static_cast<const Pose*>(ports[k].value);
  }
  return nullptr;
}

/// True if the arm is braked or disabled and nobody has asked for that.
bool is_fault(const Event& event) {
  switch (event.cause) {
    case Cause::kHalt:
    case Cause::kOff:
    case Cause::kArm:
    case Cause::kAtRest: return false;
    default: return event.to != event.from && refuses(event.to);
  }
}

}  // namespace

CycleDesk::CycleDesk(CycleMail& mail, Executive& executive, Pipeline& pipeline)
    : mail_(mail), executive_(executive), pipeline_(pipeline) {
  const PortTable& ports = pipeline.ports;
  q_d_ = find<JointVector>(ports, "q_d", Quantity::kJointPosition);
  dq_d_ = find<JointVector>(ports, "dq_d", Quantity::kJointVelocity);
  pose_ = find_tip(ports);
  pose_d_ = find<Pose>(ports, "x_d", Quantity::kPose);
  wrench_ = find<Vector6>(ports, "h", Quantity::kWrench);
  const int block = only_block<WrenchFrontEnd>(pipeline);
  if (block >= 0) front_end_ = static_cast<WrenchFrontEnd*>(pipeline[block].place);
}

void CycleDesk::work(Status status) {
  watch_faults();
  const bool begins = waits_ && !executive_.busy();
  if (begins || status == Status::kArming) {
    if (mail_.orders.size() == 0) arm();
  } else if (rearm_ != 0 && !waits_) {
    finish(status);  // arming has ended otherwise
  }
  end_tare();
  take_parameters();
  take_order();
}

/// A rearm that was asked for before a fault does not undo it, whether the arm moved or was being
/// stopped.
void CycleDesk::watch_faults() {
  const EventLog& log = executive_.events();
  events_ = std::max(events_, log.lost());
  const std::uint32_t before = faults_;
  Event event;
  LoopBound<EventLog::kCapacity> events;
  for (; log.read(events_, event); ++events_) {
    events.tick();
    faults_ += is_fault(event) ? 1 : 0;
  }
  if (waits_ && faults_ != before) finish(Status::kEpochVoid);
}

/// Not while orders wait: one of them may be a Stop, which the rearm must not come before.
void CycleDesk::arm() {
  waits_ = false;
  const Status armed = executive_.arm();
  if (armed != Status::kArming) finish(armed);
}

/// The result of a rearm that is under way.
void CycleDesk::finish(Status status) {
  if (rearm_ != 0) static_cast<void>(mail_.results.post({rearm_, {status}}));
  rearm_ = 0;
  waits_ = false;
}

/// A rearm begins once the arm rests and its drives are disabled. An order waits until there is
/// space for its result, and those of a rearm and a tare.
void CycleDesk::take_order() {
  OrderMessage message;
  if (mail_.results.space() < 3 || !mail_.orders.take(message)) return;
  if (message.order == CycleOrder::kStop) {
    finish(Status::kHalted);
    executive_.halt();
    static_cast<void>(mail_.results.post({message.id}));
    return;
  }
  if (message.order == CycleOrder::kTare) return begin_tare(message.id);
  finish(Status::kHalted);  // a rearm that a newer one replaces
  if (message.faults != faults_) {
    static_cast<void>(mail_.results.post({message.id, {Status::kEpochVoid}}));
    return;
  }
  rearm_ = message.id;
  waits_ = true;
}

/// An arm that is braked, armed or disabled has no tare of its own: the next start begins with one.
void CycleDesk::begin_tare(std::uint32_t id) {
  Status status = Status::kNotOffered;
  if (front_end_ != nullptr)
    status = refuses(executive_.rung()) ? executive_.latched() : front_end_->begin_tare();
  if (status != Status::kOk) {
    static_cast<void>(mail_.results.post({id, {status}}));
    return;
  }
  tare_ = id;
  zero_before_ = front_end_->bias.value;
}

/// The result of a tare that is under way. What stops the arm has ended it by a brake.
void CycleDesk::end_tare() {
  if (tare_ == 0 || front_end_->tares()) return;
  static_cast<void>(
      mail_.results.post({tare_, front_end_->tared(), front_end_->bias.value, zero_before_}));
  tare_ = 0;
}

void CycleDesk::take_parameters() {
  TuningMessage message;
  if (mail_.tuned.space() == 0 || !mail_.tunings.take(message)) return;
  static_cast<void>(mail_.tuned.post(retune(*message.tuning)));
}

/// A brake ends with the law with which it began, and arming with that which start() has judged.
TuningVerdict CycleDesk::retune(const Tuning& tuning) {
  const Rung rung = executive_.rung();
  if (rung == Rung::kArming) return {Status::kArming};
  if (rung == Rung::kStop || executive_.busy()) return {Status::kNotAtRest};
  return pipeline_.retune(tuning, commands(rung));
}

/// A fixed number of outputs is copied, whoever watches.
void CycleDesk::tell_ports() {
  port_values_.cycle = executive_.telemetry().cycles;
  double* to = port_values_.numbers.data();
  for (int i = 0; i < pipeline_.ports.count(); ++i) to += flatten(pipeline_.ports[i], to);
  static_cast<void>(port_mail_->values.post(port_values_));
}

void CycleDesk::tell(const CycleTime& now) {
  const auto cycle = static_cast<int>(executive_.telemetry().cycles);
  if (port_mail_ != nullptr && cycle % port_mail_->divisor == 0) tell_ports();
  if (mail_.snapshots.space() == 0) {
    ++lost_;
    return;
  }
  const MotionState motion = pipeline_.motion_state();
  const RobotSection& robot = pipeline_.robot;
  CycleSnapshot told;
  told.stamp_ns = now.stamp_ns;
  told.time_s = motion.time_s;
  told.cycle = executive_.telemetry().cycles;
  told.slips = executive_.telemetry().slips;
  told.overruns = executive_.telemetry().overruns;
  told.lost = lost_;
  told.faults = faults_;
  told.rung = static_cast<std::uint8_t>(executive_.rung());
  told.phase = static_cast<std::uint8_t>(motion.phase);
  told.status = executive_.latched();
  told.fault = fault_verdict(told.status, executive_.guard(), pipeline_);
  if (told.status == Status::kCollision) {
    told.first = pipeline_.collision_check.telemetry().first;
    told.second = pipeline_.collision_check.telemetry().second;
  }
  told.override = motion.override;
  told.speed_scaling = robot.speed_scaling.value;
  told.q = robot.q.value;
  told.dq = robot.dq.value;
  told.tau = robot.tau.value;
  told.has = static_cast<std::uint8_t>((q_d_ != nullptr ? CycleSnapshot::kJointReference : 0) |
                                       (pose_ != nullptr ? CycleSnapshot::kPose : 0) |
                                       (pose_d_ != nullptr ? CycleSnapshot::kPoseReference : 0) |
                                       (wrench_ != nullptr ? CycleSnapshot::kWrench : 0));
  told.outputs = *robot.outputs;
  if (q_d_ != nullptr) told.q_d = *q_d_;
  if (dq_d_ != nullptr) told.dq_d = *dq_d_;
  if (pose_ != nullptr) told.pose = *pose_;
  if (pose_d_ != nullptr) told.pose_d = *pose_d_;
  if (wrench_ != nullptr) told.wrench = *wrench_;
  static_cast<void>(mail_.snapshots.post(told));
}

}  // namespace tactus
