// The meaning of the codes with which a controller reports a stop, such as "C153A2". Universal
// Robots, service manual and error codes of CB3.
#pragma once

#include <array>
#include <cstdint>

namespace tactus::ur {

struct StopCode {
  std::int32_t code;
  const char* text;
  bool of_joint;  ///< the argument, 0 to 5, is a joint
};

inline constexpr std::array<StopCode, 26> kStopCodes = {
    {{150, "position close to the joint limits", true},
     {151, "tool orientation close to its limit", false},
     {152, "position close to a safety plane", false},
     {153, "position deviates from the path", true},
     {154, "position in a singularity", false},
     {155, "the position cannot be held, check the payload", false},
     {156, "wrong payload on entering freedrive", false},
     {157, "collision", true},
     {158, "collision, while the payload is set to 0 kg", true},
     {159, "position deviates from the path, while the payload is set to 0 kg", true},
     {162, "payload or its centre of mass is probably wrong", false},
     {163, "more than 50 protective stops of a joint within 8 h", true},
     {164, "wrist close to a safety plane", false},
     {171, "a blend of two motions is not possible", false},
     {172, "illegal control mode", false},
     {173, "torque too high", true},
     {174, "change of the torque too high", true},
     {191, "violation of a safety limit", false},
     {192, "fault of the safety system", false},
     {193, "fault of a node", false},
     {204, "the target changes or stops suddenly, or its speed does not match", false},
     {205, "target speed does not match the change of target position", true},
     {206, "target speed does not match the change of target position", true},
     {207, "an input of the fieldbus was disconnected", false},
     {209, "a program asked for a protective stop", false},
     {210, "the port is read-only: the robot is not in remote control", false}}};

/// Returns the row of a code, or null. [any]
constexpr const StopCode* find_stop_code(std::int32_t code) {
  for (const StopCode& row : kStopCodes)
    if (row.code == code) return &row;
  return nullptr;
}

}  // namespace tactus::ur
