#include "hal/ethercat/process_data.hpp"

#include "hal/ethercat/protocol_frame.hpp"

namespace tactus::ethercat {
namespace {

using cia402::Object;

/// All that a drive may be commanded with.
constexpr Object kOutputObjects[] = {cia402::kControlword,    cia402::kTargetTorque,
                                     cia402::kTorqueOffset,   cia402::kTargetPosition,
                                     cia402::kTargetVelocity, cia402::kVelocityOffset,
                                     cia402::kModeOfOperation};

}  // namespace

MappedObjects objects_of_outputs(CommandMode mode) {
  MappedObjects objects;
  objects.add(cia402::kControlword);
  switch (mode) {
    case CommandMode::kEffort: objects.add(cia402::kTargetTorque); break;
    case CommandMode::kVelocity:
      objects.add(cia402::kTorqueOffset);
      objects.add(cia402::kTargetVelocity);
      break;
    case CommandMode::kPosition:
      objects.add(cia402::kTorqueOffset);
      objects.add(cia402::kTargetPosition);
      objects.add(cia402::kVelocityOffset);
      break;
  }
  return objects;
}

MappedObjects objects_of_inputs() {
  MappedObjects objects;
  objects.add(cia402::kStatusword);
  objects.add(cia402::kTorqueActual);
  objects.add(cia402::kPositionActual);
  objects.add(cia402::kVelocityActual);
  objects.add(cia402::kErrorCode);
  return objects;
}

const char* ProcessData::resolve(CommandMode mode) {
  mode_ = static_cast<std::uint8_t>(cia402::mode_of(mode));
  for (std::size_t i = 0; i < kOutputs; ++i) out_[i] = outputs.find(kOutputObjects[i]);
  status_ = inputs.find(cia402::kStatusword);
  position_ = inputs.find(cia402::kPositionActual);
  velocity_ = inputs.find(cia402::kVelocityActual);
  torque_ = inputs.find(cia402::kTorqueActual);
  error_ = inputs.find(cia402::kErrorCode);
  if (out_[0] < 0) return "the controlword (6040h)";
  if (status_ < 0) return "the statusword (6041h)";
  if (position_ < 0) return "the position (6064h)";
  if (torque_ < 0) return "the torque (6077h)";
  switch (mode) {
    case CommandMode::kEffort: return out_[1] < 0 ? "the target torque (6071h)" : nullptr;
    case CommandMode::kPosition: return out_[3] < 0 ? "the target position (607Ah)" : nullptr;
    case CommandMode::kVelocity: return out_[4] < 0 ? "the target velocity (60FFh)" : nullptr;
  }
  return nullptr;
}

void ProcessData::decode(const std::uint8_t* image, cia402::DriveFeedback& feedback) const {
  const std::uint8_t* const at = image + in_at;
  feedback.show(get<std::uint16_t>(at + status_));
  feedback.position = get<std::int32_t>(at + position_);
  feedback.torque = get<std::int16_t>(at + torque_);
  feedback.has_velocity = velocity_ >= 0;
  if (velocity_ >= 0) feedback.velocity = get<std::int32_t>(at + velocity_);
  if (error_ >= 0) feedback.error_code = get<std::uint16_t>(at + error_);
}

void ProcessData::encode(const cia402::DriveCommand& command, std::uint8_t* image) const {
  std::uint8_t* const at = image + out_at;
  const std::uint32_t values[kOutputs] = {
      command.controlword,
      static_cast<std::uint32_t>(command.target_torque),
      static_cast<std::uint32_t>(command.torque_offset),
      static_cast<std::uint32_t>(command.target_position),
      static_cast<std::uint32_t>(command.target_velocity),
      static_cast<std::uint32_t>(command.velocity_offset),
      command.homes ? static_cast<std::uint8_t>(cia402::Mode::kHoming) : mode_,
  };
  for (int i = 0; i < kOutputs; ++i) {
    const auto n = static_cast<std::size_t>(i);
    if (out_[n] < 0) continue;
    std::uint8_t bytes[4];
    put(bytes, values[n]);
    std::memcpy(at + out_[n], bytes, kOutputObjects[n].bytes);
  }
}

}  // namespace tactus::ethercat
