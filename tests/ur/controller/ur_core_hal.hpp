// The emulated controller as a Hal, without sockets and without a clock. The program that the UR's
// HAL uploads takes its set-points from the registers; a cycle of the kernel is a cycle of the
// controller.
#pragma once

#include "hal/ur/servo_program.hpp"
#include "hal/ur/ur_state.hpp"
#include "kernel/core/hal.hpp"
#include "tests/support/testing.hpp"
#include "tests/ur/controller/ur_bench.hpp"

namespace tactus::ur {

class CoreHal final : public Hal {
 public:
  explicit CoreHal(const Settings& settings) { bench_.start(settings); }

  Capabilities capabilities() const override {
    Capabilities offered;
    offered.position = offered.wrench = true;
    offered.min_period_us = offered.max_period_us = 8000;
    return offered;
  }
  Status connect(CommandMode) override {
    assert_true(bench_.started());
    return Status::kOk;
  }
  Status read(const CycleTime& now, RobotState& state) override {
    const Image& image = bench_.image();
    state.q = image.actual_q;
    state.dq = image.actual_qd;
    state.speed_scaling = time_scaling(image.speed_scaling, image.target_speed_fraction);
    state.stamp_ns = now.stamp_ns;
    state.drives.fill({drive_state(), true});
    return Status::kOk;
  }
  /// Uploads the program once; then it holds the arm where it is, or follows.
  Status write(const RobotCommand& command) override {
    if (command.request == DriveRequest::kDisable) return Status::kOk;
    if (!uploaded_) upload();
    if (!bench_.image().program_running) return Status::kOk;
    if (count_ == 0) held_ = bench_.image().actual_q;
    if (command.request == DriveRequest::kFollow) held_ = command.value;
    Machine& machine = bench_.controller().machine();
    for (int i = 0; i < 6; ++i) machine.io.input.doubles[kServoRegister + i] = held_[i];
    machine.io.input.ints[kServoRegister] = ++count_;
    return Status::kOk;
  }
  Status disconnect() override { return Status::kOk; }

  void tick() { bench_.ticks(1); }
  void set_slider(double fraction) { bench_.controller().machine().io.speed_fraction = fraction; }
  const Image& image() { return bench_.image(); }

 private:
  DriveState drive_state() {
    if (!uploaded_) return DriveState::kDisabled;
    if (bench_.image().program_running) return DriveState::kEnabled;
    return count_ == 0 ? DriveState::kArming : DriveState::kFault;
  }
  void upload() {
    ServoProgram script;
    script.lookahead_s = 0.1;
    script.gain = 300.0;
    const int session = bench_->open(Service::kPrimary);
    bench_.send(session, write_servo_program(script, text_));
    uploaded_ = true;
  }

  Bench bench_;
  ServoProgramText text_;
  std::int32_t count_ = 0;
  bool uploaded_ = false;
  JointVector held_ = JointVector::Zero();  // rad: the last set-point
};

}  // namespace tactus::ur
