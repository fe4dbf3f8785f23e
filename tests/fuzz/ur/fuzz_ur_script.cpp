// Fuzzes scripts as a state port takes them, run for some cycles: recognisers, interpreter,
// sockets.
#include "sim_plant/ur/programs/runner.hpp"
#include "tests/fuzz/ur/ur_controller.hpp"

using namespace tactus;
using namespace tactus::ur;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static ScriptIntake intake;
  intake.clear();
  fuzz::RunningController controller;
  intake.take(data, size, [&](std::string_view piece) {
    if (!run_direct_command(piece, controller->runner(), controller.machine()))
      controller->runner().upload(piece, controller.machine());
    controller.tick();
  });
  controller.ticks(12);
  MUST(controller->runner().name().size() <= 31);
  return 0;
}
