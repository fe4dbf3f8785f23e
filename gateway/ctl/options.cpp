#include "gateway/ctl/options.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "gateway/version.hpp"

namespace tactus::ctl {
namespace {

/// Reads a plain decimal number, with a per cent sign if `percent`. The library's own conversions
/// also accept "nan", a sign or 0x10.
bool read(std::string text, bool percent, double& value) {
  double scale = 1.0;
  if (percent && !text.empty() && text.back() == '%') {
    text.pop_back();
    scale = 100.0;
  }
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  value /= scale;
  return code == std::errc() && stop == end && std::isfinite(value);
}

CLI::Validator number(double lowest, double highest, const char* expected) {
  return CLI::Validator(
      [=](std::string& text) {
        double value = 0.0;
        const bool good = read(text, false, value) && value >= lowest && value <= highest;
        return good ? std::string() : "'" + text + "' is not " + expected;
      },
      "");
}

/// A share of something, with a per cent sign or without; for transform(), which may rewrite it.
CLI::Validator share(double lowest, const char* expected) {
  return CLI::Validator(
      [=](std::string& text) {
        double value = 0.0;
        if (!read(text, true, value) || !(value >= lowest && value <= 1.0))
          return "'" + text + "' is not " + expected;
        text = CLI::detail::to_string(value);
        return std::string();
      },
      "");
}

CLI::Validator whole(int lowest, int highest) {
  return CLI::Validator(
      [=](std::string& text) {
        int value = 0;
        const char* end = text.data() + text.size();
        const auto [stop, code] = std::from_chars(text.data(), end, value);
        const bool good = code == std::errc() && stop == end && value >= lowest && value <= highest;
        return good ? std::string()
                    : "'" + text + "' is not a whole number from " + std::to_string(lowest) +
                          " to " + std::to_string(highest);
      },
      "");
}

CLI::Validator finite() {
  return number(-1e9, 1e9, "a finite number");
}

void add_connection(CLI::App& verb, Options& o) {
  verb.add_option("--connect", o.connect,
                  "unix:PATH or tcp:HOST:PORT (default: TACTUS_SOCKET, else that of tactus serve)");
  verb.add_option("--key", o.key, "key file, for a server that was started with one");
  verb.add_option("--name", o.name, "name that others see (default tactusctl-<process>)")
      ->check(CLI::Validator(
          [](std::string& text) {
            return text.empty() || text.size() > 31 ? "a name has 1 to 31 bytes" : "";
          },
          ""));
  verb.add_option("--timeout-ms", o.timeout_ms, "longest wait for the server, ms (default 5000)")
      ->check(whole(1, 600000));
  verb.add_flag("--json", o.json, "one JSON object per line, for scripts");
}

void add_lease(CLI::App& verb, Options& o) {
  verb.add_option("--priority", o.priority, "priority of the lease, 0 to 255 (default 100)")
      ->check(whole(0, 255));
  verb.add_option("--lease-ms", o.lease_ms,
                  "the arm comes to rest if this program is silent for so long, ms (default 1000)")
      ->check(whole(20, 60000));
}

void add_terms(CLI::App& verb, Options& o) {
  verb.add_flag("--partial", o.partial, "joints that are left out hold");
  verb.add_option("--motion-frame", o.motion_frame,
                  "frame of poses, block.port of the pipeline, or base (default: the pipeline's)");
  verb.add_option("--wrench-frame", o.wrench_frame, "frame of wrenches, likewise");
}

void add_trajectory(CLI::App& verb, Options& o) {
  verb.add_option("trajectory", o.file, "trajectory file (.csv); - is standard input")->required();
  verb.add_option("--interpolation", o.interpolation, "between waypoints (default: by fields)")
      ->check(CLI::IsMember({"fields", "linear", "cubic", "quintic", "monotone"}));
  verb.add_option("--wrap", o.wrap,
                  "angles of joints without end (default as_given; nearest: each is the nearest to "
                  "that before which differs by whole turns)")
      ->check(CLI::IsMember({"as_given", "nearest"}));
  verb.add_flag("--exact", o.exact, "refuse instead of slowing down");
  add_terms(verb, o);
}

void add_point(CLI::App& verb, Options& o) {
  verb.add_option("numbers", o.numbers,
                  "position of every joint, rad, of a prismatic one m; or a pose")
      ->required()
      ->check(finite());
  verb.add_flag("--pose", o.pose, "the numbers are x y z, m, and qw qx qy qz of the tip");
  verb.add_flag("--deg", o.degrees, "positions of joints are in degrees");
  verb.add_flag("--wait", o.wait, "wait until the arm holds the point");
  add_terms(verb, o);
}

void add_stream(CLI::App& verb, Options& o) {
  verb.add_option("targets", o.file, "CSV file of targets, a header and a row each (default -)");
  verb.add_option("--period-ms", o.period_ms, "time between two rows (default: as they come)")
      ->check(number(0.1, 10000.0, "a number from 0.1 to 10000"));
  add_terms(verb, o);
}

void add_jog(CLI::App& verb, Options& o) {
  verb.add_option("--speed", o.speed, "fraction of the velocity limit (default 10%)")
      ->transform(share(0.001, "from 0.1% to 100%"));
  verb.add_option("--hold-ms", o.hold_ms, "the arm stops so long after the last key (default 300)")
      ->check(whole(1, 10000));
  verb.add_option("--joystick", o.joystick, "joystick instead of the keyboard, /dev/input/js0");
}

void add_retime(CLI::App& verb, Options& o) {
  verb.add_option("path", o.file, "CSV file of positions or poses; times are ignored")->required();
  verb.add_option("--out", o.out, "trajectory file to write (default: standard output)");
  verb.add_option("--robot", o.robot, "robot whose limits hold (default: that of the server)");
  for (CLI::Option* option :
       {verb.add_option("--tolerance", o.tolerance_rad,
                        "round corners; joints, or the tip's orientation, stay so near, rad"),
        verb.add_option("--tolerance-m", o.tolerance_m, "round corners; the tip stays so near, m"),
        verb.add_option("--radius", o.radius_rad, "round joints' corners, from so far on, rad")})
    option->check(number(1e-6, 10.0, "a number from 1e-6 to 10"));
  verb.add_option("--velocity", o.velocity_scale, "share of the velocity limits (default 100%)")
      ->transform(share(0.001, "from 0.1% to 100%"));
  verb.add_option("--acceleration", o.acceleration_scale,
                  "share of the limits of acceleration and jerk (default 98%: the server keeps 2% "
                  "free for stops)")
      ->transform(share(0.001, "from 0.1% to 100%"));
  verb.add_flag_callback(
      "--no-jerk", [&o] { o.jerk = false; }, "let accelerations step");
}

void add_views(CLI::App& watch, CLI::App& record, Options& o) {
  record
      .add_option(
          "out", o.out,
          "file to write: states as CSV; FILE.mcap: events too, as MCAP; - is standard output")
      ->required();
  record.add_flag("--trajectory", o.trajectory, "only times and positions, as send reads them");
  for (CLI::App* verb : {&watch, &record}) {
    verb->add_option("--every-ms", o.every_ms, "time between two states (default 100; record 10)")
        ->check(whole(1, 60000));
    verb->add_option("--duration", o.duration_s, "time to run, s (default: until Ctrl-C)")
        ->check(number(1e-3, 1e7, "a number from 0.001 to 10000000"));
  }
}

struct VerbHelp {
  Verb verb;
  const char *name, *help;
};

constexpr VerbHelp kVerbs[] = {
    {Verb::kSend, "send", "send a trajectory and follow it to its result; Ctrl-C cancels"},
    {Verb::kCheck, "check", "have the server judge a trajectory, without motion"},
    {Verb::kPoint, "point", "go to a point"},
    {Verb::kStream, "stream", "send targets as they come, from standard input"},
    {Verb::kJog, "jog", "move joints by keys or a joystick"},
    {Verb::kCancel, "cancel", "cancel what runs; the arm stops on its path"},
    {Verb::kOverride, "override", "pass trajectories at a share of their speed"},
    {Verb::kPause, "pause", "stop on the path, and wait"},
    {Verb::kResume, "resume", "go on"},
    {Verb::kStop, "stop", "stop the arm; needs no lease, ends with rearm"},
    {Verb::kRearm, "rearm", "take the arm over after a stop"},
    {Verb::kTare, "tare", "take a new zero of the force/torque sensor, without a stop"},
    {Verb::kWatch, "watch", "show the state of the arm"},
    {Verb::kRecord, "record", "write states into a CSV or MCAP file"},
    {Verb::kParams, "params", "list parameters of the pipeline, or change them, all in one cycle"},
    {Verb::kInfo, "info", "print what the server says of robot and limits"},
    {Verb::kRetime, "retime", "turn a path without times into the fastest trajectory"},
};

/// Adds the options of one verb.
void fill(Verb verb, CLI::App& app, Options& o) {
  add_connection(app, o);
  if (verb != Verb::kWatch && verb != Verb::kRecord && verb != Verb::kInfo && verb != Verb::kRetime)
    add_lease(app, o);
  switch (verb) {
    case Verb::kSend:
      app.add_flag("--detach", o.detach, "leave once it moves and all is sent; it goes on");
      add_trajectory(app, o);
      break;
    case Verb::kCheck: add_trajectory(app, o); break;
    case Verb::kPoint: add_point(app, o); break;
    case Verb::kStream: add_stream(app, o); break;
    case Verb::kJog: add_jog(app, o); break;
    case Verb::kRetime: add_retime(app, o); break;
    case Verb::kOverride:
      app.add_option("rate", o.rate, "50% or 0.5")
          ->required()
          ->transform(share(0.0, "from 0% to 100%, or 0 to 1"));
      break;
    case Verb::kParams:
      app.add_option("settings", o.settings,
                     "section.key=value, as in the pipeline file (default: list what there is)");
      app.add_flag("--check", o.check_only, "judge them and change nothing");
      break;
    default: break;
  }
}

}  // namespace

bool parse_options(int argc, char** argv, Options& options, int& exit_code) {
  CLI::App app{"Client of the server of references of Tactus", "tactusctl"};
  app.set_version_flag("--version", std::string("tactusctl ") + kVersion);
  app.set_help_all_flag("--help-all", "Print the help of every verb and exit");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("tactusctl: ") + error.what() +
           "; tactusctl --help-all lists what there is\n";
  });
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 succeeded; 1 ended otherwise; 2 refused; 3 no connection.\n"
      "TACTUS_SOCKET is the address if --connect is not given.");
  options.name = "tactusctl-" + std::to_string(getpid());
  options.file = "-";
  options.out = "-";
  for (const VerbHelp& verb : kVerbs) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.help);
    fill(verb.verb, *sub, options);
    sub->callback([&options, &verb] { options.verb = verb.verb; });
  }
  add_views(*app.get_subcommand("watch"), *app.get_subcommand("record"), options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? kSucceeded : kRefused;
    return false;
  }
  // An option that names the variable would read it for every verb, after --connect of one.
  if (const char* usual = std::getenv("TACTUS_SOCKET"); usual != nullptr && options.connect.empty())
    options.connect = usual;
  return true;
}

}  // namespace tactus::ctl
