// ur10_emulator: an emulated Universal Robots UR10 controller (CB3) with a simulated arm behind its
// TCP ports, for clients of a real controller.
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "hal/os/cycle_clock.hpp"
#include "sim_plant/ur/motion/calibration.hpp"
#include "sim_plant/ur/scene/scene_reader.hpp"
#include "sim_plant/ur/server/cycle_grid.hpp"
#include "sim_plant/ur/server/options.hpp"
#include "sim_plant/ur/server/server.hpp"

namespace tactus::ur {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

void interrupt(int) {
  g_interrupted = 1;
}

Settings settings_of(const EmulatorOptions& options) {
  Settings settings;
  settings.version = {options.version[0], options.version[1], options.version[2],
                      options.version[3]};
  settings.initial_q = Joints(options.initial_q);
  if (options.ur10e) settings.dh = kDhOfUr10e;
  if (options.calibration != 0) settings.dh = draw_calibration(options.calibration);
  settings.tcp_offset = Vector6(options.tcp);
  settings.payload_kg = options.payload[0];
  settings.payload_cog = Vector3(options.payload + 1);
  settings.switched_on = !options.switched_off;
  settings.sensor_errors.on = options.sensor_errors;
  settings.sensor_errors.seed = options.seed;
  settings.start_time_s = options.start_time_s;
  settings.external_control_host = options.external_control_host;
  settings.external_control_port = options.external_control_port;
  return settings;
}

/// Fills `around` from the pipeline file at `path`. False: refused; prints "path:line: [section]
/// key: reason" to stderr. [init]
bool read_scene_file(const char* path, Surroundings& around) {
  static std::array<char, 65536 + 1> text;
  static SceneReader reader;
  std::FILE* file = std::fopen(path, "rb");
  const std::size_t size = file != nullptr ? std::fread(text.data(), 1, text.size(), file) : 0;
  const bool failed = file == nullptr || std::ferror(file) != 0;
  const int why = errno;
  if (file != nullptr) std::fclose(file);
  if (failed) {
    std::fprintf(stderr, "%s: %s\n", path, std::strerror(why));
    return false;
  }
  if (size == text.size()) {
    std::fprintf(stderr, "%s: the file is larger than %zu bytes\n", path, text.size() - 1);
    return false;
  }
  LoadError error;
  if (reader.read({text.data(), size}, around, error) == Status::kOk) return true;
  std::fprintf(stderr, "%s:%s%s\n", path, error.line > 0 ? "" : " ", error.message().c_str());
  return false;
}

/// Runs the cycles on their grid. In lock-step a cycle begins early if all clients have answered,
/// and waits for a client that always did.
void run(Emulator& emulator, Server& server, const EmulatorOptions& options) {
  const double cycle_s = emulator.controller().machine().cycle_s();
  const auto period_ns = static_cast<std::int64_t>(cycle_s * 1e9 / options.speed);
  const auto last = static_cast<std::int64_t>(options.duration_s / cycle_s + 0.5);
  constexpr std::int64_t kLongestWait_ns = 1'000'000'000;
  CycleGrid grid(period_ns, monotonic_ns());
  for (std::int64_t cycle = 0; g_interrupted == 0 && (last == 0 || cycle < last);) {
    const Pace pace = options.lock_step ? emulator.pace() : Pace::kByTime;
    const std::int64_t now_ns = monotonic_ns();
    const std::int64_t left_ns =
        grid.left_ns(now_ns) + (pace == Pace::kWaits ? kLongestWait_ns : 0);
    if (left_ns > 0 && pace != Pace::kAtOnce) {
      server.pump(left_ns);
      continue;
    }
    server.pump(0);
    emulator.tick();
    server.flush();
    ++cycle;
    if (options.lock_step)
      grid.begin_anew(now_ns);
    else
      grid.begin(now_ns);
  }
}

}  // namespace
}  // namespace tactus::ur

int main(int argc, char** argv) {
  using namespace tactus::ur;
  EmulatorOptions options;
  int exit_code = 0;
  if (!parse_emulator_options(argc, argv, options, exit_code)) return exit_code;
  Settings settings = settings_of(options);
  if (options.scene[0] != '\0' && !read_scene_file(options.scene, settings.surroundings)) return 2;
  static Emulator emulator(settings);
  if (emulator.start() != tactus::Status::kOk) {
    std::fprintf(stderr, "ur10_emulator: the arm could not be built\n");
    return 2;
  }
  static Server server(emulator);
  if (!server.start(options.address, options.port_offset)) {
    std::fprintf(stderr, "ur10_emulator: cannot listen at %s: %s\n", options.address,
                 std::strerror(errno));
    return 2;
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  std::printf("UR10 at %s: dashboard %d, primary %d, secondary %d, real-time %d, RTDE %d\n",
              options.address, kDashboardPort + options.port_offset,
              kPrimaryPort + options.port_offset, kSecondaryPort + options.port_offset,
              kRealtimePort + options.port_offset, kRtdePort + options.port_offset);
  std::fflush(stdout);
  run(emulator, server, options);
  return 0;
}
