#include "tests/wcet/can/can_cycle.hpp"

#include "kernel/core/loop_bound.hpp"

namespace tactus::can {

Status can_cycle(CanMaster& master, const Arrived& arrived, const CycleTime& now,
                 const RobotCommand& command, RobotState& state) {
  LoopBound<4> buses;
  for (int bus = 0; bus < master.buses(); ++bus) {
    buses.tick();
    const auto at = static_cast<std::size_t>(bus);
    LoopBound<64> frames;
    for (int i = 0; i < arrived.count[at]; ++i) {
      frames.tick();
      master.receive(bus, arrived.frames[at][static_cast<std::size_t>(i)], now.stamp_ns);
    }
  }
  const Status status = master.read(now, state);
  master.write(command);
  return status;
}

}  // namespace tactus::can
