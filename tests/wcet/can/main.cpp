// Runs cycles of the CAN part on a bare Cortex-M7, for the emulator to count: seven emulated drives
// that stand, and buses that bring what they can, up to full batches of hostile frames. The last
// argument is the configuration: "fd" (packed, one bus) or "classic" (plain, three buses).
#include <new>

#include "tests/wcet/can/can_bench.hpp"
#include "tests/wcet/m7/console.hpp"

namespace {

using namespace tactus;
using namespace tactus::can;

constexpr int kScenes = 12, kArmingCycles = 600, kHostileCycles = 60;

struct Random {
  std::uint32_t state;

  /// 0 to `end` - 1.
  std::uint32_t below(std::uint32_t end) {
    state = state * 1664525U + 1013904223U;
    return (state >> 8) % end;
  }
};

struct HostileBench : CanBench {
  /// Fills the batches with frames of identifiers that the master listens to; `whole`: with the
  /// sizes of real ones.
  void flood(Random& random, bool whole) {
    std::array<CanFilter, CanMaster::kMaxFilters> filters;
    for (int bus = 0; bus < master.buses(); ++bus) {
      const auto count = static_cast<std::uint32_t>(master.filters(bus, filters));
      CanFrame frame;
      do {
        frame.id = filters[random.below(count)].id;
        frame.fd = can.frames == Frames::kFd && frame.id >> 7 == 3;
        frame.size = static_cast<std::uint8_t>(frame.id >> 7 == 14 ? 1 : frame.fd ? 12 : 8);
        if (!whole && random.below(4) == 0) frame.size = static_cast<std::uint8_t>(random.below(9));
        for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random.below(256));
        if (frame.id >> 7 == 14) frame.data[0] = random.below(16) != 0 ? 5 : 0;
      } while (arrived.add(static_cast<std::size_t>(bus), frame));
    }
  }
  void hostile_cycle(Random& random, bool whole) {
    constexpr DriveRequest kRequests[] = {DriveRequest::kFollow, DriveRequest::kFollow,
                                          DriveRequest::kArm, DriveRequest::kDisable};
    command.request = kRequests[random.below(4)];
    for (int j = 0; j < kDof; ++j) command.value[j] = random.below(200) * 0.1 - 10.0;
    if (random.below(20) == 0) command.value[6] = -command.value[6] / 0.0;
    drives.exchange(master, now_ns);
    collect();
    flood(random, whole);
    cycle();
  }
};

alignas(HostileBench) unsigned char bench_bytes[sizeof(HostileBench)];

/// Arms, follows, and then takes what a hostile bus brings. Returns the cycles; 0: not connected.
std::uint32_t play(std::uint32_t scene, bool fd) {
  HostileBench& bench = *new (bench_bytes) HostileBench;
  if (!bench.load(fd) || !bench.connect()) return 0;
  Random random{scene * 7919U + 1U};
  // Scene 0 is the quiet one; half of the others begin somewhere while the drives are armed.
  const int quiet = scene % 2 == 0 ? kArmingCycles : static_cast<int>(random.below(kArmingCycles));
  for (int i = 0; i < quiet; ++i) bench.quiet_cycle(DriveRequest::kArm);
  if (scene == 0) {
    if (bench.master.phase() != cia402::ArmingPhase::kArmed) return 0;
    for (int i = 0; i < kArmingCycles; ++i) bench.quiet_cycle(DriveRequest::kFollow);
  }
  for (int i = 0; i < kHostileCycles && scene > 0; ++i) bench.hostile_cycle(random, scene % 3 == 0);
  return bench.cycles;
}

}  // namespace

extern "C" int measure() {
  static char line[512];
  const char* const configuration = semihosting::last_argument(line, sizeof line);
  for (std::uint32_t scene = 0; scene < kScenes; ++scene) {
    const std::uint32_t cycles = play(scene, configuration[0] == 'f');
    if (cycles == 0) {
      semihosting::print("the drives do not start\n");
      return 1;
    }
    semihosting::print(cycles);
    semihosting::print("\n");
  }
  return 0;
}
