// fer_drives: emulated CiA 402 drives of a Franka FER, with the arm that they move, on CAN buses.
#include <poll.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "hal/os/cycle_clock.hpp"
#include "sim_plant/drives/drive_arm.hpp"
#include "sim_plant/drives/server/bus_socket.hpp"
#include "sim_plant/drives/server/eds.hpp"
#include "sim_plant/drives/server/fault_text.hpp"
#include "sim_plant/drives/server/options.hpp"

namespace tactus::drives {
namespace {

constexpr std::size_t kMostBuses = DrivesOptions::kJoints;
constexpr int kRefused = 2;
constexpr int kWait_ms = 1;       // of poll: the resolution of the timers
constexpr int kMostFrames = 256;  // of one bus at a time

volatile std::sig_atomic_t g_interrupted = 0;

void interrupt(int) {
  g_interrupted = 1;
}

/// One bus: its socket, and a frame that its queue had no room for.
struct Wire {
  BusSocket socket;
  can::CanFrame waiting;
  bool waits = false;
};

/// Node n moves joint n if all nodes are joints' numbers; else the nodes move the joints in their
/// order. Returns what is wrong, or null.
const char* place(const DrivesOptions& options, DriveArmSettings& settings) {
  bool by_number = true;
  int nodes = 0;
  for (int b = 0; b < options.bus_count; ++b)
    for (int i = 0; i < options.buses[b].count; ++i, ++nodes)
      by_number = by_number && options.buses[b].nodes[i] <= kDof;
  if (nodes > kDof) return "there are more nodes than joints";
  int joint = 0;
  for (int b = 0; b < options.bus_count; ++b) {
    for (int i = 0; i < options.buses[b].count; ++i) {
      const int node = options.buses[b].nodes[i];
      auto& where = settings.joints[static_cast<std::size_t>(by_number ? node - 1 : joint++)];
      if (where.node != 0) return "a node moves one joint, and appears only once";
      where = {b, node};
    }
  }
  return nullptr;
}

DriveArmSettings settings_of(const DrivesOptions& options) {
  DriveArmSettings settings;
  settings.fd = options.fd;
  settings.start = options.start;
  options.apply(settings);
  settings.seed = options.seed;
  return settings;
}

bool open(const DrivesOptions& options, std::array<Wire, kMostBuses>& wires) {
  for (int b = 0; b < options.bus_count; ++b) {
    const DrivesOptions::Bus& bus = options.buses[b];
    BusSocket& socket = wires[static_cast<std::size_t>(b)].socket;
    const bool good = bus.interface[0] != '\0' ? socket.open(bus.interface, options.fd)
                                               : socket.adopt(bus.descriptor);
    if (good) continue;
    const char* name = bus.interface[0] != '\0' ? bus.interface : "--descriptor";
    std::fprintf(stderr, "fer_drives: %s: %s: %s\n", name, socket.what(), std::strerror(errno));
    return false;
  }
  return true;
}

/// Passes on the frames of a bus up to and including one SYNC, so that the buses take turns cycle
/// by cycle even after a stall. Returns true if there may be more.
bool pass_on(std::size_t bus, Wire& wire, DriveArm& arm) {
  for (int n = 0; n < kMostFrames && wire.socket.descriptor() >= 0; ++n) {
    can::CanFrame frame;
    if (!wire.socket.receive(frame)) return false;
    arm.receive(bus, frame, monotonic_ns());
    if (frame.id == can::kSyncId) return true;
  }
  return wire.socket.descriptor() >= 0;
}

void send(std::size_t bus, Wire& wire, DriveArm& arm) {
  while (wire.socket.descriptor() >= 0) {
    if (!wire.waits && !arm.take(bus, wire.waiting)) return;
    wire.waits = !wire.socket.send(wire.waiting);
    if (wire.waits) return;
  }
}

/// Returns false when no bus is open any more.
bool wait(std::array<Wire, kMostBuses>& wires, std::size_t buses) {
  std::array<pollfd, kMostBuses> polled{};
  bool open = false;
  for (std::size_t b = 0; b < buses; ++b) {
    polled[b] = {wires[b].socket.descriptor(), POLLIN, 0};
    open = open || wires[b].socket.descriptor() >= 0;
  }
  if (open) poll(polled.data(), buses, kWait_ms);
  return open;
}

void run(DriveArm& arm, std::array<Wire, kMostBuses>& wires, std::size_t buses, double duration_s) {
  const std::int64_t end_ns = monotonic_ns() + static_cast<std::int64_t>(duration_s * 1e9);
  while (g_interrupted == 0 && (duration_s == 0.0 || monotonic_ns() < end_ns)) {
    if (!wait(wires, buses)) return;
    for (bool more = true; more;) {
      more = false;
      for (std::size_t b = 0; b < buses; ++b) {
        more = pass_on(b, wires[b], arm) || more;
        send(b, wires[b], arm);
      }
    }
    arm.advance(monotonic_ns());
    for (std::size_t b = 0; b < buses; ++b) send(b, wires[b], arm);
  }
}

int fail(const char* what, const char* why) {
  std::fprintf(stderr, "fer_drives: %s%s\n", what, why);
  return kRefused;
}

}  // namespace
}  // namespace tactus::drives

int main(int argc, char** argv) {
  using namespace tactus::drives;
  DrivesOptions options;
  int exit_code = 0;
  if (!parse_drives_options(argc, argv, options, exit_code)) return exit_code;
  if (options.eds) return print_eds(stdout) ? 0 : kRefused;
  DriveArmSettings settings = settings_of(options);
  if (const char* wrong = place(options, settings)) return fail(wrong, "");
  static DriveArm arm;
  if (arm.load(settings, tactus::monotonic_ns()) != tactus::Status::kOk)
    return fail("the arm could not be built", "");
  for (int i = 0; i < options.fault_count; ++i) {
    Fault fault;
    if (const char* wrong = parse_fault(options.faults[i], fault)) return fail("--fault: ", wrong);
    if (!arm.add(fault)) return fail("--fault: ", "a node has too many faults");
  }
  static std::array<Wire, kMostBuses> wires;
  if (!open(options, wires)) return kRefused;
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  std::printf("FER drives on %d %s, %s: ready\n", options.bus_count,
              options.bus_count == 1 ? "bus" : "buses", options.fd ? "CAN FD" : "classic CAN");
  std::fflush(stdout);
  run(arm, wires, static_cast<std::size_t>(options.bus_count), options.duration_s);
  return 0;
}
