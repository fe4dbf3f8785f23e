#include "boards/program/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string>

namespace tactus {
namespace {

void copy(const std::string& from, char (&to)[512]) {
  std::strncpy(to, from.c_str(), sizeof to - 1);
}

CLI::Validator path() {
  return CLI::Validator(
      [](std::string& text) {
        return text.empty() ? "the path is empty" : text.size() < 512 ? "" : "the path is too long";
      },
      "");
}

/// The library's own conversions let pass what is not a plain decimal number that fits: "nan", a
/// sign, 0x10.
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

void add_run_options(CLI::App& run, std::string& out, Options& options) {
  constexpr std::uint64_t kLargestSeed = ~std::uint64_t{0};
  run.add_option("--out", out, "folder to write into (default out/<pipeline>)")->check(path());
  run.add_option("--duration", options.duration_s, "s; default: until the trajectory has settled")
      ->check(decimal(1e-3, 1e6, "a number from 0.001 to 1000000"));
  run.add_option("--seed", options.seed, "of the sensor noise")
      ->check(decimal(std::uint64_t{0}, kLargestSeed, "a whole number of up to 64 bits"));
  run.add_flag("!--no-figure", options.figure, "do not draw figure.png");
}

}  // namespace

bool parse_options(int argc, char** argv, const char* board, Options& options, int& exit_code) {
  std::string pipeline, trajectory, out;
  CLI::App app{std::string("Tactus on the board ") + board, "tactus"};
  app.require_subcommand(0, 1);  // none at all is refused below, in words of our own
  app.footer(
      "Exit codes: 0 succeeded; 1 the run ended otherwise; 2 refused before the first cycle.");

  CLI::App* run = app.add_subcommand("run", "run a pipeline and write log, summary and figure");
  CLI::App* check = app.add_subcommand("check", "judge a pipeline and a trajectory; nothing moves");
  CLI::App* ports = app.add_subcommand("ports", "print every block, port, unit, setting and range");
  for (CLI::App* verb : {run, check}) {
    verb->add_option("pipeline", pipeline, "pipeline file (.ini)")->required()->check(path());
    verb->add_option("--trajectory", trajectory,
                     "trajectory file (.csv) instead of the pipeline's own")
        ->check(path());
  }
  add_run_options(*run, out, options);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? kSucceeded : kRefused;
    return false;
  }
  if (app.get_subcommands().empty()) {
    std::fprintf(stderr, "a verb is required: run, check or ports\n%s\n",
                 "Run with --help for more information.");
    exit_code = kRefused;
    return false;
  }
  copy(pipeline, options.pipeline);
  copy(trajectory, options.trajectory);
  copy(out, options.out);
  options.verb = *ports ? Verb::kPorts : *check ? Verb::kCheck : Verb::kRun;
  return true;
}

}  // namespace tactus
