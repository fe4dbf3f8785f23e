// Shipped pipelines in virtual time whose parameters change while they run.
#pragma once

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "gateway/server/parameter_texts.hpp"
#include "tests/pipeline/pipeline_bench.hpp"
#include "tests/support/random.hpp"

namespace tactus {

/// One run of a pipeline of this robot, and the book of its parameters.
struct TuningBench {
  PipelineBench bench;
  std::unique_ptr<ParameterBook> book;
  LoadError why;

  void start(const std::string& name) {
    const bool joints = name.find("_jrg_") != std::string::npos;
    bench.start(name, "", "", joints ? five_waypoints() : "");
    book = std::make_unique<ParameterBook>(bench.pipeline);
  }
  Status prepare(const std::vector<std::array<std::string, 3>>& set) {
    std::vector<ParameterText> texts;
    for (const auto& words : set) texts.push_back({words[0], words[1], words[2]});
    return book->prepare(texts.data(), static_cast<int>(texts.size()), why);
  }
  /// The whole way of a set, in the place of server and cycle.
  TuningVerdict change(const std::vector<std::array<std::string, 3>>& set) {
    if (prepare(set) != Status::kOk) return {why.status};
    const TuningVerdict verdict = bench.pipeline.retune(book->tuning(), true);
    if (verdict.status == Status::kOk)
      book->commit();
    else
      book->drop();
    return verdict;
  }
  /// The tunable parameters, as the file has them, with all numbers times `factor`; `share` of
  /// them, at random.
  std::vector<std::array<std::string, 3>> scaled(Random& random, double share, double lowest,
                                                 double highest) const {
    std::vector<std::array<std::string, 3>> set;
    PresentParameter one;
    for (int i = 0; parameter_at(*book, ParameterBook::Copy::kOfFile, i, one); ++i) {
      if (!one.tunable || random.uniform(0.0, 1.0) >= share) continue;
      const double factor = lowest * std::pow(highest / lowest, random.uniform(0.0, 1.0));
      std::string text;
      const char* at = one.value.c_str();
      for (char* end = nullptr;; at = end) {
        const double value = std::strtod(at, &end);
        if (end == at) break;
        char number[32];
        std::snprintf(number, sizeof number, "%.12g ", value * factor);
        text += number;
      }
      set.push_back({std::string(one.section), one.key, text});
    }
    return set;
  }
  const JointVector& command() const {
    const RobotSection& robot = bench.pipeline.robot;
    return robot.tau_c.wired() ? *robot.tau_c : robot.dq_c.wired() ? *robot.dq_c : *robot.q_c;
  }
  bool gives_torques() const { return bench.pipeline.robot.tau_c.wired(); }
  JointVector position() const { return bench.hal.arm().q(); }
};

/// The shipped pipelines of this robot that are tried.
inline std::vector<std::string> tuned_pipelines() {
  std::vector<std::string> names;
  for (const char* rest : {"_jrg_pdgc", "_jrg_pid", "_trg_cpc", "_trg_ac_cpc", "_trg_ac_cpc_pid"}) {
    const std::string name = of_this_robot(rest);
    if (std::ifstream("pipelines/" + name + ".ini").good()) names.push_back(name);
  }
  return names;
}

}  // namespace tactus
