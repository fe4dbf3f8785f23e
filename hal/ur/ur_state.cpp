#include "hal/ur/ur_state.hpp"

#include "hal/ur/refuse.hpp"
#include "hal/ur/servo_program.hpp"

namespace tactus::ur {
namespace {

/// Reads field by field and remembers the first one that is not finite.
class FieldReader {
 public:
  explicit FieldReader(ByteReader& data) : data_(data) {}

  void operator()(double& value) {
    value = data_.f64();
    end_field(value - value == 0.0);
  }
  template <int N>
  void operator()(Eigen::Matrix<double, N, 1>& value) {
    for (double& element : value) element = data_.f64();
    end_field(value.allFinite());
  }
  void operator()(std::int32_t& value) {
    value = data_.i32();
    end_field(true);
  }
  void operator()(std::uint32_t& value) {
    value = data_.u32();
    end_field(true);
  }
  /// Reads a field that the recipe may not have.
  template <class Value>
  void optional(bool offered, Value& value) {
    if (offered)
      (*this)(value);
    else
      ++field_;
  }
  int not_finite() const { return not_finite_; }

 private:
  void end_field(bool finite) {
    if (!finite && not_finite_ < 0) not_finite_ = field_;
    ++field_;
  }

  ByteReader& data_;
  int field_ = 0, not_finite_ = -1;
};

struct SafetyRow {
  std::uint32_t bits;
  SafetyMode mode;
  Status status;
};

/// Rows from worst to least. The bits show a cause earlier than the reported mode.
constexpr std::array<SafetyRow, 7> kSafety = {
    {{kFaultBit, SafetyMode::kFault, Status::kDriveFault},
     {kViolationBit, SafetyMode::kViolation, Status::kDriveFault},
     {kRobotEmergencyStopBit, SafetyMode::kRobotEmergencyStop, Status::kEmergencyStop},
     {kSystemEmergencyStopBit | kEmergencyStoppedBit, SafetyMode::kSystemEmergencyStop,
      Status::kEmergencyStop},
     {kSafeguardStopBit, SafetyMode::kSafeguardStop, Status::kSafeguardStop},
     {kProtectiveStopBit, SafetyMode::kProtectiveStop, Status::kProtectiveStop},
     {kRecoveryBit, SafetyMode::kRecovery, Status::kRobotMode}}};

}  // namespace

Status decode_state(ByteReader& data, const ToolFields& offered, UrState& state, Message& why) {
  const std::size_t size = data.left();
  UrState found;
  FieldReader read(data);
  read(found.timestamp_s);
  read(found.target_q);
  read(found.q);
  read(found.dq);
  read(found.moment);
  read(found.tcp_pose);
  read(found.tcp_force);
  read(found.speed_scaling);
  read(found.speed_fraction);
  read(found.robot_mode);
  read(found.safety_mode);
  read(found.echo);
  read(found.safety_bits);
  read(found.runtime_state);
  read.optional(offered[0], found.tcp_offset);
  read.optional(offered[1], found.payload_kg);
  read.optional(offered[2], found.payload_com);
  if (!data.done()) {
    why = Message("RTDE: a data package with ");
    why << size << " bytes of fields does not match the recipe";
    return Status::kWireFormat;
  }
  if (read.not_finite() >= 0) {
    why = Message("RTDE: ");
    why << kOutputFields[static_cast<std::size_t>(read.not_finite())].name << " is not finite";
    return Status::kWireFormat;
  }
  state = found;
  return Status::kOk;
}

Status check_types(std::string_view types, const RecipeField* fields, std::size_t count,
                   Message& why) {
  for (std::size_t i = 0; i < count; ++i) {
    std::string_view type;
    const bool any = next_name(types, type);
    const std::string_view expected = name(fields[i].type);
    if (any && type == expected) continue;
    const bool in_use = type == name(FieldType::kInUse);
    why = Message(fields[i].name);
    why << " is " << (any ? type.substr(0, 32) : "missing") << ", not " << expected
        << (in_use ? "; end the client or fieldbus that claims it" : "");
    if (i >= kSetPointFields && fields == kInputFields.data())
      why << ", or remove outputs from [robot]";
    return in_use ? Status::kRegistersInUse : Status::kWireFormat;
  }
  return types.empty() ? Status::kOk
                       : refuse(why, Status::kWireFormat, "the reply has more types than fields");
}

Status judge_modes(const UrState& state, Message& why) {
  for (const SafetyRow& row : kSafety) {
    const bool meant = state.safety_mode == static_cast<int>(row.mode);
    if (!meant && (state.safety_bits & row.bits) == 0) continue;
    why = Message("safety mode ");
    why << name(row.mode);
    return row.status;
  }
  if (state.safety_mode != static_cast<int>(SafetyMode::kNormal) &&
      state.safety_mode != static_cast<int>(SafetyMode::kReduced)) {
    why = Message("safety mode ");
    why << state.safety_mode << ", neither NORMAL nor REDUCED";
    return Status::kSafeguardStop;
  }
  if (state.running()) return Status::kOk;
  const bool known = state.robot_mode >= -1 && state.robot_mode <= 8;
  why = Message("robot mode ");
  if (known) why << name(static_cast<RobotMode>(state.robot_mode)) << " (";
  why << state.robot_mode << (known ? ")" : "") << ", not RUNNING";
  return Status::kRobotMode;
}

Status judge_program(const UrState& state, Message& why) {
  const bool ended = state.echo == kServoEnded;
  if (state.playing() && !ended) return Status::kOk;
  why = Message("the program on the robot ");
  if (ended)
    why << "has ended: set-points stopped, or the first one was not at the arm's position";
  else if (const char* runtime = name(static_cast<RuntimeState>(state.runtime_state)))
    why << "is " << runtime;
  else
    why << "is in state " << static_cast<std::size_t>(state.runtime_state);
  return Status::kProgramStopped;
}

}  // namespace tactus::ur
