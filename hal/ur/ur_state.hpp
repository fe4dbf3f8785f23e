// UrState: the state that a controller sends in every cycle, and the recipe that requests it.
#pragma once

#include "hal/ur/protocol.hpp"
#include "kernel/core/load_error.hpp"
#include "kernel/core/types.hpp"

namespace tactus::ur {

struct UrState {
  double timestamp_s = 0.0;             ///< since the controller was started
  Vector6 target_q = Vector6::Zero();   ///< rad
  Vector6 q = Vector6::Zero();          ///< rad
  Vector6 dq = Vector6::Zero();         ///< rad/s
  Vector6 moment = Vector6::Zero();     ///< N m, of the controller's own model
  Vector6 tcp_pose = Vector6::Zero();   ///< base frame: m, rotation vector in rad
  Vector6 tcp_force = Vector6::Zero();  ///< at the tip, in the axes of the base: N, N m
  double speed_scaling = 0.0;           ///< fraction of the slider's speed left by the limiter
  double speed_fraction = 0.0;          ///< fraction set by the slider
  std::int32_t robot_mode = 0, safety_mode = 0, echo = 0;
  std::uint32_t safety_bits = 0, runtime_state = 0;
  // NaN if the controller does not offer it, as old software:
  Vector6 tcp_offset = Vector6::Constant(kRequired);  ///< tip in the flange: m, rotation vector
  double payload_kg = kRequired;
  Vector3 payload_com = Vector3::Constant(kRequired);  ///< in the flange, m

  bool at_rest() const { return dq.cwiseAbs().maxCoeff() < 0.01; }
  bool running() const { return robot_mode == static_cast<int>(RobotMode::kRunning); }
  bool playing() const {
    return runtime_state == static_cast<std::uint32_t>(RuntimeState::kPlaying);
  }
};

/// Returns the fraction of its own speed at which a set-point is executed. The guide calls one
/// field "speed scaling of the trajectory limiter", the other "target speed fraction", and the
/// vendor's drivers multiply them: the limiter's fraction does not include the slider's. If it did,
/// the product would be too slow, but never ahead of the robot. [cyclic]
constexpr double time_scaling(double speed_scaling, double speed_fraction) {
  const double product = speed_scaling * speed_fraction;
  return product > 1.0 ? 1.0 : product > 0.0 ? product : 0.0;
}

struct RecipeField {
  std::string_view name;
  FieldType type;
};

/// Fields in the order of decode_state(). Fields from kStateFields on are left out of the recipe if
/// the controller does not support them.
inline constexpr std::size_t kStateFields = 14;
inline constexpr std::array<RecipeField, kStateFields + 3> kOutputFields = {
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
     {"runtime_state", FieldType::kUint32},
     {"tcp_offset", FieldType::kVector6d},
     {"payload", FieldType::kDouble},
     {"payload_cog", FieldType::kVector3d}}};
/// Which of those the recipe has.
using ToolFields = std::array<bool, kOutputFields.size() - kStateFields>;

/// The registers of a set-point, as in hal/ur/servo_program.hpp, then the digital outputs, which
/// are left out of the recipe where a pipeline does not put them out.
inline constexpr std::size_t kSetPointFields = 7;
inline constexpr std::array<RecipeField, kSetPointFields + 6> kInputFields = {
    {{"input_int_register_24", FieldType::kInt32},
     {"input_double_register_24", FieldType::kDouble},
     {"input_double_register_25", FieldType::kDouble},
     {"input_double_register_26", FieldType::kDouble},
     {"input_double_register_27", FieldType::kDouble},
     {"input_double_register_28", FieldType::kDouble},
     {"input_double_register_29", FieldType::kDouble},
     {"standard_digital_output_mask", FieldType::kUint8},
     {"standard_digital_output", FieldType::kUint8},
     {"configurable_digital_output_mask", FieldType::kUint8},
     {"configurable_digital_output", FieldType::kUint8},
     {"tool_digital_output_mask", FieldType::kUint8},
     {"tool_digital_output", FieldType::kUint8}}};

/// Names of the digital outputs, in the order of actual_digital_output_bits.
inline constexpr std::array<const char*, 18> kDigitalOutputNames = {
    "standard_out[0]",     "standard_out[1]",     "standard_out[2]",     "standard_out[3]",
    "standard_out[4]",     "standard_out[5]",     "standard_out[6]",     "standard_out[7]",
    "configurable_out[0]", "configurable_out[1]", "configurable_out[2]", "configurable_out[3]",
    "configurable_out[4]", "configurable_out[5]", "configurable_out[6]", "configurable_out[7]",
    "tool_out[0]",         "tool_out[1]"};

/// Decodes the fields of a data package. kWireFormat: its size is wrong, or a field is not finite;
/// `why` names the size or the first such field. [cyclic]
Status decode_state(ByteReader& data, const ToolFields& offered, UrState& state, Message& why);

/// Compares the types of a reply with those of the recipe. kRegistersInUse, kWireFormat: `why`
/// names the first field that differs, its type and the expected type. [init]
Status check_types(std::string_view types, const RecipeField* fields, std::size_t count,
                   Message& why);

/// Returns kOk if the robot may move; otherwise the reason, and `why` has the robot's name for it.
/// [cyclic]
Status judge_modes(const UrState& state, Message& why);

/// Returns kOk if the program on the robot runs and uses set-points; otherwise kProgramStopped, and
/// `why` has what became of it. [cyclic]
Status judge_program(const UrState& state, Message& why);

}  // namespace tactus::ur
