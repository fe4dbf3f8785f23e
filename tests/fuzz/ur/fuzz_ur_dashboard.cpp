// Fuzzes the emulated dashboard: every line must get one reply of one line.
#include "sim_plant/ur/controller/dashboard.hpp"
#include "tests/fuzz/fuzzing.hpp"

#include <new>

using namespace tactus;
using namespace tactus::ur;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alignas(Machine) static unsigned char machine_bytes[sizeof(Machine)];
  alignas(Runner) static unsigned char runner_bytes[sizeof(Runner)];
  Settings settings;
  settings.external_control_host = "10.0.0.7";
  Machine& machine = *new (machine_bytes) Machine(settings);
  Runner& runner = *new (runner_bytes) Runner;
  Dashboard dashboard(runner, machine);
  std::string_view text(reinterpret_cast<const char*>(data), size), line;
  bool quits = false;
  while (!quits && next_line(text, line)) {
    Reply reply;
    quits = dashboard.run(line, reply);
    const std::string_view said = reply;
    MUST(said.size() >= 2 && said.find('\n') == said.size() - 1);
    for (int i = 0; i < 100; ++i) {
      machine.power.tick(kCycle_s);
      machine.safety.tick(kCycle_s);
    }
    machine.messages.clear();
  }
  runner.~Runner();
  machine.~Machine();
  return 0;
}
