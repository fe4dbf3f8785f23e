#include "boards/program/options.hpp"

#include <CLI/CLI.hpp>
#include <cstring>
#include <string>

namespace tactus {
namespace {

void copy(const std::string& from, char (&to)[512]) {
  std::strncpy(to, from.c_str(), sizeof to - 1);
}

CLI::Validator short_enough() {
  return CLI::Validator([](std::string& text) { return text.size() < 512 ? "" : "path too long"; },
                        "");
}

}  // namespace

bool parse_options(int argc, char** argv, const char* board, Options& options, int& exit_code) {
  std::string pipeline, trajectory, out;
  CLI::App app{std::string("Tactus on the board ") + board, "tactus"};
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 succeeded; 1 the run ended otherwise; 2 refused before the first cycle.");

  CLI::App* run = app.add_subcommand("run", "run a pipeline and write log, summary and figure");
  CLI::App* check = app.add_subcommand("check", "judge a pipeline and a trajectory; nothing moves");
  CLI::App* ports = app.add_subcommand("ports", "print every block, port, unit, setting and range");
  for (CLI::App* verb : {run, check}) {
    verb->add_option("pipeline", pipeline, "pipeline file (.ini)")
        ->required()
        ->check(short_enough());
    verb->add_option("--trajectory", trajectory,
                     "trajectory file (.csv) instead of the pipeline's own")
        ->check(short_enough());
  }
  run->add_option("--out", out, "folder to write into (default out/<pipeline>)")
      ->check(short_enough());
  run->add_option("--duration", options.duration_s, "s; default: until the trajectory has settled")
      ->check(CLI::Range(1e-3, 1e6));
  run->add_option("--seed", options.seed, "of the sensor noise");
  run->add_flag("!--no-figure", options.figure, "do not draw figure.png");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? kSucceeded : kRefused;
    return false;
  }
  copy(pipeline, options.pipeline);
  copy(trajectory, options.trajectory);
  copy(out, options.out);
  options.verb = *ports ? Verb::kPorts : *check ? Verb::kCheck : Verb::kRun;
  return true;
}

}  // namespace tactus
