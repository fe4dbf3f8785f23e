#include "gateway/page/page_events.hpp"

#include "gateway/page/request_check.hpp"
#include "gateway/verdict_text.hpp"
#include "kernel/cycle/rung.hpp"
#include "kernel/reference/motion/motion_phase.hpp"

namespace tactus {
namespace {

constexpr std::size_t kLongestEvent = 16 << 10;

template <class E>
const char* word(std::uint32_t value) {
  return value < kNames<E>.size() ? kNames<E>[value] : "unknown";
}

const char* outcome_word(tactus_Report_Outcome outcome) {
  switch (outcome) {
    case tactus_Report_Outcome_SCHEDULED: return "scheduled";
    case tactus_Report_Outcome_STARTED: return "started";
    case tactus_Report_Outcome_STARVED: return "starved";
    case tactus_Report_Outcome_SUCCEEDED: return "succeeded";
    case tactus_Report_Outcome_PREEMPTED: return "preempted";
    case tactus_Report_Outcome_ABORTED: return "aborted";
    case tactus_Report_Outcome_CANCELED: return "canceled";
    case tactus_Report_Outcome_EXECUTED: return "executed";
    case tactus_Report_Outcome_SUPERSEDED: return "superseded";
    case tactus_Report_Outcome_REFUSED: return "refused";
    default: return "unknown";
  }
}

void write_time(std::int64_t server_ns, const PageTime& time, Json& to) {
  to.number(static_cast<double>(server_ns - time.begin_ns) * 1e-9, "since_s");
}

struct StateEvent {
  const tactus_State& state;
  const PageTime& time;
};

void write(const StateEvent& event, Json& to) {
  const tactus_State& state = event.state;
  std::array<char, 32> seen;
  to.string(write_seen({event.time.now_ns / kMillisecond_ns, state.stops}, seen), "seen");
  write_time(state.server_ns, event.time, to);
  const auto status = static_cast<Status>(state.status);
  to.string(word<Rung>(state.rung), "rung").string(word<MotionPhase>(state.phase), "phase");
  to.string(status == Status::kOk ? Message() : describe(status), "why");
  to.integer(state.epoch, "epoch").string(state.owner, "owner");
  to.number(state.override, "override").number(state.speed_scaling, "speed_scaling");
  to.numbers("q", state.q, state.q_count).numbers("dq", state.dq, state.dq_count);
  to.numbers("tau", state.tau, state.tau_count);
  to.numbers("q_d", state.q_d, state.q_d_count).numbers("dq_d", state.dq_d, state.dq_d_count);
  to.numbers("pose", state.pose, state.pose_count);
  to.numbers("pose_d", state.pose_d, state.pose_d_count);
  to.number(state.margin_s, "margin_s").integer(state.slips, "slips");
  to.integer(state.overruns, "overruns");
  to.integer(state.stream.starved, "starved").integer(state.stream.late, "late");
}

void write(const tactus_Answer& answer, Json& to) {
  to.integer(answer.number, "number").integer(answer.status, "status").string(answer.text, "text");
}

void write(const tactus_Report& report, Json& to) {
  to.integer(report.number, "number").integer(report.status, "status");
  to.string(outcome_word(report.outcome), "outcome").string(report.text, "text");
}

struct ServerEvent {
  const tactus_Event& event;
  const PageTime& time;
};

void write(const ServerEvent& event, Json& to) {
  to.string(event.event.name, "name").string(event.event.text, "text");
  write_time(event.event.server_ns, event.time, to);
}

template <class Message>
void put(const char* event, const Message& message, EventRing& events) {
  char bytes[kLongestEvent];
  Json json(bytes, sizeof bytes);
  json.open('{');
  write(message, json);
  json.close('}');
  if (!json.text().empty()) events.append(event, json.text());
}

}  // namespace

void append_message(const tactus_ToClient& message, const PageTime& time, EventRing& events) {
  switch (message.which_message) {
    case tactus_ToClient_state_tag:
      return put("state", StateEvent{message.message.state, time}, events);
    case tactus_ToClient_answer_tag: return put("answer", message.message.answer, events);
    case tactus_ToClient_report_tag: return put("report", message.message.report, events);
    case tactus_ToClient_event_tag:
      return put("event", ServerEvent{message.message.event, time}, events);
    default: return;
  }
}

void append_ports(const PortValues& values, const PortTable& ports, EventRing& events) {
  char bytes[kLongestEvent];
  Json json(bytes, sizeof bytes);
  json.open('{').open('[', "values");
  const double* from = values.numbers.data();
  for (int i = 0; i < ports.count(); ++i) {
    json.open('[');
    for (int k = 0; k < info(ports[i].quantity).recorded; ++k) json.number(*from++);
    json.close(']');
  }
  json.close(']').close('}');
  if (!json.text().empty()) events.append("ports", json.text());
}

}  // namespace tactus
