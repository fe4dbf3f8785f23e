// The bench of the loader's tests: a pipeline file with every kind of section and block, and the
// objects that a board with a simulated robot loads it into.
#pragma once

#include <new>

#include "kernel/load/loader.hpp"
#include "program/sim/sim_sections.hpp"

namespace tactus {

inline constexpr std::string_view kValid =
    "# Arm -> PD -> arm\n"
    "[robot]\nname = fer\nperiod_us = 2000\ntau_c = stiff.tau\ntool_tip = 0.1 0 -0.2\n"
    "[guard]\nmax_velocity = 1\nmax_torque = 80 70 60 50 10 9 8\nposition_margin = 0.1\n"
    "[plant]\ndelay_cycles = 3\nfriction = 0\n"
    "[gateway]\ninterpolation = quintic\ntrajectory = a b.csv\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[soft]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 10\nkd = 1 2 3 4 5 6 7\n"
    "[stiff]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = soft.tau\n"
    "kp = 100\nkd = 1e1\n"
    "[executive]\nmax_slip = 7\nbudget_us = 1500\nmax_overruns = 2\noverrun_window = 50\n"
    "clean_cycles = 300\nstop_ms = 700\nrest_ms = 50\nrest_velocity = 0.02\n"
    "[recorder]\ndivisor = 5\noffset = 3\nbudget_us = 400\nsignals = robot.q stiff.tau "
    "model.x\ntracking = jrg.q_d robot.q\n";

inline constexpr Capabilities kTorqueRobot = {false, false, true, 100, 10000};

/// The objects that a board with a simulated robot loads a file into.
struct LoaderBench {
  ChannelMemory<JointSpace> channel;
  RoomyPipeline pipeline;
  SimSections board;
  LoadError error;

  Status load(std::string_view text, const Capabilities& offered = kTorqueRobot) {
    channel.settings = {};
    new (&pipeline) RoomyPipeline;
    board = SimSections();
    return Loader({&channel}, offered, board).load(text, pipeline, error);
  }
  const JointVector& joints(const char* port) const {
    return *static_cast<const JointVector*>(pipeline.ports.find(port)->value);
  }
};

/// Returns `text` with its first `from` replaced, in memory of its own.
inline std::string_view edit(std::string_view text, std::string_view from, std::string_view to) {
  static std::array<char, 4096> edited;
  const std::size_t at = text.find(from);
  if (at == std::string_view::npos) return {};
  std::size_t size = 0;
  for (const std::string_view part : {text.substr(0, at), to, text.substr(at + from.size())})
    size = append_text(edited.data(), size, edited.size() - 1, part);
  return {edited.data(), size};
}

/// The ready pose with every joint moved.
inline RobotState state_at(double q, double dq) {
  RobotState state;
  state.q = ready_pose() + JointVector::Constant(q);
  state.dq = JointVector::Constant(dq);
  return state;
}

}  // namespace tactus
