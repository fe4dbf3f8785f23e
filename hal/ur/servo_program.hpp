// The program that the HAL runs on a UR controller. It passes set-points from RTDE's input
// registers to servoj, one in every cycle.
//
//   input_int_register_24        counts the set-points, from 1 up; negative: end with a stop
//   input_double_register_24-29  the set-point: six joint positions, rad
//   output_int_register_24       echo: the count of the last set-point that was used; kServoEnded
//                                when the program has stopped the arm
//
// The content of the registers when the program starts is not a set-point. The first set-point must
// be the arm's position, or the program ends. If no new one arrives in a cycle, the target
// continues with the speed between the last two, which fades out within `patience` cycles as
// 1 - (n / (patience + 1))^2; then the program stops the arm and ends.
//
// A computer that was away for some cycles continues its own motion, so its next set-point is
// earlier on the path than the target. The difference d fades out over N = kServoBlend cycles by
// the polynomial 3 x^2 - 2 x^3: by at most 3/2 d / N per cycle, with at most 6 d / N^2 per cycle
// squared. If the speed of the set-points is constant, d is below n steps after n cycles, and below
// N / 1.5 after twelve: the target slows down and never goes back.
//
// Set-points may also bunch up: one that is due in the next cycle arrives before that of this cycle
// is read. The target continues at its speed, and the lead of the bunch fades out in the same way.
// A robot whose slider stretches time also finds more than one set-point in a cycle, but at an even
// pace: a bunch has more than 1.75 times as many as each of the last cycles.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "kernel/core/types.hpp"

namespace tactus::ur {

/// The values that are written into the text.
struct ServoProgram {
  bool sets_tcp = true, sets_payload = true;  ///< false: the controller keeps its own
  Vector6 tcp = Vector6::Zero();              ///< tip in the flange: m, rotation vector in rad
  double payload_kg = 0.0;
  Vector3 payload_com = Vector3::Zero();  ///< in the flange, m
  bool zero_force = false;                ///< set the measured force to zero at the start
  double period_s = 0.008;                ///< of the controller: 0.008 (CB3) or 0.002 (e-Series)
  double lookahead_s = 0.03;              ///< of servoj, 0.03 to 0.2
  double gain = 2000.0;                   ///< of servoj, 100 to 2000
  int patience = 12;                      ///< cycles without a set-point, 1 to 125
  double first_step = 0.05;               ///< sum over the joints, rad
  double deceleration = 4.0;              ///< of the stop, rad/s^2
};

inline constexpr std::string_view kServoProgramName = "tactus_servo";
inline constexpr int kServoRegister = 24;  ///< the first register, in either direction
inline constexpr int kServoEnded = -1;
inline constexpr int kServoBlend = 12;  ///< cycles
/// Time after which the program ends if no set-point arrives at all, s: the program that uploaded
/// it may be gone.
inline constexpr double kFirstSetPoint_s = 1.0;

inline constexpr std::size_t kServoProgramSize = 4096;
using ServoProgramText = std::array<char, kServoProgramSize>;

/// Returns the text for port 30001, 30002 or 30003; empty if a value is out of its range. [init]
std::string_view write_servo_program(const ServoProgram& script, ServoProgramText& text);

}  // namespace tactus::ur
