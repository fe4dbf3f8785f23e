#include "gateway/server/state_publisher.hpp"

#include <type_traits>

#include "gateway/server/drive_text.hpp"
#include "gateway/server/message_fields.hpp"
#include "kernel/cycle/ladder.hpp"

namespace tactus {

void StatePublisher::take_snapshots(std::int64_t now_ns) {
  CycleSnapshot snapshot;
  while (mailboxes_.snapshots.take(snapshot)) {
    const auto from = static_cast<Rung>(newest_.rung), to = static_cast<Rung>(snapshot.rung);
    const bool changed = seen_ && from != to;
    if (seen_ && snapshot.faults != newest_.faults) stops_.add(StopCount::kNoSession);
    newest_ = snapshot;
    seen_ = true;
    clock_.set(snapshot.stamp_ns, snapshot.time_s);
    if (!changed) continue;
    if (refuses(to) && !refuses(from)) references_.begin_epoch();
    Message text(name(to));
    if (snapshot.status != Status::kOk)
      text << ": " << describe(snapshot.fault.verdict, snapshot.fault.axes);
    if (snapshot.first != nullptr) text << ": " << snapshot.first << " with " << snapshot.second;
    clients_.send_event("rung", snapshot.status, text, now_ns);
  }
}

void StatePublisher::send_drive_events(std::int64_t now_ns) {
  if (events_ == nullptr) return;
  const std::uint32_t lost = events_->lost();
  if (read_events_ < lost) read_events_ = lost;
  Event event;
  for (std::uint32_t i = 0; i < EventLog::kCapacity && events_->read(read_events_, event); ++i) {
    ++read_events_;
    const Message text = describe_drive(*hal_, event);
    if (text.empty()) continue;
    clients_.announce("drive", event.status, text.c_str(), now_ns);
  }
}

JointVector StatePublisher::present_joints() const {
  if (!seen_) return JointVector::Constant(kInfinity);
  return (newest_.has & CycleSnapshot::kJointReference) != 0 ? newest_.q_d : newest_.q;
}

void StatePublisher::send_states(const Lease& lease, std::uint32_t dropped, std::int64_t now_ns) {
  for (Connection& to : clients_)
    if (to.state == Connection::State::kOpen && seen_ && to.states.due(now_ns))
      send_state(to, lease, dropped);
}

void StatePublisher::send_state(Connection& to, const Lease& lease, std::uint32_t dropped) {
  if (to.out.free() < kReserveBytes) {
    ++to.lost;
    return;
  }
  tactus_State& state = clients_.begin_message(tactus_ToClient_state_tag).message.state;
  state.server_ns = newest_.stamp_ns;
  state.client_ns = to.client_ns;
  state.client_received_ns = to.received_ns;
  state.cycle = newest_.cycle;
  state.rung = newest_.rung;
  state.status = static_cast<std::uint32_t>(newest_.status);
  state.phase = newest_.phase;
  state.epoch = references_.epoch();
  state.stops = stops_.newest();
  if (lease.owner() != Lease::kNoOwner) set_text(state.owner, clients_.at(lease.owner()).name);
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
  state.has_stream = true;
  references_.with_intake([&](const auto& intake) {
    const StreamState& stream = intake.stream();
    state.margin_s = stream.margin_s;
    state.stream = {intake.chunks(), stream.late, stream.dropped + dropped,
                    stream.trimmed,  stream.seam, stream.starved,
                    stream.shaped};
  });
  state.slips = newest_.slips;
  state.overruns = newest_.overruns;
  state.lost = newest_.lost + to.lost;
  state.time_s = newest_.time_s;
  state.outputs = newest_.outputs.value;
  state.outputs_mask = newest_.outputs.mask;
  static_cast<void>(clients_.put(to));
}

void StatePublisher::send_feedback(std::int64_t now_ns) {
  if (!references_.takes_any()) return;
  references_.with_intake([&](auto& intake) {
    Feedback<typename std::decay_t<decltype(intake)>::Space> feedback;
    while (intake.poll_feedback(feedback)) send_feedback(feedback, intake, now_ns);
  });
}

template <class Space>
void StatePublisher::send_feedback(const Feedback<Space>& feedback, ReferenceIntake<Space>& from,
                                   std::int64_t now_ns) {
  lost_feedback_ += feedback.lost;
  for (Connection& to : clients_) {
    if (to.state != Connection::State::kOpen || !to.feedback.due(now_ns) ||
        to.out.free() < kReserveBytes)
      continue;
    tactus_Feedback& message =
        clients_.begin_message(tactus_ToClient_feedback_tag).message.feedback;
    message.number = from.number_of(feedback.id, to.session);
    message.time_s = feedback.time_s;
    message.lost = lost_feedback_;
    message.path_s = feedback.path_s;
    message.path_end_s = feedback.path_end_s;
    if constexpr (std::is_same_v<Space, TaskSpace>) {
      message.has_task_desired = message.has_task_actual = true;
      write_point(feedback.desired, message.task_desired);
      write_point(feedback.actual, message.task_actual);
    } else {
      message.has_joint_desired = message.has_joint_actual = true;
      write_point(feedback.desired, message.joint_desired);
      write_point(feedback.actual, message.joint_actual);
    }
    static_cast<void>(clients_.put(to));
  }
}

}  // namespace tactus
