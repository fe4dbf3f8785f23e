#include "hal/serial/cycle_frames.hpp"

#include "kernel/core/loop_bound.hpp"

namespace tactus::serial {
namespace {

template <class Vector>
void put(ByteWriter& to, const Vector& values) {
  LoopBound<8> loop;
  for (int i = 0; i < values.size(); ++i) {
    loop.tick();
    to.f64(values[i]);
  }
}

template <class Vector>
void get(ByteReader& from, Vector& values) {
  LoopBound<8> loop;
  for (int i = 0; i < values.size(); ++i) {
    loop.tick();
    values[i] = from.f64();
  }
}

/// Reads an enumerator, one of those up to `last`; false: it is none of them.
template <class Enum>
bool get(ByteReader& from, Enum& value, Enum last) {
  const std::uint8_t byte = from.u8();
  value = static_cast<Enum>(byte);
  return byte <= static_cast<std::uint8_t>(last);
}

}  // namespace

void write_state(ByteWriter& to, Order order, const RobotState& state) {
  to.u8(static_cast<std::uint8_t>(order));
  to.u64(static_cast<std::uint64_t>(state.stamp_ns));
  put(to, state.q);
  put(to, state.dq);
  put(to, state.tau);
  put(to, state.ft);
  to.f64(state.speed_scaling);
  for (const Drive& drive : state.drives) {
    to.u8(static_cast<std::uint8_t>(drive.state));
    to.u8(static_cast<std::uint8_t>((drive.valid ? 1 : 0) | (drive.warns ? 2 : 0)));
    to.u8(static_cast<std::uint8_t>(drive.reason));
    to.u32(drive.code);
  }
}

bool read_state(ByteReader& from, Order& order, RobotState& state) {
  RobotState read;
  Order wanted;
  bool known = get(from, wanted, Order::kArmed);
  read.stamp_ns = static_cast<std::int64_t>(from.u64());
  get(from, read.q);
  get(from, read.dq);
  get(from, read.tau);
  get(from, read.ft);
  read.speed_scaling = from.f64();
  LoopBound<kDof> loop;
  for (Drive& drive : read.drives) {
    loop.tick();
    known = get(from, drive.state, DriveState::kFault) && known;
    const std::uint8_t flags = from.u8();
    drive.valid = (flags & 1U) != 0;
    drive.warns = (flags & 2U) != 0;
    drive.reason = static_cast<Status>(from.u8());
    drive.code = from.u32();
  }
  if (!known || !from.done()) return false;
  order = wanted;
  state = read;
  return true;
}

void write_result(ByteWriter& to, const CycleResult& result) {
  to.u32(result.cycle);
  to.u64(static_cast<std::uint64_t>(result.stamp_ns));
  to.u8(static_cast<std::uint8_t>(result.command.mode));
  to.u8(static_cast<std::uint8_t>(result.command.request));
  put(to, result.command.value);
  put(to, result.command.dq_ff);
  put(to, result.command.tau_ff);
  to.u8(static_cast<std::uint8_t>(result.status));
  to.u8(result.rung);
  to.u8(result.reports);
  to.u64(result.row);
}

bool read_result(ByteReader& from, CycleResult& result) {
  CycleResult read;
  read.cycle = from.u32();
  read.stamp_ns = static_cast<std::int64_t>(from.u64());
  bool known = get(from, read.command.mode, CommandMode::kEffort);
  known = get(from, read.command.request, DriveRequest::kFollow) && known;
  get(from, read.command.value);
  get(from, read.command.dq_ff);
  get(from, read.command.tau_ff);
  read.status = static_cast<Status>(from.u8());
  read.rung = from.u8();
  read.reports = from.u8();
  read.row = from.u64();
  if (!known || !from.done()) return false;
  result = read;
  return true;
}

}  // namespace tactus::serial
