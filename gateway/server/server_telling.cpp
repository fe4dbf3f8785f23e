// Server: what clients are told.
#include "gateway/fnv1a.hpp"
#include "gateway/server/message_points.hpp"
#include "gateway/server/server.hpp"
#include "gateway/verdict_text.hpp"

namespace tactus {
namespace {

constexpr tactus_Report_Outcome outcome_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kScheduled: return tactus_Report_Outcome_SCHEDULED;
    case Outcome::kStarted: return tactus_Report_Outcome_STARTED;
    case Outcome::kSucceeded: return tactus_Report_Outcome_SUCCEEDED;
    case Outcome::kPreempted: return tactus_Report_Outcome_PREEMPTED;
    case Outcome::kAborted: return tactus_Report_Outcome_ABORTED;
    case Outcome::kCanceled: return tactus_Report_Outcome_CANCELED;
    case Outcome::kExecuted: return tactus_Report_Outcome_EXECUTED;
    case Outcome::kSuperseded: return tactus_Report_Outcome_SUPERSEDED;
    case Outcome::kRefused: return tactus_Report_Outcome_REFUSED;
    case Outcome::kStarved: return tactus_Report_Outcome_STARVED;
    case Outcome::kReleased: break;
  }
  return tactus_Report_Outcome_UNKNOWN;
}

void write_joints(const Pipeline& pipeline, tactus_Welcome& to) {
  const JointLimits limits = pipeline.guard.references();
  to.joints_count = kDof;
  for (int i = 0; i < kDof; ++i) {
    tactus_Joint& joint = to.joints[i];
    set_text(joint.name, Robot::kJointNames[static_cast<std::size_t>(i)]);
    joint.min_rad = limits.q_min[i];
    joint.max_rad = limits.q_max[i];
    joint.velocity = limits.dq_max[i];
    joint.acceleration = limits.ddq_max[i];
    joint.jerk = limits.dddq_max[i];
    joint.effort = limits.tau_max[i];
    joint.continuous = (Robot::kContinuousJoints >> i & 1U) != 0;
  }
}

/// Writes the number that a verdict is about; without one, nothing.
void write_finding(const Verdict& verdict, bool& has, tactus_Finding& to) {
  has = verdict.waypoint >= 0 || verdict.axis >= 0 || verdict.value != 0.0 || verdict.limit != 0.0;
  to = {verdict.waypoint, verdict.axis, verdict.value, verdict.limit};
}

/// Writes what digital outputs there are, and their names if they all have one.
void write_outputs(const ServerSetup& setup, tactus_Welcome& to) {
  to.outputs = setup.loaded->robot.offered;
  for (std::size_t i = 0; i < setup.output_names.size(); ++i) {
    if ((to.outputs >> i & 1u) == 0) continue;
    if (setup.output_names[i] == nullptr) {
      to.output_names_count = 0;
      return;
    }
    set_text(to.output_names[to.output_names_count++], setup.output_names[i]);
  }
}

tactus_TaskLimits task_limits(const TaskLimits& limits) {
  return {limits.v_max, limits.a_max,     limits.j_max,
          limits.w_max, limits.alpha_max, limits.dalpha_max};
}

}  // namespace

/// Sends what is in told_. False: there is no space.
bool Server::put(Connection& to) {
  const std::size_t size = encode(told_, bytes_);
  return size > 0 && to.out.put(bytes_.data(), size);
}

/// There is always space: messages are taken while the reserve is free.
void Server::answer(Connection& to, std::uint32_t number, const Reply& reply, std::int64_t now_ns) {
  told_ = tactus_ToClient_init_zero;
  told_.which_message = tactus_ToClient_answer_tag;
  tactus_Answer& answer = told_.message.answer;
  answer.number = number;
  answer.status = static_cast<std::uint32_t>(reply.status);
  set_text(answer.text, reply.text);
  answer.client_ns = to.client_ns;
  answer.server_ns = now_ns;
  answer.received_ns = to.received_ns;
  answer.epoch = epoch_;
  answer.stops = stops_.newest();
  write_finding(reply.verdict, answer.has_finding, answer.finding);
  static_cast<void>(put(to));
}

void Server::welcome(Connection& to, std::uint32_t number, std::int64_t now_ns) {
  const Pipeline& pipeline = *setup_.loaded;
  told_ = tactus_ToClient_init_zero;
  told_.which_message = tactus_ToClient_welcome_tag;
  tactus_Welcome& welcome = told_.message.welcome;
  welcome.number = number;
  welcome.version = tactus_Version_VERSION_PRESENT;
  set_text(welcome.board, setup_.board);
  set_text(welcome.robot, Robot::kName);
  set_text(welcome.pipeline, setup_.pipeline);
  welcome.configuration = setup_.configuration;
  welcome.session = to.session;
  welcome.server_ns = now_ns;
  welcome.client_ns = to.client_ns;
  welcome.period_s = pipeline.robot.period_s();
  write_joints(pipeline, welcome);
  welcome.has_task = pipeline.takes_poses;
  welcome.task = task_limits(pipeline.task_limits);
  welcome.takes_poses = pipeline.takes_poses;
  welcome.takes_joints = pipeline.takes_joints && !pipeline.takes_poses;
  welcome.window =
      static_cast<std::uint32_t>(pipeline.takes_poses ? setup_.task_window : setup_.joint_window);
  welcome.longest_part = kLongestPart;
  if (takes_references()) {
    welcome.longest_chunk = kChunkTargets;
    welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_CHUNKS;
    welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_VELOCITIES;
    if (puts_out()) welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_OUTPUTS;
  }
  if (setup_.parameters != nullptr)
    welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_PARAMETERS;
  if (wraps()) welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_WRAP;
  if (front_end_ >= 0) welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_TARE;
  welcome.parameter_sets = parameter_sets_;
  write_outputs(setup_, welcome);
  welcome.epoch = epoch_;
  welcome.stops = stops_.newest();
  set_text(welcome.motion_frame, setup_.motion_frame);
  set_text(welcome.wrench_frame, setup_.wrench_frame);
  static_cast<void>(put(to));
}

/// Events are lost by a client whose reserve is in use.
void Server::tell_events(std::string_view name, Status status, std::string_view text, int except,
                         std::int64_t now_ns) {
  told_ = tactus_ToClient_init_zero;
  told_.which_message = tactus_ToClient_event_tag;
  tactus_Event& event = told_.message.event;
  event.server_ns = now_ns;
  set_text(event.name, name);
  event.status = static_cast<std::uint32_t>(status);
  set_text(event.text, text);
  for (int slot = 0; slot < kMostClients; ++slot) {
    Connection& to = at(slot);
    const bool wanted = to.state == Connection::State::kOpen && to.events && slot != except;
    if (wanted && to.out.free() >= kReserveBytes) static_cast<void>(put(to));
  }
}

/// A client that does not read its reports is cut: none may be lost.
void Server::report(const Told& told, std::string_view text, std::int64_t now_ns,
                    const Vector6* zero) {
  Connection& to = at(told.to.slot);
  if (!to.there() || to.session != told.to.session) return;
  told_ = tactus_ToClient_init_zero;
  told_.which_message = tactus_ToClient_report_tag;
  tactus_Report& report = told_.message.report;
  report.number = told.to.number;
  report.outcome = outcome_of(told.outcome);
  report.status = static_cast<std::uint32_t>(told.verdict.status);
  set_text(report.text, text);
  report.time_s = told.time_s;
  report.stretch = told.stretch;
  report.server_ns = now_ns;
  write_finding(told.verdict, report.has_finding, report.finding);
  if (zero != nullptr) set_numbers(report.zero, report.zero_count, zero->data(), 6);
  if (!put(to))
    cut(told.to.slot, Status::kClientSlow, "reports were not read; read what is sent", now_ns);
}

/// Everybody hears of a control. The log has those of clients that did not own the motion.
void Server::tell_deed(const Told& told, std::int64_t now_ns) {
  const Connection& by = at(told.to.slot);
  if (!by.there() || by.session != told.to.session) return;
  Message text(by.name);
  text << told.deed.what;
  if (told.deed.percent >= 0.0) text << " to " << told.deed.percent << " %";
  if (setup_.log != nullptr && !told.deed.by_owner) setup_.log(text.c_str());
  tell_events("control", Status::kOk, text, -1, now_ns);
}

/// A client whose chunks have all been late for a second is named, with the delay of the newest.
void Server::tell_late(const Told& told, std::int64_t now_ns) {
  Connection& by = at(told.to.slot);
  if (!by.there() || by.session != told.to.session) return;
  if (told.outcome == Outcome::kExecuted) by.late = 0;
  if (told.verdict.status != Status::kChunkLate) return;
  if (by.late++ == 0) by.late_ns = now_ns;
  if (now_ns - by.late_ns < kSecond_ns) return;
  Message text(by.name);
  text << ": the last " << by.late << " chunks came too late, the newest by " << told.verdict.value
       << " s; send sooner, or targets farther ahead";
  by.late = 0;
  if (setup_.log != nullptr) setup_.log(text.c_str());
  tell_events("late", Status::kChunkLate, text, -1, now_ns);
}

/// A refusal is told with what its joint's turns say of it, or else with the remedy of its status;
/// what is accepted, with their warning.
Message Server::text_about(const Told& told, const Message& turns) const {
  if (turns.empty() || told.verdict.ok()) return turns.empty() ? reply(told.verdict).text : turns;
  Message text = describe(told.verdict, VerdictAxes::kJoints, kInfinity);
  return text << turns;
}

void Server::take_reports(std::int64_t now_ns) {
  if (!takes_references()) return;
  with_intake([&](auto& intake) {
    Told told;
    while (intake.work(told)) {
      report(told, text_about(told, intake.about_turns(told)), now_ns);
      if (told.deed.what != nullptr) tell_deed(told, now_ns);
      tell_late(told, now_ns);
    }
    Granted granted;
    if (!intake.grant(granted)) return;
    told_ = tactus_ToClient_init_zero;
    told_.which_message = tactus_ToClient_credit_tag;
    told_.message.credit.waypoints = static_cast<std::uint32_t>(granted.waypoints);
    if (!put(at(granted.to.slot)))
      cut(granted.to.slot, Status::kClientSlow, "credit was not read; read what is sent", now_ns);
  });
}

void Server::take_results(std::int64_t now_ns) {
  OrderResult result;
  while (mail_.results.take(result)) {
    for (Order& order : orders_) {
      if (order.id == 0 || order.id != result.id) continue;
      const Verdict& verdict = result.verdict;
      const Outcome outcome = verdict.ok() ? Outcome::kExecuted : Outcome::kRefused;
      if (order.what == CycleOrder::kTare)
        tell_tare(order, result, now_ns);
      else
        report({order.from, outcome, verdict, newest_.time_s, 0.0}, reply(verdict).text, now_ns);
      order = {};
    }
  }
}

}  // namespace tactus
