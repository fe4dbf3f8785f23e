// UrState: what a controller says of itself in every cycle, and the recipe that asks for it.
#pragma once

#include "hal/ur/protocol.hpp"
#include "kernel/load_error.hpp"
#include "kernel/types.hpp"

namespace tactus::ur {

struct UrState {
  double timestamp_s = 0.0;             ///< since the controller was started
  Vector6 target_q = Vector6::Zero();   ///< rad
  Vector6 q = Vector6::Zero();          ///< rad
  Vector6 dq = Vector6::Zero();         ///< rad/s
  Vector6 moment = Vector6::Zero();     ///< N m, of the controller's own model
  Vector6 tcp_pose = Vector6::Zero();   ///< base frame: m, rotation vector in rad
  Vector6 tcp_force = Vector6::Zero();  ///< at the tip, in the axes of the base: N, N m
  double speed_scaling = 0.0;           ///< what the trajectory limiter lets pass of the slider's
  double speed_fraction = 0.0;          ///< of the slider
  std::int32_t robot_mode = 0, safety_mode = 0, echo = 0;
  std::uint32_t safety_bits = 0, runtime_state = 0;

  bool running() const { return robot_mode == static_cast<int>(RobotMode::kRunning); }
  bool playing() const {
    return runtime_state == static_cast<std::uint32_t>(RuntimeState::kPlaying);
  }
};

/// By how much slower than in its own time a set-point is executed. The guide calls the one field
/// "speed scaling of the trajectory limiter", the other "target speed fraction", and the vendor's
/// drivers multiply them: the limiter's does not contain the slider's. Were it in both, this would
/// be too slow, and never ahead of the robot. [cyclic]
constexpr double time_scaling(double speed_scaling, double speed_fraction) {
  const double product = speed_scaling * speed_fraction;
  return product > 1.0 ? 1.0 : product > 0.0 ? product : 0.0;
}

struct RecipeField {
  std::string_view name;
  FieldType type;
};

/// In the order of decode_state().
inline constexpr std::array<RecipeField, 14> kOutputFields = {
    {{"timestamp", FieldType::kDouble},
     {"target_q", FieldType::kVector6d},
     {"actual_q", FieldType::kVector6d},
     {"actual_qd", FieldType::kVector6d},
     {"target_moment", FieldType::kVector6d},
     {"actual_TCP_pose", FieldType::kVector6d},
     {"actual_TCP_force", FieldType::kVector6d},
     {"speed_scaling", FieldType::kDouble},
     {"target_speed_fraction", FieldType::kDouble},
     {"robot_mode", FieldType::kInt32},
     {"safety_mode", FieldType::kInt32},
     {"output_int_register_24", FieldType::kInt32},
     {"safety_status_bits", FieldType::kUint32},
     {"runtime_state", FieldType::kUint32}}};

/// The set-point's registers, as hal/ur/servo_script.hpp has them.
inline constexpr std::array<RecipeField, 7> kInputFields = {
    {{"input_int_register_24", FieldType::kInt32},
     {"input_double_register_24", FieldType::kDouble},
     {"input_double_register_25", FieldType::kDouble},
     {"input_double_register_26", FieldType::kDouble},
     {"input_double_register_27", FieldType::kDouble},
     {"input_double_register_28", FieldType::kDouble},
     {"input_double_register_29", FieldType::kDouble}}};

/// The fields of a data package. kWireFormat, and `why` says so, if its size is another, or the
/// first field that is not finite. [cyclic]
Status decode_state(ByteReader& data, UrState& state, Message& why);

/// Compares the types of a reply with those of the recipe. kRegistersInUse or kWireFormat, and
/// `why` names the first field that differs, what it is and what it should be. [init]
Status check_types(std::string_view types, const RecipeField* fields, std::size_t count,
                   Message& why);

/// kOk if the robot is as it must be for motions; the Status otherwise, and `why` has the robot's
/// word for it. [cyclic]
Status judge_modes(const UrState& state, Message& why);

}  // namespace tactus::ur
