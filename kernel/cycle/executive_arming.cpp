// Executive: arming, and the requests of a board between two cycles.
#include "kernel/cycle/executive.hpp"

#include <cmath>

#include "kernel/core/loop_bound.hpp"

namespace tactus {

Status Executive::add(const Row& row) {
  if (row.run == nullptr) return Status::kBadValue;
  return pipeline_.schedule.add(row, pipeline_.robot.period_us).status;
}

Status Executive::start() {
  if (rung() != Rung::kDisabled) static_cast<void>(stop());
  period_ns_ = std::int64_t{1000} * pipeline_.robot.period_us;
  now_ = {-1};  // before any clock
  clock_.start(period_ns_, pipeline_.executive);
  commanded_ = 0;
  arming_ = disabling_ = 0;
  telemetry_.cycles = telemetry_.slips = telemetry_.overruns = 0;
  timing_.clear();
  latched_ = Status::kNotStarted;
  seen_ = 0;
  measured_ = {};
  requested_ = DriveRequest::kDisable;
  await_rest(0);
  watch_anew();
  wire_ =
      pipeline_.schedule.count() > 0 ? hal_.connect(pipeline_.robot.mode()) : Status::kMissingKey;
  return wire_ == Status::kOk ? Status::kOk : refuse(wire_);
}

Status Executive::arm() {
  switch (rung()) {
    case Rung::kNominal:
    case Rung::kSkipOptional: return Status::kOk;
    case Rung::kHold: return resume();
    case Rung::kStop: return Status::kNotAtRest;
    case Rung::kArming: return take_over();
    case Rung::kDisabled: break;
  }
  if (disabling_ > 0) return Status::kNotAtRest;
  if (wire_ != Status::kOk) return refuse(wire_);
  await_rest(0);
  for (std::size_t i = 0; i < kDof; ++i)  // a present warning is in the log already
    if (!measured_.drives[i].warns) warned_ &= static_cast<std::uint8_t>(~(1U << i));
  walk(Cause::kArm, Status::kArming);
  return Status::kArming;
}

/// Begins to command the arm once every drive holds its joint and the arm is at rest.
Status Executive::take_over() {
  for (const Drive& drive : measured_.drives)
    if (drive.state != DriveState::kEnabled) return Status::kArming;
  if (!rest_.still()) return Status::kArming;
  const double period_s = pipeline_.robot.period_s();
  Status status = guard_.start(pipeline_.guard, pipeline_.robot.mode(), measured_, period_s, now_);
  if (status != Status::kOk) return refuse(status, tripped());
  status = pipeline_.start(measured_);
  if (status != Status::kOk) return refuse(status);
  watch_anew();
  walk(Cause::kRearm, Status::kOk);
  return Status::kOk;
}

/// Gives the time-out the first joint whose drive is not enabled, or the fastest one. [cyclic]
void Executive::give_up_arming() {
  Finding slow, fastest;
  LoopBound<kDof> joints;
  for (int i = 0; i < kDof; ++i) {
    joints.tick();
    const Drive& drive = measured_.drives[static_cast<std::size_t>(i)];
    if (slow.joint < 0 && drive.state != DriveState::kEnabled) slow = {0.0, i, drive.code};
    if (std::abs(measured_.dq[i]) >= std::abs(fastest.value)) fastest = {measured_.dq[i], i};
  }
  if (slow.joint >= 0)
    walk(Cause::kArmTime, Status::kArmingTime, slow);
  else
    walk(Cause::kArmTime, Status::kNotAtRest, fastest);
}

/// The drives stay enabled, and the sequences of guard and commands continue. A chain that the
/// guard could not follow into the hold starts anew where the last command has brought the arm: its
/// old targets must not move it.
Status Executive::resume() {
  if (!rest_.at_rest() || !rest_.still() || !pipeline_.at_rest()) return Status::kNotAtRest;
  Status status = guard_.check(measured_, now_);
  if (status != Status::kOk) return refuse(status, tripped());
  status =
      guard_.left_behind() ? pipeline_.start(guard_.held(measured_)) : pipeline_.resume(measured_);
  if (status != Status::kOk) return refuse(status);
  watch_anew();
  walk(Cause::kRearm, Status::kOk);
  return Status::kOk;
}

Status Executive::refuse(Status why, const Finding& found) {
  seen_ = 0;
  walk(Cause::kRefused, why, found);
  if (rung() == Rung::kDisabled) latched_ = why;
  return why;
}

void Executive::watch_anew() {
  const ExecutiveSection& settings = pipeline_.executive;
  overruns_.start(settings.max_overruns, settings.overrun_window, settings.clean_cycles);
  clock_.forgive(settings);
  const Guard::Params& guard = pipeline_.guard;
  limiting_.start(guard.limiting_share, static_cast<std::int64_t>(guard.limiting_window * 1e6) /
                                            pipeline_.robot.period_us);
}

Status Executive::stop() {
  if (rung() != Rung::kDisabled) walk(Cause::kOff, Status::kNotStarted);
  disabling_ = 0;
  wire_ = Status::kNotStarted;
  return hal_.disconnect();
}

}  // namespace tactus
