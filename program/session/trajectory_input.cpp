#include "program/session/trajectory_input.hpp"

#include <cstdio>

#include "gateway/trajectory_csv.hpp"
#include "gateway/verdict_text.hpp"
#include "program/session/seekable.hpp"

namespace tactus {
namespace {

/// Calls `act` with the trajectory, whatever its space; returns `none` if there is no trajectory.
template <class Result, class Act>
Result with_trajectory(const TrajectoryInput& input, Result none, Act act) {
  if (const auto* joints = std::get_if<1>(&input.trajectory)) return act(**joints);
  if (const auto* poses = std::get_if<2>(&input.trajectory)) return act(**poses);
  return none;
}

bool refuse_frame(const Options& options, const char* key, const Value& name, const char* why) {
  std::fprintf(stderr, "%s: refused: [gateway] %s: '%s' %s\n", options.pipeline, key, name.c_str(),
               why);
  return false;
}

/// Finds the pose that the pipeline calls `name`; leaves `frame` null if no name is given. False:
/// no pose has that name.
bool find_frame(const Options& options, const PortTable& ports, const char* key, const Value& name,
                const Pose*& frame) {
  if (name.empty()) return true;
  const PortEntry* port = ports.find(name);
  if (port == nullptr) return refuse_frame(options, key, name, "is not an output of this pipeline");
  if (port->quantity != Quantity::kPose) return refuse_frame(options, key, name, "is not a pose");
  frame = static_cast<const Pose*>(port->value);
  return true;
}

bool set_terms(const Session& session, const Options& options, Trajectory<JointSpace>&) {
  const GatewaySection& gateway = session.gateway;
  constexpr const char* kWhy = "is given, but joint references have no frame";
  if (!gateway.motion_frame.empty())
    return refuse_frame(options, "motion_frame", gateway.motion_frame, kWhy);
  if (!gateway.wrench_frame.empty())
    return refuse_frame(options, "wrench_frame", gateway.wrench_frame, kWhy);
  return true;
}

bool set_terms(const Session& session, const Options& options, Trajectory<TaskSpace>& trajectory) {
  const PortTable& ports = session.pipeline.ports;
  const GatewaySection& gateway = session.gateway;
  TaskSpace::Header& header = trajectory.header;
  return find_frame(options, ports, "motion_frame", gateway.motion_frame, header.motion) &&
         find_frame(options, ports, "wrench_frame", gateway.wrench_frame, header.wrench);
}

template <class Space>
bool read_and_judge(const Session& session, const Options& options, ReferenceClient<Space>& client,
                    TrajectoryInput& input) {
  Trajectory<Space>* trajectory = client.acquire();
  const bool partial = session.gateway.partial_joints == PartialJoints::kHold;
  CsvError error;
  if (!set_terms(session, options, *trajectory)) return false;
  input.source = seekable(input.path);
  if (!read_trajectory(input.source.c_str(), partial, *trajectory, error)) {
    std::fprintf(stderr, "%s:%s%s\n", input.path.c_str(), error.line > 0 ? "" : " ",
                 error.message().c_str());
    return false;
  }
  trajectory->interpolation = session.gateway.interpolation;
  trajectory->exact = session.gateway.times == Times::kExact;
  input.start_s = session.gateway.start_s;
  if (input.start_s > 0.0) trajectory->start_s = input.start_s;
  input.trajectory = trajectory;
  const Verdict verdict = client.admit(*trajectory);
  if (!verdict.ok()) print_verdict(input, verdict);
  return verdict.ok();
}

}  // namespace

int TrajectoryInput::count() const {
  return with_trajectory(*this, 0, [](const auto& motion) { return motion.count; });
}

double TrajectoryInput::time_s(int waypoint) const {
  return with_trajectory(
      *this, 0.0, [waypoint](const auto& motion) { return motion.waypoints[waypoint].time_s; });
}

double TrajectoryInput::stretch() const {
  return with_trajectory(*this, 0.0, [](const auto& motion) { return motion.stretch; });
}

void print_verdict(const TrajectoryInput& input, const Verdict& verdict) {
  const VerdictAxes axes = input.trajectory.index() == 2 ? VerdictAxes::kTip : VerdictAxes::kJoints;
  const double time_s = verdict.waypoint >= 0 ? input.time_s(verdict.waypoint) : kInfinity;
  std::fprintf(stderr, "%s: refused: %s\n", input.path.c_str(),
               describe(verdict, axes, time_s).c_str());
}

bool read_input(const Session& session, const Options& options, TrajectoryInput& input) {
  if (options.trajectory[0] != '\0') {
    input.path = FilePath(options.trajectory);
  } else if (!session.gateway.trajectory.empty()) {
    input.path = relative_to(options.pipeline, session.gateway.trajectory);
  } else {
    return true;
  }
  if (session.pipeline.takes_poses)
    return read_and_judge(session, options, session.task_client, input);
  if (session.pipeline.takes_joints) return read_and_judge(session, options, session.client, input);
  std::fprintf(stderr, "%s: refused: the pipeline has no reference generator\n",
               input.path.c_str());
  return false;
}

bool send_input(Session& session, TrajectoryInput& input) {
  Verdict verdict;
  if (auto* joints = std::get_if<1>(&input.trajectory)) {
    verdict = session.client.send(**joints, input.id);
  } else if (auto* poses = std::get_if<2>(&input.trajectory)) {
    if (const Pose* frame = (*poses)->header.motion) input.motion_frame = *frame;
    verdict = session.task_client.send(**poses, input.id);
  }
  if (!verdict.ok()) print_verdict(input, verdict);
  return verdict.ok();
}

bool poll_report(Session& session, const TrajectoryInput& input, Report& report) {
  return input.trajectory.index() == 2 ? session.task_client.poll(report)
                                       : session.client.poll(report);
}

}  // namespace tactus
