#include "hal/can/pdo_layout.hpp"

#include "kernel/core/loop_bound.hpp"

namespace tactus::can {
namespace {

using cia402::DriveCommand;
using cia402::DriveFeedback;
using cia402::Object;

/// Returns an object's value as the bits that travel.
std::uint32_t value_of(const Object& object, const DriveCommand& command) {
  switch (object.index) {
    case cia402::kControlword.index: return command.controlword;
    case cia402::kTargetTorque.index: return static_cast<std::uint32_t>(command.target_torque);
    case cia402::kTorqueOffset.index: return static_cast<std::uint32_t>(command.torque_offset);
    case cia402::kTargetPosition.index: return static_cast<std::uint32_t>(command.target_position);
    case cia402::kTargetVelocity.index: return static_cast<std::uint32_t>(command.target_velocity);
    case cia402::kVelocityOffset.index: return static_cast<std::uint32_t>(command.velocity_offset);
    default: return 0;
  }
}

}  // namespace

PdoLayout::PdoLayout(CommandMode mode, Frames frames, Commands commands)
    : frames_(frames), commands_(commands) {
  feedback_.add(cia402::kStatusword);
  feedback_.add(cia402::kPositionActual);
  if (fd()) feedback_.add(cia402::kVelocityActual);
  feedback_.add(cia402::kTorqueActual);

  Objects& first = command_[0];
  first.add(cia402::kControlword);
  Objects& targets = packed() && !fd() ? command_[1] : first;
  switch (mode) {
    case CommandMode::kEffort: targets.add(cia402::kTargetTorque); break;
    case CommandMode::kVelocity:
      targets.add(cia402::kTargetVelocity);
      targets.add(cia402::kTorqueOffset);
      break;
    case CommandMode::kPosition:
      targets.add(cia402::kTargetPosition);
      if (fd()) targets.add(cia402::kVelocityOffset);
      targets.add(cia402::kTorqueOffset);
      break;
  }
}

int PdoLayout::capacity() const {
  if (!packed()) return kDof;
  return static_cast<int>(fd() ? kMaxData / own(1).size : kClassicData / own(2).size);
}

Pdo PdoLayout::feedback(const Slot& slot) const {
  Pdo pdo;
  pdo.number = 1;
  pdo.id = static_cast<std::uint16_t>(kTpdoBase[0] + slot.node);
  for (int i = 0; i < feedback_.count; ++i) pdo.add(feedback_.list[static_cast<std::size_t>(i)]);
  return pdo;
}

int PdoLayout::commands(const Slot& slot, std::array<Pdo, kMaxCommands>& pdos) const {
  int count = 0;
  for (int number = 1; number <= command_frames(); ++number) {
    Pdo& pdo = pdos[static_cast<std::size_t>(count++)];
    pdo = {};
    pdo.number = number;
    pdo.id = frame_id(number, slot);
    const Objects& objects = own(number);
    const std::uint32_t skip = objects.size == 4 ? kSkip32 : kSkip16;
    for (int k = 0; packed() && k < slot.index; ++k) pdo.add(skip);
    for (int i = 0; i < objects.count; ++i) pdo.add(objects.list[static_cast<std::size_t>(i)]);
    for (int k = slot.index + 1; packed() && k < slot.count; ++k) pdo.add(skip);
    while (fd() && pdo.size < frame_size(number, slot)) pdo.add(skip);
  }
  return count;
}

std::size_t PdoLayout::frame_size(int number, const Slot& slot) const {
  const std::size_t size = own(number).size * (packed() ? static_cast<std::size_t>(slot.count) : 1);
  return fd() ? fd_size(size) : size;
}

std::uint16_t PdoLayout::frame_id(int number, const Slot& slot) const {
  const std::uint8_t node = packed() ? slot.first_node : slot.node;
  return static_cast<std::uint16_t>(kRpdoBase[number - 1] + node);
}

void PdoLayout::decode(const CanFrame& frame, DriveFeedback& feedback) const {
  feedback.show(load<std::uint16_t>(frame.data, 0));
  feedback.position = load<std::int32_t>(frame.data, 2);
  feedback.has_velocity = fd();
  if (fd()) feedback.velocity = load<std::int32_t>(frame.data, 6);
  feedback.torque = load<std::int16_t>(frame.data, fd() ? 10 : 6);
}

void PdoLayout::encode(int number, const Slot& slot, const DriveCommand& command,
                       CanFrame& frame) const {
  const Objects& objects = own(number);
  std::size_t at = packed() ? objects.size * static_cast<std::size_t>(slot.index) : 0;
  LoopBound<4> each;
  for (int i = 0; i < objects.count; ++i) {
    each.tick();
    const Object& object = objects.list[static_cast<std::size_t>(i)];
    const std::uint32_t value = value_of(object, command);
    if (object.bytes == 2)
      store(frame.data, at, static_cast<std::uint16_t>(value));
    else
      store(frame.data, at, value);
    at += object.bytes;
  }
}

}  // namespace tactus::can
