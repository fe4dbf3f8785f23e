#include "sim_plant/ur/controller/dashboard.hpp"

namespace tactus::ur {
namespace {

/// The programs on the disk of the emulated controller.
constexpr std::string_view kWaitProgram = "wait_program.urp";
constexpr std::string_view kExternalControl = "external_control.urp";
constexpr std::string_view kWaitScript =
    "def wait_program():\n  while True:\n    sleep(1.0)\n  end\nend\n";
constexpr std::string_view kInstallation = "default.installation";

std::string_view base_name(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

/// Returns the text after a command in `rest`. False: the line is another command.
bool argument(std::string_view line, std::string_view command, std::string_view& rest) {
  if (!starts_with(line, command)) return false;
  if (line.size() > command.size() && line[command.size()] != ' ') return false;
  rest = trimmed(line.substr(command.size()));
  return true;
}

}  // namespace

bool Dashboard::run(std::string_view line, Reply& whole) {
  Answer reply;
  line = trimmed(line);
  const bool quits = line == "quit" || line == "shutdown";
  if (quits) {
    reply << (line == "quit" ? "Disconnected" : "Shutting down");
  } else if (!run_program_command(line, reply) && !run_robot_command(line, reply) &&
             !run_other_command(line, reply) && !run_e_series_command(line, reply)) {
    reply << "could not understand: '" << line.substr(0, 200) << "'";
  }
  whole = Reply(reply) << "\n";
  return quits;
}

std::string_view Dashboard::loaded_name() const {
  return loaded_.empty() ? "<unnamed>" : base_name(loaded_);
}

void Dashboard::load(std::string_view path, Answer& reply) {
  const std::string_view name = base_name(path);
  const bool has_control = !machine_.settings.external_control_host.empty();
  if (name != kWaitProgram && !(name == kExternalControl && has_control)) {
    reply << "File not found: " << path;
    return;
  }
  runner_.stop(machine_);
  loaded_ = path;
  reply << "Loading program: " << path;
}

void Dashboard::play(Answer& reply) {
  const bool can = machine_.power.running() && machine_.safety.normal();
  if (can && runner_.paused()) {
    runner_.resume();
  } else if (can && !runner_.running() && !loaded_.empty()) {
    if (loaded_name() == kWaitProgram)
      runner_.upload(kWaitScript, machine_);
    else
      runner_.fetch(machine_);
  }
  reply << (runner_.playing() ? "Starting program" : "Failed to execute: play");
}

bool Dashboard::run_program_command(std::string_view line, Answer& reply) {
  std::string_view rest;
  if (argument(line, "load installation", rest)) {
    reply << (base_name(rest) == kInstallation ? "Loading installation: " : "File not found: ")
          << rest;
  } else if (argument(line, "load", rest)) {
    load(rest, reply);
  } else if (line == "play") {
    play(reply);
  } else if (line == "stop") {
    const bool can = runner_.running() || !loaded_.empty() || !runner_.name().empty();
    runner_.stop(machine_);
    reply << (can ? "Stopped" : "Failed to execute: stop");
  } else if (line == "pause") {
    reply << (runner_.running() ? "Pausing program" : "Failed to execute: pause");
    runner_.pause();
  } else if (line == "running") {
    reply << "Program running: " << (runner_.playing() ? "true" : "false");
  } else if (line == "get loaded program") {
    reply << (loaded_.empty() ? "No program loaded" : "Loaded program: ") << loaded_;
  } else if (line == "isProgramSaved") {
    reply << "true " << loaded_name();
  } else if (line == "programState") {
    reply << (runner_.paused()    ? "PAUSED "
              : runner_.running() ? "PLAYING "
                                  : "STOPPED ")
          << loaded_name();
  } else {
    return false;
  }
  return true;
}

bool Dashboard::run_robot_command(std::string_view line, Answer& reply) {
  const Version& version = machine_.settings.version;
  if (line == "robotmode") {
    reply << "Robotmode: " << name(machine_.power.mode());
  } else if (line == "power on") {
    machine_.power.switch_on();
    reply << "Powering on";
  } else if (line == "power off") {
    runner_.stop(machine_);
    machine_.power.switch_off();
    reply << "Powering off";
  } else if (line == "brake release") {
    machine_.power.release_brakes();
    reply << "Brake releasing";
  } else if (line == "safetymode") {
    reply << "Safetymode: " << name(machine_.safety.mode());
  } else if (line == "safetystatus" && version.at_least(3, 11)) {
    reply << "Safetystatus: " << name(machine_.safety.mode());
  } else if (line == "unlock protective stop") {
    reply << (machine_.safety.unlock()
                  ? "Protective stop releasing"
                  : "Cannot unlock protective stop until 5s after occurrence. Always inspect cause "
                    "of protective stop before unlocking");
  } else if (line == "restart safety" && version.at_least(3, 7)) {
    runner_.stop(machine_);
    machine_.power.switch_off();
    machine_.safety.restart();
    reply << "Restarting safety";
  } else {
    return false;
  }
  return true;
}

bool Dashboard::run_other_command(std::string_view line, Answer& reply) {
  const Version& version = machine_.settings.version;
  struct Row {
    std::string_view command, reply;
    unsigned minor = 0;  // of the software that has it
  };
  constexpr Row kRows[] = {
      {"popup", "showing popup"},
      {"close popup", "closing popup"},
      {"close safety popup", "closing safety popup"},
      {"saveLog", "Log saved to disk"},
      {"get robot model", "UR10", 12},
      {"generate flight report",
       "Flight Report generated with id: 00000000-0000-0000-0000-000000000001", 13},
      {"generate support file", "Completed successfully: ur_support_file.zip", 13}};
  std::string_view rest;
  for (const Row& row : kRows) {
    if (!argument(line, row.command, rest) || !version.at_least(3, row.minor)) continue;
    reply << row.reply;
    return true;
  }
  if (argument(line, "addToLog", rest)) {
    reply << (rest.empty() ? "No log message to add" : "Added log message");
  } else if (line == "PolyscopeVersion") {
    reply << "URSoftware ";
    for (const std::size_t part : {version.major, version.minor, version.bugfix})
      reply << part << ".";
    reply << std::size_t{version.build} << " (Jan 01 2022)";
  } else if (argument(line, "setUserRole", rest)) {
    role_ = rest;
    reply << "Setting user role: " << rest;
  } else if (line == "getUserRole") {
    reply << (role_.empty() ? "PROGRAMMER" : std::string_view(role_));
  } else if (line == "get serial number" && version.at_least(3, 12)) {
    reply << machine_.settings.serial_number;
  } else {
    return false;
  }
  return true;
}

/// Runs the commands of an e-Series, which is always in remote control. The operational mode is
/// kept for the clients; it limits nothing.
bool Dashboard::run_e_series_command(std::string_view line, Answer& reply) {
  const Version& version = machine_.settings.version;
  std::string_view rest;
  if (!version.at_least(5, 0)) return false;
  if (argument(line, "set operational mode", rest)) {
    const bool manual = rest == "manual", known = manual || rest == "automatic";
    if (known) operational_mode_ = manual ? "MANUAL" : "AUTOMATIC";
    if (known)
      reply << "Operational mode " << operational_mode_ << " is set";
    else
      reply << "Failed setting operational mode: " << rest;
  } else if (line == "clear operational mode") {
    reply << "No longer controlling the operational mode. Current operational mode: '"
          << operational_mode_ << "'.";
  } else if (line == "get operational mode" && version.at_least(5, 6)) {
    reply << operational_mode_;
  } else if (line == "is in remote control" && version.at_least(5, 6)) {
    reply << "true";
  } else {
    return false;
  }
  return true;
}

}  // namespace tactus::ur
