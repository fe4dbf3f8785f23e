#include "program/cycle_endpoint.hpp"

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

/// True if the arm is braked or disabled without a request.
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

CycleEndpoint::CycleEndpoint(CycleMailboxes& mailboxes, Executive& executive, Pipeline& pipeline)
    : mailboxes_(mailboxes), executive_(executive), pipeline_(pipeline) {
  const PortTable& ports = pipeline.ports;
  q_d_ = find<JointVector>(ports, "q_d", Quantity::kJointPosition);
  dq_d_ = find<JointVector>(ports, "dq_d", Quantity::kJointVelocity);
  pose_ = find_tip(ports);
  pose_d_ = find<Pose>(ports, "x_d", Quantity::kPose);
  wrench_ = find<Vector6>(ports, "h", Quantity::kWrench);
  const int block = only_block<WrenchFrontEnd>(pipeline);
  if (block >= 0) front_end_ = static_cast<WrenchFrontEnd*>(pipeline[block].place);
}

void CycleEndpoint::work(Status status) {
  watch_faults();
  const bool begins = waits_ && !executive_.busy();
  if (begins || status == Status::kArming) {
    if (mailboxes_.orders.size() == 0) arm();
  } else if (rearm_ != 0 && !waits_) {
    finish(status);  // arming has ended otherwise
  }
  end_tare();
  take_parameters();
  take_order();
}

/// A rearm requested before a fault does not clear it, whether the arm moved or was being stopped.
void CycleEndpoint::watch_faults() {
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

/// Must not run while orders are queued: one of them may be a Stop, which has precedence.
void CycleEndpoint::arm() {
  waits_ = false;
  const Status armed = executive_.arm();
  if (armed != Status::kArming) finish(armed);
}

/// Posts the result of the rearm in progress, if there is one.
void CycleEndpoint::finish(Status status) {
  if (rearm_ != 0) static_cast<void>(mailboxes_.results.post({rearm_, {status}}));
  rearm_ = 0;
  waits_ = false;
}

/// A rearm begins once the arm is at rest and its drives are disabled. An order stays queued until
/// there is space for its result and for those of a rearm and a tare.
void CycleEndpoint::take_order() {
  OrderMessage message;
  if (mailboxes_.results.space() < 3 || !mailboxes_.orders.take(message)) return;
  if (message.order == CycleOrder::kStop) {
    finish(Status::kHalted);
    executive_.halt();
    static_cast<void>(mailboxes_.results.post({message.id}));
    return;
  }
  if (message.order == CycleOrder::kTare) return begin_tare(message.id);
  finish(Status::kHalted);  // the new rearm replaces the one in progress
  if (message.faults != faults_) {
    static_cast<void>(mailboxes_.results.post({message.id, {Status::kEpochVoid}}));
    return;
  }
  rearm_ = message.id;
  waits_ = true;
}

/// Refuses a tare while the arm brakes, is being armed or is disabled: the next start begins with
/// one.
void CycleEndpoint::begin_tare(std::uint32_t id) {
  Status status = Status::kNotOffered;
  if (front_end_ != nullptr)
    status = refuses(executive_.rung()) ? executive_.latched() : front_end_->begin_tare();
  if (status != Status::kOk) {
    static_cast<void>(mailboxes_.results.post({id, {status}}));
    return;
  }
  tare_ = id;
  zero_before_ = front_end_->bias.value;
}

/// Posts the result of a tare once it has ended; a brake ends it as well.
void CycleEndpoint::end_tare() {
  if (tare_ == 0 || front_end_->tares()) return;
  static_cast<void>(
      mailboxes_.results.post({tare_, front_end_->tared(), front_end_->bias.value, zero_before_}));
  tare_ = 0;
}

void CycleEndpoint::take_parameters() {
  TuningMessage message;
  if (mailboxes_.tuned.space() == 0 || !mailboxes_.tunings.take(message)) return;
  static_cast<void>(mailboxes_.tuned.post(retune(*message.tuning)));
}

/// Parameters do not change during a brake or arming, which end with the law they began with.
TuningVerdict CycleEndpoint::retune(const Tuning& tuning) {
  const Rung rung = executive_.rung();
  if (rung == Rung::kArming) return {Status::kArming};
  if (rung == Rung::kStop || executive_.busy()) return {Status::kNotAtRest};
  return pipeline_.retune(tuning, commands(rung));
}

/// Copies a fixed number of outputs, whether or not a browser is connected.
void CycleEndpoint::publish_ports() {
  port_values_.cycle = executive_.telemetry().cycles;
  double* to = port_values_.numbers.data();
  for (int i = 0; i < pipeline_.ports.count(); ++i) to += flatten(pipeline_.ports[i], to);
  static_cast<void>(port_mailbox_->values.post(port_values_));
}

void CycleEndpoint::publish(const CycleTime& now) {
  const auto cycle = static_cast<int>(executive_.telemetry().cycles);
  if (port_mailbox_ != nullptr && cycle % port_mailbox_->divisor == 0) publish_ports();
  if (mailboxes_.snapshots.space() == 0) {
    ++lost_;
    return;
  }
  const MotionState motion = pipeline_.motion_state();
  const RobotSection& robot = pipeline_.robot;
  CycleSnapshot snapshot;
  snapshot.stamp_ns = now.stamp_ns;
  snapshot.time_s = motion.time_s;
  snapshot.cycle = executive_.telemetry().cycles;
  snapshot.slips = executive_.telemetry().slips;
  snapshot.overruns = executive_.telemetry().overruns;
  snapshot.lost = lost_;
  snapshot.faults = faults_;
  snapshot.rung = static_cast<std::uint8_t>(executive_.rung());
  snapshot.phase = static_cast<std::uint8_t>(motion.phase);
  snapshot.status = executive_.latched();
  snapshot.fault = fault_verdict(snapshot.status, executive_.guard(), pipeline_);
  if (snapshot.status == Status::kCollision) {
    snapshot.first = pipeline_.collision_check.telemetry().first;
    snapshot.second = pipeline_.collision_check.telemetry().second;
  }
  snapshot.override = motion.override;
  snapshot.speed_scaling = robot.speed_scaling.value;
  snapshot.q = robot.q.value;
  snapshot.dq = robot.dq.value;
  snapshot.tau = robot.tau.value;
  snapshot.has =
      static_cast<std::uint8_t>((q_d_ != nullptr ? CycleSnapshot::kJointReference : 0) |
                                (pose_ != nullptr ? CycleSnapshot::kPose : 0) |
                                (pose_d_ != nullptr ? CycleSnapshot::kPoseReference : 0) |
                                (wrench_ != nullptr ? CycleSnapshot::kWrench : 0));
  snapshot.outputs = *robot.outputs;
  if (q_d_ != nullptr) snapshot.q_d = *q_d_;
  if (dq_d_ != nullptr) snapshot.dq_d = *dq_d_;
  if (pose_ != nullptr) snapshot.pose = *pose_;
  if (pose_d_ != nullptr) snapshot.pose_d = *pose_d_;
  if (wrench_ != nullptr) snapshot.wrench = *wrench_;
  static_cast<void>(mailboxes_.snapshots.post(snapshot));
}

}  // namespace tactus
