// Fuzzes the primary port as the HAL reads it: stops and runtime exceptions in a stream of packets.
#include "hal/ur/robot_port.hpp"
#include "tests/fuzz/ur/wire.hpp"

using namespace tactus;
using namespace tactus::ur;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostInOneCycle = 4096;
  const fuzz::Tape tape(data, size);
  fuzz::wire.play(tape);
  RobotPort port;
  Message why;
  MUST(port.connect("127.0.0.1", 30001, Deadline(100), why) == Status::kOk);
  // A cycle takes bytes, or whole packets out of what it holds.
  for (std::size_t cycles = 0; port.connected(); ++cycles) {
    const std::size_t before = fuzz::wire.at;
    port.receive();
    MUST(fuzz::wire.at - before <= kMostInOneCycle);
    if (fuzz::wire.at == before && tape.hangs) break;
    MUST(cycles <= 2 * size + 16);
  }
  const std::string_view stop(port.stop()), exception(port.exception());
  MUST(stop.empty() || stop[0] == 'C');
  MUST(exception.empty() || exception.substr(0, 5) == "line ");
  return 0;
}
