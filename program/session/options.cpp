#include "program/session/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "gateway/mcap_writer.hpp"
#include "gateway/version.hpp"
#include "kernel/load/ini.hpp"

namespace tactus {
namespace {

template <std::size_t N>
void copy(const std::string& from, char (&to)[N]) {
  std::strncpy(to, from.c_str(), N - 1);
}

CLI::Validator path() {
  return CLI::Validator(
      [](std::string& text) {
        return text.empty() ? "the path is empty" : text.size() < 512 ? "" : "the path is too long";
      },
      "");
}

/// Accepts what the kernel may call a network interface.
CLI::Validator interface_name() {
  return CLI::Validator(
      [](std::string& text) {
        const bool good = !text.empty() && text.size() < sizeof Options::interface &&
                          text.find_first_of("/ ") == std::string::npos;
        return good ? std::string() : "'" + text + "' is not the name of a network interface";
      },
      "");
}

/// Accepts only plain decimal numbers in range. The library's own conversions also accept "nan", a
/// sign or 0x10.
template <class Number>
CLI::Validator decimal(Number lowest, Number highest, const char* expected) {
  return CLI::Validator(
      [lowest, highest, expected](std::string& text) {
        Number value{};
        const char* end = text.data() + text.size();
        const auto [stop, code] = std::from_chars(text.data(), end, value);
        const bool good = code == std::errc() && stop == end && value >= lowest && value <= highest;
        return good ? std::string() : "'" + text + "' is not " + expected;
      },
      "");
}

/// Accepts section.key=value; the loader judges the three.
CLI::Validator assignment() {
  return CLI::Validator(
      [](std::string& text) {
        const std::size_t equals = text.find('='), dot = text.find('.');
        const bool good = dot < equals && equals < text.size() && is_text(text) &&
                          text.find_first_of("#[") > equals &&
                          text.size() < sizeof OverrideOptions::texts[0];
        return good ? std::string()
                    : "'" + text + "' is not section.key=value of at most 255 characters";
      },
      "");
}

/// Accepts only what is named as a recording, since the file is replaced.
CLI::Validator recording() {
  return CLI::Validator(
      [](std::string& text) {
        return is_mcap(text) ? std::string() : "'" + text + "' does not end with .mcap";
      },
      "");
}

void add_run_options(CLI::App& run, std::string& out, std::string& record, Options& options) {
  constexpr std::uint64_t kLargestSeed = ~std::uint64_t{0};
  run.add_option("--out", out, "folder to write into (default out/<pipeline>)")->check(path());
  run.add_option("--record", record, "MCAP file to write rows and events to (default: none)")
      ->check(path())
      ->check(recording());
  run.add_option("--duration", options.duration_s,
                 "length of the run, s (default: until the trajectory has settled)")
      ->check(decimal(1e-3, 1e6, "a number from 0.001 to 1000000"));
  run.add_option("--seed", options.seed, "seed of the sensor noise (default 1)")
      ->check(decimal(std::uint64_t{0}, kLargestSeed, "a whole number of up to 64 bits"));
  run.add_flag_callback(
      "--no-figure", [&options] { options.figure = false; }, "do not draw the figure");
  run.add_flag_callback(
      "--no-log", [&options] { options.log = options.figure = false; },
      "write neither log.csv nor the figure");
  run.add_flag("--realtime", options.realtime,
               "run one cycle per period of the wall clock instead of as fast as possible");
}

void add_serve_options(CLI::App& serve, std::string& pipeline, std::string& listen,
                       std::string& key, std::string& http, std::string& out, Options& options) {
  serve.add_option("pipeline", pipeline, "pipeline file (.ini)")->required()->check(path());
  serve
      .add_option("--listen", listen,
                  "unix:PATH or tcp:127.0.0.1:PORT (default: a Unix socket of the user)")
      ->check([](const std::string& text) {
        return text.size() < sizeof Options::listen ? "" : "the address is too long";
      });
  serve.add_option("--key", key, "file with the key of the clients, for an address of the network")
      ->check(path());
  serve.add_option("--http", http, "127.0.0.1:PORT: show the robot on a page there; port 0: any")
      ->check([](const std::string& text) {
        return text.size() < sizeof Options::http ? "" : "the address is too long";
      });
  serve.add_option("--seed", options.seed, "seed of the sensor noise (default 1)")
      ->check(decimal(std::uint64_t{0}, ~std::uint64_t{0}, "a whole number of up to 64 bits"));
  serve.add_option("--out", out, "folder for the log of the session (default: none is written)")
      ->check(path());
  serve.add_option("--rows", options.rows, "rows of the log at most (default 1000000)")
      ->check(decimal(std::int64_t{1}, std::int64_t{1} << 40, "a whole number from 1"));
  serve.add_flag("--virtual-time", options.virtual_time,
                 "a simulated robot waits for a late cycle instead of being braked");
}

/// Adds the options of `doctor` and `jitter` that say on which CPU and priority a cycle would run.
void add_host_options(CLI::App& verb, Options& options) {
  verb.add_option("--cpu", options.cpu, "number of the CPU for the cycle (default: any)")
      ->check(decimal(0, 1023, "a whole number from 0 to 1023"));
  verb.add_option("--priority", options.priority, "SCHED_FIFO priority of the cycle (default 80)")
      ->check(decimal(1, 98, "a whole number from 1 to 98"));
}

void add_jitter_options(CLI::App& jitter, std::vector<std::string>& load, Options& options) {
  jitter
      .add_option("--load", load,
                  "measure under load by stress-ng too: cpu, memory, disk, with commas between")
      ->delimiter(',')
      ->check(CLI::IsMember({"cpu", "memory", "disk"}));
  jitter.add_option("--duration", options.duration_s, "length of each measurement, s (default 5)")
      ->check(decimal(1e-3, 1e5, "a number from 0.001 to 100000"));
  jitter.add_option("--period-us", options.period_us, "period of the cycle, us (default 1000)")
      ->check(decimal(100, 100000, "a whole number from 100 to 100000"));
}

void add_scan_options(CLI::App& scan, std::vector<std::string>& buses, Options& options) {
  scan.add_option("interfaces", buses, "the buses or interfaces, can0 or eth0 for example")
      ->required()
      ->expected(-1)
      ->check(interface_name());
  scan.add_option("--answer-ms", options.answer_ms,
                  "longest time for an answer of a node, ms (default 100)")
      ->check(decimal(1, 10000, "a whole number from 1 to 10000"));
}

}  // namespace

bool parse_options(int argc, char** argv, const char* board, bool has_bus, Options& options,
                   int& exit_code) {
  std::string pipeline, trajectory, out, record, root, interface, listen, key, http;
  std::vector<std::string> load, buses, overrides;
  CLI::App app{std::string("Tactus on the board ") + board, "tactus"};
  app.set_version_flag("--version", std::string("tactus ") + kVersion + ", board " + board);
  app.set_help_all_flag("--help-all", "Print the help of every verb and exit");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("tactus: ") + error.what() + "; tactus --help-all lists what there is\n";
  });
  app.require_subcommand(0, 1);  // a missing verb is refused below, with a better message
  app.footer("Exit codes: 0 succeeded; 1 ended otherwise; 2 refused before the first cycle.");

  CLI::App* run = app.add_subcommand("run", "run a pipeline and write log, summary and figure");
  CLI::App* check =
      app.add_subcommand("check", "check a pipeline and a trajectory without moving the robot");
  CLI::App* ports = app.add_subcommand("ports", "print every block, port, unit, setting and range");
  for (CLI::App* verb : {run, check}) {
    verb->add_option("pipeline", pipeline, "pipeline file (.ini)")->required()->check(path());
    verb->add_option("--trajectory", trajectory,
                     "trajectory file (.csv); replaces the one named in the pipeline")
        ->check(path());
  }
  add_run_options(*run, out, record, options);
  CLI::App* serve = app.add_subcommand("serve", "run a pipeline for clients until Ctrl-C");
  add_serve_options(*serve, pipeline, listen, key, http, out, options);
  for (CLI::App* verb : {run, check, serve}) {
    verb->add_option("--set", overrides,
                     "section.key=value: replaces or adds a key of the pipeline file; repeatable")
        ->allow_extra_args(false)
        ->check(assignment());
  }
  CLI::App* doctor = app.add_subcommand("doctor", "list settings of this host that hurt real time");
  doctor->add_option("--root", root, "folder that contains proc and sys (default /)")
      ->check(path());
  doctor
      ->add_option("--interface", interface,
                   "network interface of the robot, eth1 for example (default: none)")
      ->check(interface_name());
  CLI::App* jitter = app.add_subcommand("jitter", "measure how late this host wakes a cycle");
  for (CLI::App* verb : {doctor, jitter}) add_host_options(*verb, options);
  add_jitter_options(*jitter, load, options);
  CLI::App* scan = nullptr;
  if (has_bus) {
    scan = app.add_subcommand(
        "scan", "list the drives of CAN buses or EtherCAT segments, without changing them");
    add_scan_options(*scan, buses, options);
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? kSucceeded : kRefused;
    return false;
  }
  if (app.get_subcommands().empty()) {
    std::fprintf(stderr, "tactus: a verb is required: run, serve, check, ports, doctor%s\n",
                 has_bus ? ", jitter or scan" : " or jitter");
    exit_code = kRefused;
    return false;
  }
  if (buses.size() > Options::kMostBuses) {
    std::fprintf(stderr, "tactus: %zu interfaces, at most %d\n", buses.size(), Options::kMostBuses);
    exit_code = kRefused;
    return false;
  }
  if (overrides.size() > OverrideOptions::kMost) {
    std::fprintf(stderr, "tactus: --set is given %zu times, at most %d; edit the pipeline file\n",
                 overrides.size(), OverrideOptions::kMost);
    exit_code = kRefused;
    return false;
  }
  copy(pipeline, options.pipeline);
  copy(trajectory, options.trajectory);
  copy(out, options.out);
  copy(record, options.record);
  copy(listen, options.listen);
  copy(key, options.key);
  copy(http, options.http);
  copy(root, options.root);
  copy(interface, options.interface);
  for (const std::string& kind : load) {
    options.load.cpu |= kind == "cpu";
    options.load.memory |= kind == "memory";
    options.load.disk |= kind == "disk";
  }
  for (const std::string& text : overrides)
    copy(text, options.overrides.texts[options.overrides.count++]);
  for (const std::string& bus : buses) copy(bus, options.buses[options.bus_count++]);
  options.verb = has_bus && *scan ? Verb::kScan
                 : *ports         ? Verb::kPorts
                 : *serve         ? Verb::kServe
                 : *check         ? Verb::kCheck
                 : *doctor        ? Verb::kDoctor
                 : *jitter        ? Verb::kJitter
                                  : Verb::kRun;
  return true;
}

}  // namespace tactus
