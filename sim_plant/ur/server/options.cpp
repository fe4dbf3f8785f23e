#include "sim_plant/ur/server/options.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "sim_plant/server/finite.hpp"

namespace tactus::ur {
namespace {

constexpr int kRefused = 2;

CLI::Validator shorter_than(std::size_t size) {
  return CLI::Validator(
      [size](std::string& text) { return text.size() < size ? "" : "the text is too long"; }, "");
}

/// Reads MAJOR.MINOR.BUGFIX.BUILD; false: prints why not to stderr.
bool parse_version(const std::string& text, unsigned (&version)[4]) {
  int used = 0;
  const int read = std::sscanf(text.c_str(), "%3u.%3u.%9u.%9u%n", &version[0], &version[1],
                               &version[2], &version[3], &used);
  const bool whole = read == 4 && static_cast<std::size_t>(used) == text.size() &&
                     text.find_first_not_of("0123456789.") == std::string::npos;
  if (!whole)
    std::fprintf(stderr,
                 "--software: '%s' has not four whole numbers with a point between them; give "
                 "them all, as in 3.15.8.106339 or 5.11.1.108318\n",
                 text.c_str());
  else if (version[0] != 3 && version[0] != 5)
    std::fprintf(stderr, "--software: '%s': the first number is %u; it must be 3 or 5\n",
                 text.c_str(), version[0]);
  return whole && (version[0] == 3 || version[0] == 5);
}

}  // namespace

bool parse_emulator_options(int argc, char** argv, EmulatorOptions& options, int& exit_code) {
  std::string address = options.address, host, scene, version = "3.15.8.106339";
  std::vector<double> q(std::begin(options.initial_q), std::end(options.initial_q));
  std::vector<double> payload(4, 0.0), tcp(6, 0.0);
  CLI::App app{"An emulated Universal Robots UR10 controller (CB3)", "ur10_emulator"};
  app.add_option("--bind", address, "IPv4 address to listen at (default 127.0.0.1)")
      ->check(shorter_than(sizeof options.address));
  app.add_option("--port-offset", options.port_offset, "added to every port (default 0)")
      ->check(finite(-28000, 30000));
  app.add_option("--speed", options.speed, "speed as a multiple of real time (default 1)")
      ->check(finite(0.01, 1000.0));
  app.add_flag("--lock-step", options.lock_step,
               "begin the next cycle once every client that writes inputs has answered");
  app.add_option("--start-time", options.start_time_s,
                 "initial time of the controller's clock, s (default 100)")
      ->check(finite(0.0, 1e7));
  app.add_option("--duration", options.duration_s,
                 "time after which the program ends, s of the controller's clock (default: never)")
      ->check(finite(0.0, 1e7));
  app.add_flag("--off", options.switched_off, "begin in POWER_OFF instead of RUNNING");
  app.add_option("--joints", q, "initial positions of the six joints, rad")
      ->expected(6)
      ->check(finite(-6.3, 6.3));
  app.add_option("--scene", scene,
                 "pipeline file whose boxes the arm touches, with its tool (default: none)")
      ->check(shorter_than(sizeof options.scene));
  app.add_flag("--sensor-errors", options.sensor_errors,
               "force and speeds have noise and bias like a robot's (default: exact)");
  app.add_option("--seed", options.seed, "seed of these errors (default 1)");
  app.add_option(
      "--software", version,
      "software version, four numbers (default 3.15.8.106339); a first number of 5 has the "
      "cycle of an e-Series");
  app.add_option("--payload", payload, "payload on the pendant: kg, and its centre of mass, m")
      ->expected(4)
      ->check(finite(-100.0, 100.0));
  app.add_option("--tcp", tcp, "TCP on the pendant: m, and a rotation vector")
      ->expected(6)
      ->check(finite(-100.0, 100.0));
  CLI::Option* ur10e = app.add_flag("--ur10e", options.ur10e, "report the poses of a UR10e");
  app.add_option("--calibration", options.calibration,
                 "seed of a calibration, by which it reports its poses (default: none)")
      ->check(CLI::Range(1u, 0xffffffffu))
      ->excludes(ur10e);
  app.add_option("--external-control", host,
                 "address from which external_control.urp fetches its script (default: no program)")
      ->check(shorter_than(sizeof options.address));
  app.add_option("--external-control-port", options.external_control_port,
                 "port from which it fetches the script (default 50002)")
      ->check(finite(1, 65535));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : kRefused;
    return false;
  }
  if (!parse_version(version, options.version)) {
    exit_code = kRefused;
    return false;
  }
  std::strncpy(options.address, address.c_str(), sizeof options.address - 1);
  std::strncpy(options.scene, scene.c_str(), sizeof options.scene - 1);
  std::strncpy(options.external_control_host, host.c_str(),
               sizeof options.external_control_host - 1);
  for (std::size_t i = 0; i < 6; ++i) options.initial_q[i] = q[i];
  for (std::size_t i = 0; i < 6; ++i) options.tcp[i] = tcp[i];
  for (std::size_t i = 0; i < 4; ++i) options.payload[i] = payload[i];
  return true;
}

}  // namespace tactus::ur
