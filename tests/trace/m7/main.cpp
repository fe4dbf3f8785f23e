// Plays a job on a bare core. The job's path is the emulator's last argument. Job and
// waypoints are in TAPES of the linker script.
#include "tests/trace/traced_player.hpp"
#include "tests/wcet/m7/console.hpp"

namespace {

using namespace tactus;

constexpr std::size_t kJobBytes = std::size_t{10} << 20;
[[gnu::section(".tapes,\"aw\",%nobits@")]] std::uint8_t job_bytes[kJobBytes];
using Stored = Waypoint<JointSpace>;
[[gnu::section(".tapes,\"aw\",%nobits@")]] alignas(
    Stored) unsigned char store[kLongestTape * sizeof(Stored)];

}  // namespace

extern "C" int measure() {
  static char line[512];
  const char* const path = semihosting::last_argument(line, sizeof line);
  const Bytes job(job_bytes, semihosting::read_file(path, job_bytes, sizeof job_bytes));
  if (job.empty()) {
    semihosting::print("no job\n");
    return 1;
  }
  return play_job(job, reinterpret_cast<Stored*>(store),
                  [](const char* text) { semihosting::print(text); });
}
