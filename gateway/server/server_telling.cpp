// Server: what clients are told.
#include "gateway/fnv1a.hpp"
#include "gateway/server/message_points.hpp"
#include "gateway/server/server.hpp"
#include "gateway/verdict_text.hpp"
#include "kernel/cycle/ladder.hpp"

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
  const JointLimits& limits = pipeline.guard.limits;
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
  welcome.epoch = epoch_;
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
void Server::report(const Told& told, std::int64_t now_ns) {
  Connection& to = at(told.to.slot);
  if (!to.there() || to.session != told.to.session) return;
  told_ = tactus_ToClient_init_zero;
  told_.which_message = tactus_ToClient_report_tag;
  tactus_Report& report = told_.message.report;
  report.number = told.to.number;
  report.outcome = outcome_of(told.outcome);
  report.status = static_cast<std::uint32_t>(told.verdict.status);
  set_text(report.text, reply(told.verdict).text);
  report.time_s = told.time_s;
  report.stretch = told.stretch;
  report.server_ns = now_ns;
  if (!put(to))
    cut(told.to.slot, Status::kClientSlow, "reports were not read; read what is sent", now_ns);
}

void Server::take_reports(std::int64_t now_ns) {
  if (!takes_references()) return;
  with_intake([&](auto& intake) {
    Told told;
    while (intake.work(told)) report(told, now_ns);
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
      const bool good = result.status == Status::kOk;
      report({order.from,
              good ? Outcome::kExecuted : Outcome::kRefused,
              {result.status},
              newest_.time_s,
              0.0},
             now_ns);
      order = {};
    }
  }
}

/// The newest of the cycles counts. A brake of the executive voids what is on its way.
void Server::take_snapshots(std::int64_t now_ns) {
  CycleSnapshot snapshot;
  while (mail_.snapshots.take(snapshot)) {
    const auto from = static_cast<Rung>(newest_.rung), to = static_cast<Rung>(snapshot.rung);
    const bool changed = seen_ && from != to;
    newest_ = snapshot;
    seen_ = true;
    clock_.set(snapshot.stamp_ns, snapshot.time_s);
    if (!changed) continue;
    if (refuses(to) && !refuses(from)) ++epoch_;
    Message text(name(to));
    if (snapshot.status != Status::kOk) text << ": " << describe(snapshot.status);
    tell_events("rung", snapshot.status, text, -1, now_ns);
  }
}

void Server::tell_state(Connection& to, std::int64_t) {
  if (to.out.free() < kReserveBytes) {
    ++to.lost;
    return;
  }
  told_ = tactus_ToClient_init_zero;
  told_.which_message = tactus_ToClient_state_tag;
  tactus_State& state = told_.message.state;
  state.server_ns = newest_.stamp_ns;
  state.client_ns = to.client_ns;
  state.client_received_ns = to.received_ns;
  state.cycle = newest_.cycle;
  state.rung = newest_.rung;
  state.status = static_cast<std::uint32_t>(newest_.status);
  state.phase = newest_.phase;
  state.epoch = epoch_;
  if (lease_.owner() != Lease::kNobody) set_text(state.owner, at(lease_.owner()).name);
  state.override = newest_.override;
  state.speed_scaling = newest_.speed_scaling;
  set_numbers(state.q, state.q_count, newest_.q.data(), kDof);
  set_numbers(state.dq, state.dq_count, newest_.dq.data(), kDof);
  set_numbers(state.tau, state.tau_count, newest_.tau.data(), kDof);
  if (newest_.has & CycleSnapshot::kJointReference) {
    set_numbers(state.q_d, state.q_d_count, newest_.q_d.data(), kDof);
    set_numbers(state.dq_d, state.dq_d_count, newest_.dq_d.data(), kDof);
  }
  if (newest_.has & CycleSnapshot::kPose) {
    write_pose(newest_.pose, state.pose);
    state.pose_count = 7;
  }
  if (newest_.has & CycleSnapshot::kPoseReference) {
    write_pose(newest_.pose_d, state.pose_d);
    state.pose_d_count = 7;
  }
  if (newest_.has & CycleSnapshot::kWrench)
    set_numbers(state.wrench, state.wrench_count, newest_.wrench.data(), 6);
  state.slips = newest_.slips;
  state.overruns = newest_.overruns;
  state.lost = newest_.lost + to.lost;
  state.time_s = newest_.time_s;
  static_cast<void>(put(to));
}

void Server::take_feedback(std::int64_t now_ns) {
  if (!takes_references()) return;
  with_intake([&](auto& intake) {
    Feedback<typename std::decay_t<decltype(intake)>::Space> feedback;
    while (intake.poll_feedback(feedback)) tell_feedback(feedback, intake, now_ns);
  });
}

template <class Space>
void Server::tell_feedback(const Feedback<Space>& feedback, ReferenceIntake<Space>& from,
                           std::int64_t now_ns) {
  lost_feedback_ += feedback.lost;
  for (Connection& to : connections_) {
    if (to.state != Connection::State::kOpen || !to.feedback.due(now_ns) ||
        to.out.free() < kReserveBytes)
      continue;
    told_ = tactus_ToClient_init_zero;
    told_.which_message = tactus_ToClient_feedback_tag;
    tactus_Feedback& message = told_.message.feedback;
    message.number = from.number_of(feedback.id, to.session);
    message.time_s = feedback.time_s;
    message.lost = lost_feedback_;
    if constexpr (std::is_same_v<Space, TaskSpace>) {
      message.has_task_desired = message.has_task_actual = true;
      write_point(feedback.desired, message.task_desired);
      write_point(feedback.actual, message.task_actual);
    } else {
      message.has_joint_desired = message.has_joint_actual = true;
      write_point(feedback.desired, message.joint_desired);
      write_point(feedback.actual, message.joint_actual);
    }
    static_cast<void>(put(to));
  }
}

}  // namespace tactus
