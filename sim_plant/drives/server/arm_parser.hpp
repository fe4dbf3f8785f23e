// Reads ArmOptions from a command line. For the options.cpp of a program only: CLI11 needs
// exceptions.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "sim_plant/drives/server/arm_options.hpp"
#include "sim_plant/server/finite.hpp"

namespace tactus::drives {

class ArmParser {
 public:
  explicit ArmParser(ArmOptions& options) : options_(options) {}

  void add_arm(CLI::App& app) {
    app.add_option("--joints", q_,
                   "initial positions of the seven joints, rad (default: ready pose)")
        ->expected(7)
        ->check(finite(-6.3, 6.3));
    app.add_option("--mounting", mounting_, "of the base: roll, pitch, yaw, rad (default: upright)")
        ->expected(3)
        ->check(finite(-3.15, 3.15));
    app.add_flag("--gravity-by-drive", options_.gravity_by_drive,
                 "the drives compensate gravity: target torque 0 holds the arm");
    app.add_option("--friction", options_.friction,
                   "multiple of the identified joint friction (default 1)")
        ->check(finite(0.0, 10.0));
    app.add_option("--rotor-inertia", options_.rotor_inertia,
                   "rotor inertia at each joint, kg m^2 (default 0.1)")
        ->check(finite(0.0, 10.0));
    app.add_option("--brake-release-ms", options_.brake_release_ms,
                   "time that a brake takes to open, ms (default 150)")
        ->check(finite(0.0, 10000.0));
    app.add_option("--velocity-unit", options_.velocity_unit,
                   "60A9h of all drives: 0x00B50300, increments/s (default), or revolutions, "
                   "0x00B44700 rev/min");
    app.add_option("--torque-share", options_.torque_share,
                   "share of the motors' torque that 6072h allows (default 1)")
        ->check(finite(0.0, 1.0));
  }
  void add_faults_and_duration(CLI::App& app, const std::string& faults) {
    app.add_option("--fault", faults_, faults)->take_all();
    app.add_option("--seed", options_.seed, "seed of faults by probability (default 1)");
    app.add_option("--duration", options_.duration_s,
                   "time after which the program ends, s (default: never)")
        ->check(finite(0.0, 1e7));
  }
  /// Parses the line, and takes what remains with `rest`, which returns what is wrong, or "".
  /// False: the program must end with `exit_code`.
  template <class Rest>
  bool parse(CLI::App& app, int argc, char** argv, int& exit_code, Rest rest) {
    constexpr int kRefused = 2;
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      exit_code = app.exit(error) == 0 ? 0 : kRefused;
      return false;
    }
    std::string wrong = rest();
    if (wrong.empty()) wrong = take();
    if (wrong.empty()) return true;
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), wrong.c_str());
    exit_code = kRefused;
    return false;
  }

 private:
  std::string take() {
    for (const std::string& fault : faults_) {
      if (options_.fault_count == ArmOptions::kFaults) return "there are more than 16 faults";
      if (fault.size() >= sizeof options_.faults[0]) return "the text '" + fault + "' is too long";
      std::strncpy(options_.faults[options_.fault_count++], fault.c_str(),
                   sizeof options_.faults[0] - 1);
    }
    options_.joints_given = !q_.empty();
    for (std::size_t i = 0; i < q_.size(); ++i) options_.joints[i] = q_[i];
    for (std::size_t i = 0; i < mounting_.size(); ++i) options_.mounting[i] = mounting_[i];
    return "";
  }

  ArmOptions& options_;
  std::vector<std::string> faults_;
  std::vector<double> q_, mounting_;
};

}  // namespace tactus::drives
