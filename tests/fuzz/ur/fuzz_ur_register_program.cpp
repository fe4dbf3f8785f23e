// Fuzzes the commands in RTDE's registers, as a client's data packages carry them. A record is one
// byte, which gives the number of cycles after it and of numbers in it, and a package: command,
// asynchronous, numbers.
#include "tests/fuzz/ur/ur_controller.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr std::string_view kText =
    "def registers():\n"
    "  global reg_offset_float = 0\n"
    "  global reg_offset_int = 0\n"
    "  def signal_ready():\n  end\n"
    "  def rtde_cmd():\n  end\n"
    "  thread move_thread():\n  end\n"
    "  def process_cmd(cmd):\n"
    "    rtde_set_watchdog(\"input_int_register_0\", 10, \"STOP\")\n"
    "  end\n"
    "end\n";

/// The next package, and the cycle in which it arrived.
void take(ByteReader& reader, int numbers, Machine& machine) {
  InputPackage package;
  for (std::uint8_t i = 0; i < 2; ++i)
    MUST(package.read({FieldType::kInt32, Input::kInts, i}, reader));
  for (std::uint8_t i = 0; i < numbers; ++i)
    MUST(package.read({FieldType::kDouble, Input::kDoubles, i}, reader));
  if (reader.ok()) package.apply(machine.io, machine.cycle);
}

/// The register program answers ready or done with finite numbers, whatever the command.
void check_answers(const Registers& output) {
  MUST(output.ints[0] == kReady || output.ints[0] == kDone);
  for (const double value : output.doubles) MUST(std::isfinite(value));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::RunningController controller;
  controller->runner().upload(kText, controller.machine());
  controller.ticks(2);
  ByteReader reader(data, size);
  int left = 100;  // cycles
  while (reader.left() > 0 && left > 0) {
    const int head = reader.u8(), cycles = head & 0x7;
    take(reader, std::min(head >> 3, static_cast<int>(kRegisters)), controller.machine());
    controller.ticks(cycles);
    left -= cycles + 1;
    check_answers(controller.machine().io.output);
  }
  controller->runner().stop(controller.machine());
  controller.comes_to_rest();
  return 0;
}
