// The program that the HAL runs on a UR controller: set-points come through RTDE's input registers
// and go to servoj, one in every cycle.
//
//   input_int_register_24        counts the set-points, from 1 up; negative: end with a stop
//   input_double_register_24-29  the set-point: six joint positions, rad
//   output_int_register_24       echo: the count of the last set-point that was used; kServoEnded
//                                when the program has stopped the arm
//
// What the register holds when the program starts is no set-point. The first one must be where the
// arm is, or the program ends. Where no new one comes in a cycle, the last is carried on with the
// speed between the last two, which fades to nothing within `patience` cycles as 1 - (n / (patience
// + 1))^2; then the arm is stopped and the program ends.
//
// A computer that was away for some cycles goes on where it was, and its next set-point lies behind
// where the arm was led. The difference d fades out over N = kServoBlend cycles by the polynomial
// 3 x^2 - 2 x^3: by no more than 3/2 d / N a cycle, and with no more than 6 d / N^2 a cycle
// squared. With set-points of an even speed d is below n steps after n cycles, and below N / 1.5
// after twelve: the target slows down and never goes back.
//
// Set-points may also come in a lump: one that was due in the next cycle just before this one's
// is read. The target goes on at its speed, and what the lump is ahead by fades out in the same
// way. A robot that stretches time by its slider finds more than one in a cycle as well, but at an
// even pace: a lump is more than 1.75 times as many as there were in each of the last cycles.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "kernel/types.hpp"

namespace tactus::ur {

/// What is written into the text.
struct ServoScript {
  Vector6 tcp = Vector6::Zero();  ///< tip in the flange: m, rotation vector in rad
  double payload_kg = 0.0;
  Vector3 payload_com = Vector3::Zero();  ///< in the flange, m
  bool zero_force = false;                ///< set the measured force to zero at the start
  double period_s = 0.008;                ///< of the controller: 0.008 (CB3) or 0.002
  double lookahead_s = 0.03;              ///< of servoj, 0.03 to 0.2
  double gain = 2000.0;                   ///< of servoj, 100 to 2000
  int patience = 12;                      ///< cycles without a set-point, 1 to 125
  double first_step = 0.05;               ///< sum over the joints, rad
  double deceleration = 4.0;              ///< of the stop, rad/s^2
};

inline constexpr std::string_view kServoProgram = "tactus_servo";
inline constexpr int kServoRegister = 24;  ///< the first of them, in either direction
inline constexpr int kServoEnded = -1;
inline constexpr int kServoBlend = 12;  ///< cycles

inline constexpr std::size_t kServoScriptSize = 4096;
using ServoScriptText = std::array<char, kServoScriptSize>;

/// The text, as it goes to port 30001, 30002 or 30003. Empty: a value is out of its range. [init]
std::string_view write_servo_script(const ServoScript& script, ServoScriptText& text);

}  // namespace tactus::ur
