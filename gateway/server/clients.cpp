#include "gateway/server/clients.hpp"

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

/// Writes the number that a verdict is about; without one, nothing.
void write_finding(const Verdict& verdict, bool& has, tactus_Finding& to) {
  has = verdict.waypoint >= 0 || verdict.axis >= 0 || verdict.value != 0.0 || verdict.limit != 0.0;
  to = {verdict.waypoint, verdict.axis, verdict.value, verdict.limit};
}

}  // namespace

Reply reply_to(const Verdict& verdict, VerdictAxes axes) {
  if (verdict.ok()) return {};
  Message text = describe(verdict, axes, kInfinity);
  Reply reply(verdict.status, text << remedy(verdict));
  reply.verdict = verdict;
  return reply;
}

Connection* Clients::sender(const Origin& from) {
  if (from.slot < 0) return nullptr;
  Connection& connection = at(from.slot);
  return connection.there() && connection.session == from.session ? &connection : nullptr;
}

tactus_ToClient& Clients::begin_message(pb_size_t kind) {
  message_ = tactus_ToClient_init_zero;
  message_.which_message = kind;
  return message_;
}

bool Clients::put(Connection& to) {
  const Bytes bytes = encoded();
  return bytes.size > 0 && to.out.put(bytes.data, bytes.size);
}

void Clients::answer(Connection& to, std::uint32_t number, const Reply& reply,
                     std::int64_t now_ns) {
  tactus_Answer& answer = begin_message(tactus_ToClient_answer_tag).message.answer;
  answer.number = number;
  answer.status = static_cast<std::uint32_t>(reply.status);
  set_text(answer.text, reply.text);
  answer.client_ns = to.client_ns;
  answer.server_ns = now_ns;
  answer.received_ns = to.received_ns;
  answer.epoch = references_.epoch();
  answer.stops = stops_.newest();
  write_finding(reply.verdict, answer.has_finding, answer.finding);
  static_cast<void>(put(to));
}

void Clients::send_event(std::string_view name, Status status, std::string_view text,
                         std::int64_t now_ns, int except) {
  tactus_Event& event = begin_message(tactus_ToClient_event_tag).message.event;
  event.server_ns = now_ns;
  set_text(event.name, name);
  event.status = static_cast<std::uint32_t>(status);
  set_text(event.text, text);
  for (int slot = 0; slot < kMostClients; ++slot) {
    Connection& to = at(slot);
    const bool subscribed = to.state == Connection::State::kOpen && to.events && slot != except;
    if (subscribed && to.out.free() >= kReserveBytes) static_cast<void>(put(to));
  }
}

void Clients::report(const ClientReport& from, std::string_view text, std::int64_t now_ns,
                     const Vector6* zero) {
  Connection* const to = sender(from.to);
  if (to == nullptr || to->slow != nullptr) return;
  tactus_Report& report = begin_message(tactus_ToClient_report_tag).message.report;
  report.number = from.to.number;
  report.outcome = outcome_of(from.outcome);
  report.status = static_cast<std::uint32_t>(from.verdict.status);
  set_text(report.text, text);
  report.time_s = from.time_s;
  report.stretch = from.stretch;
  report.server_ns = now_ns;
  write_finding(from.verdict, report.has_finding, report.finding);
  if (zero != nullptr) set_numbers(report.zero, report.zero_count, zero->data(), 6);
  if (!put(*to)) to->slow = "reports were not read; read what is sent";
}

}  // namespace tactus
