#include "program/session/trajectory_input.hpp"

#include <cstdio>

#include "gateway/fnv1a.hpp"
#include "gateway/verdict_text.hpp"

namespace tactus {
namespace {

/// Calls `act` with the stream of a file, whatever its space; returns `none` if there is no file.
template <class Result, class Input, class Act>
Result with_stream(Input& input, Result none, Act act) {
  if (auto* joints = std::get_if<1>(&input.file)) return act(*joints);
  if (auto* poses = std::get_if<2>(&input.file)) return act(*poses);
  return none;
}

bool refuse_frame(const Options& options, const char* key, const Value& name, const char* why) {
  std::fprintf(stderr, "%s: refused: [gateway] %s: '%s' %s\n", options.pipeline, key, name.c_str(),
               why);
  return false;
}

bool refuse_wrap(const Options& options, const char* why) {
  std::fprintf(stderr, "%s: refused: [gateway] wrap = nearest: %s; leave it out\n",
               options.pipeline, why);
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

/// Looks where an arm with joints without end is, so that a file is compared with it, and has the
/// file's angles taken by `wrap`. False: prints the reason to stderr.
bool take_angles(const Session& session, const Options& options,
                 TrajectoryStream<JointSpace>& stream) {
  const Wrap wrap = session.gateway.wrap;
  if constexpr (Robot::kContinuousJoints == 0) {
    return wrap == Wrap::kAsGiven || refuse_wrap(options, "every joint of this robot has stops");
  } else {
    RobotState state;
    const Status status = look(session.hal, session.pipeline.robot.mode(), state);
    if (status == Status::kOk)
      stream.take_angles(wrap, state.q);
    else
      print_stop(options.pipeline, "refused", status, session.hal.trouble());
    return status == Status::kOk;
  }
}

bool take_angles(const Session& session, const Options& options, TrajectoryStream<TaskSpace>&) {
  return session.gateway.wrap == Wrap::kAsGiven || refuse_wrap(options, "the pipeline takes poses");
}

/// Prints why a file was refused. Returns false.
template <class Space>
bool print_refusal(TrajectoryInput& input, const TrajectoryStream<Space>& stream) {
  const StreamRefusal& refusal = stream.refusal();
  if (refusal.row.reason.empty()) {
    print_verdict(input, refusal.verdict, stream.longer() ? refusal.line : 0);
    return false;
  }
  const auto row = refusal.row.message();
  std::fprintf(stderr, "%s:%s%s\n", input.path.c_str(), refusal.row.line > 0 ? "" : " ",
               row.c_str());
  input.refusal = Reason(refusal.row.line > 0 ? "line " : "");
  input.refusal << row;
  return false;
}

template <class Space>
bool read_and_judge(const Session& session, const Options& options, ReferenceClient<Space>& client,
                    TrajectoryInput& input) {
  Trajectory<Space>* trajectory = client.acquire();
  const bool partial = session.gateway.partial_joints == PartialJoints::kHold;
  if (!set_terms(session, options, *trajectory)) return false;
  auto& stream = input.file.template emplace<TrajectoryStream<Space>>();
  if (!take_angles(session, options, stream)) return false;
  if (!stream.open(input.path.c_str(), partial, fnv1a(session.text), *trajectory))
    return print_refusal(input, stream);
  trajectory->interpolation = session.gateway.interpolation;
  trajectory->exact = session.gateway.times == Times::kExact;
  input.start_s = session.gateway.start_s;
  if (input.start_s > 0.0) trajectory->start_s = input.start_s;
  trajectory->joinable = false;
  input.trajectory = trajectory;
  const SmoothingTolerance tolerance = {session.gateway.smoothing_rad, session.gateway.smoothing_m};
  return stream.judge(client.settings(), tolerance) || print_refusal(input, stream);
}

}  // namespace

bool TrajectoryInput::longer() const {
  return with_stream(*this, false, [](const auto& stream) { return stream.longer(); });
}

bool TrajectoryInput::whole_known() const {
  return with_stream(*this, true, [](const auto& stream) { return stream.whole_known(); });
}

std::int64_t TrajectoryInput::count() const {
  return with_stream(*this, std::int64_t{0}, [](const auto& stream) { return stream.count(); });
}

double TrajectoryInput::time_s(int waypoint) const {
  return with_stream(*this, 0.0, [=](const auto& stream) { return stream.time_s(waypoint); });
}

double TrajectoryInput::stretch() const {
  return with_stream(*this, 0.0, [](const auto& stream) { return stream.stretch(); });
}

double TrajectoryInput::longer_s() const {
  return with_stream(*this, 0.0, [](const auto& stream) { return stream.longer_s(); });
}

Smoothing TrajectoryInput::smoothing() const {
  return with_stream(*this, Smoothing(), [](const auto& stream) { return stream.smoothing(); });
}

SmoothingTolerance TrajectoryInput::moved() const {
  return with_stream(*this, SmoothingTolerance(),
                     [](const auto& stream) { return stream.moved(); });
}

double TrajectoryInput::end_s() const {
  return with_stream(*this, 0.0, [](const auto& stream) { return stream.end_s(); });
}

std::uint64_t TrajectoryInput::hash(std::uint64_t none) const {
  return with_stream(*this, none, [](const auto& stream) { return stream.hash(); });
}

void print_verdict(TrajectoryInput& input, const Verdict& verdict, int line) {
  const VerdictAxes axes = input.trajectory.index() == 2 ? VerdictAxes::kTip : VerdictAxes::kJoints;
  const double time_s = verdict.waypoint >= 0 ? input.time_s(verdict.waypoint) : kInfinity;
  FilePath place = input.path;
  if (line > 0) place << ":" << line;
  const bool rough = of_derivatives(verdict.status) && input.smoothing().tolerance.allows();
  const bool in_m =
      axes == VerdictAxes::kTip || (verdict.axis >= 0 && is_prismatic<Robot>(verdict.axis));
  const char* const key = in_m ? "smoothing_m" : "smoothing_rad";
  // Waypoints have a place; the time of none of them is that of the start.
  const bool late = verdict.status == Status::kReferenceTime && verdict.waypoint < 0;
  const TurnStep* const none = nullptr;
  const TurnStep* const step =
      with_stream(input, none, [&](const auto& stream) { return stream.turns().explain(verdict); });
  Reason why(late ? "[gateway] start_s: " : "");
  why << describe(verdict, axes, time_s);
  if (step != nullptr) {
    why << remedy(*step);
  } else {
    why << remedy(verdict);
    if (rough) why << ", or if it is noise a larger [gateway] " << key;
  }
  if (late) why << "; it had passed when the trajectory was ready: give a later one";
  std::fprintf(stderr, "%s: refused: %s\n", place.c_str(), why.c_str());
  input.refused = verdict;
  input.refusal = Reason();
  if (line > 0) input.refusal << "line " << line << ": ";
  input.refusal << why;
}

void print_long_way(const TrajectoryInput& input) {
  const TurnStep* const none = nullptr;
  const TurnStep* const step =
      with_stream(input, none, [](const auto& stream) { return stream.turns().longest(); });
  if (step != nullptr)
    std::fprintf(stderr, "%s: warning: %s\n", input.path.c_str(), describe(*step).c_str());
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

int refusal_code(const TrajectoryInput& input) {
  return input.refused.ok() ? static_cast<int>(kRefused) : static_cast<int>(input.refused.status);
}

bool judge_rest(const Session& session, TrajectoryInput& input) {
  if (auto* joints = std::get_if<1>(&input.file))
    return joints->judge_rest(session.client.settings()) || print_refusal(input, *joints);
  if (auto* poses = std::get_if<2>(&input.file))
    return poses->judge_rest(session.task_client.settings()) || print_refusal(input, *poses);
  return true;
}

bool poll_report(Session& session, TrajectoryInput& input, Report& report) {
  const bool polled = input.trajectory.index() == 2 ? session.task_client.poll(report)
                                                    : session.client.poll(report);
  if (!polled) return false;
  const bool ended = report.id == input.id && is_final(report.outcome);
  with_stream(input, 0, [&](auto& stream) {
    ended ? stream.end() : stream.answered(report);
    return 0;
  });
  return true;
}

FeedResult feed_input(Session& session, TrajectoryInput& input, int wait_ms) {
  const auto feed = [&](auto& stream, auto& client) {
    const FeedResult fed = stream.feed(client, wait_ms);
    if (fed == FeedResult::kRefused) print_refusal(input, stream);
    return fed;
  };
  if (auto* joints = std::get_if<1>(&input.file)) return feed(*joints, session.client);
  if (auto* poses = std::get_if<2>(&input.file)) return feed(*poses, session.task_client);
  return FeedResult::kIdle;
}

}  // namespace tactus
