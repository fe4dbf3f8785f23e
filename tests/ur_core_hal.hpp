// The emulated controller as a Hal, without sockets and without a clock: the program that the HAL
// of a UR uploads takes its set-points from the registers, and a cycle of the kernel is one of the
// controller.
#pragma once

#include "hal/ur/servo_script.hpp"
#include "hal/ur/ur_state.hpp"
#include "kernel/hal.hpp"
#include "tests/testing.hpp"
#include "tests/ur_bench.hpp"

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
  Status start(CommandMode, RobotState& state) override {
    assert_true(bench_.started());
    ServoScript script;
    script.lookahead_s = 0.1;
    script.gain = 300.0;
    const int session = bench_->open(Service::kPrimary);
    bench_.send(session, write_servo_script(script, text_));
    bench_.ticks(5);
    return read(state);
  }
  Status read(RobotState& state) override {
    const Image& image = bench_.image();
    state.q = image.actual_q;
    state.dq = image.actual_qd;
    state.speed_scaling = time_scaling(image.speed_scaling, image.target_speed_fraction);
    return image.program_running ? Status::kOk : Status::kProgramStopped;
  }
  Status write(const RobotCommand& command) override {
    Machine& machine = bench_.controller().machine();
    for (int i = 0; i < 6; ++i) machine.io.input.doubles[kServoRegister + i] = command.value[i];
    machine.io.input.ints[kServoRegister] = ++count_;
    return Status::kOk;
  }
  void stop() override {}

  void tick() { bench_.ticks(1); }
  void set_slider(double fraction) { bench_.controller().machine().io.speed_fraction = fraction; }
  const Image& image() { return bench_.image(); }

 private:
  Bench bench_;
  ServoScriptText text_;
  std::int32_t count_ = 0;
};

}  // namespace tactus::ur
