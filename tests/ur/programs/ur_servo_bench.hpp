// The program that the HAL uploads, interpreted by the controller, and the control computer that
// writes its registers.
#pragma once

#include "hal/ur/servo_program.hpp"
#include "tests/ur/programs/ur_program_bench.hpp"

namespace tactus::ur {

inline constexpr std::size_t kFirst = kServoRegister;

/// A control computer that moves joint 1 along a sine and counts its set-points.
struct ServoBench : ProgramBench {
  ServoProgramText text;
  std::int32_t count = 5;
  double time_s = 0.0;

  void start(const ServoProgram& script = {}) {
    machine().io.input.ints[kFirst] = count;
    const std::string_view program = write_servo_program(script, text);
    assert_true(program.size() > 0);
    upload(program);
    run(5);
    assert_true(running());
    assert_int_equal(echo(), count);
  }
  static Joints path(double time_s) {
    Joints q = settings().initial_q;
    q[0] += 0.3 * (1.0 - std::cos(2.0 * time_s));
    return q;
  }
  void set(const Joints& q) {
    for (std::size_t i = 0; i < 6; ++i)
      machine().io.input.doubles[kFirst + i] = q[static_cast<int>(i)];
    machine().io.input.ints[kFirst] = ++count;
  }
  void set_next() {
    time_s += kCycle_s;
    set(path(time_s));
  }
  std::int32_t echo() { return machine().io.output.ints[kFirst]; }
  bool stopped_safely() { return image().safety_mode == 1 && !running(); }
};

}  // namespace tactus::ur
