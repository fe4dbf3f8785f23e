#include "gateway/server/server.hpp"

namespace tactus {
namespace {

constexpr std::int64_t kLastSend_ns = kSecond_ns;  // to send the last message of a cut client

}  // namespace

int Server::open(std::uint64_t session, std::int64_t now_ns) {
  for (int slot = 0; slot < kMostClients; ++slot) {
    if (used(slot)) continue;
    at(slot).open(session, now_ns);
    return slot;
  }
  return -1;
}

/// A client is idle that neither owns the motion nor watches, and has sent only Pings for a minute.
Bytes Server::refuse_connection(std::int64_t now_ns) {
  int idle = Lease::kNoOwner;
  Message names;
  for (int slot = 0; slot < kMostClients; ++slot) {
    const Connection& connection = at(slot);
    if (!connection.there()) continue;
    names << (names.empty() ? "" : ", ")
          << (connection.name.empty() ? "a client" : std::string_view(connection.name));
    const bool idles =
        slot != lease_.owner() && !connection.watches() && now_ns - connection.asked_ns > kIdle_ns;
    if (idles && (idle < 0 || connection.asked_ns < at(idle).asked_ns)) idle = slot;
  }
  Message text("all places are taken; ");
  if (idle >= 0)
    text << std::string_view(at(idle).name) << " is idle and gives way: connect again";
  else
    text << "end one of these, or try again: " << std::string_view(names);
  if (idle >= 0)
    cut(idle, Status::kClientSilent, "idle for a minute while all places are taken", now_ns);
  tactus_Answer& answer = clients_.begin_message(tactus_ToClient_answer_tag).message.answer;
  answer.status = static_cast<std::uint32_t>(Status::kTooLarge);
  set_text(answer.text, text);
  answer.server_ns = now_ns;
  return clients_.encoded();
}

/// Messages wait in the socket while the answers to the last ones are not read.
ByteSpace Server::space(int slot) {
  Connection& connection = at(slot);
  if (!connection.there() || connection.out.free() < kReserveBytes) return {};
  return connection.in.space();
}

void Server::received(int slot, std::size_t count, std::int64_t now_ns) {
  Connection& connection = at(slot);
  connection.in.added(count);
  connection.received_ns = now_ns;
}

void Server::closed(int slot, std::int64_t now_ns) {
  leave(slot, "has left", now_ns);
  at(slot).state = Connection::State::kFree;
}

void Server::sent(int slot, std::size_t count, std::int64_t now_ns) {
  at(slot).out.sent(count);
  at(slot).read_ns = now_ns;
}

bool Server::finished(int slot, std::int64_t now_ns) const {
  const Connection& connection = at(slot);
  return connection.state == Connection::State::kLeaving &&
         (connection.out.waiting().size == 0 || now_ns - connection.heard_ns > kLastSend_ns);
}

void Server::work(std::int64_t now_ns) {
  cycles_.take_snapshots(now_ns);
  cycles_.send_drive_events(now_ns);
  const double time_s = cycles_.newest().time_s;
  orders_.take_results(time_s, now_ns);
  parameters_.take_verdict(time_s, now_ns);
  take_reports(now_ns);
  cut_slow(now_ns);
  for (int i = 0; i < kMostClients; ++i) {
    const int slot = (turn_ + i) % kMostClients;
    take_messages(slot, now_ns);
    judge_silence(slot, now_ns);
  }
  turn_ = (turn_ + 1) % kMostClients;
  if (lease_.expired(now_ns)) lose_lease("was not renewed in time", now_ns);
  take_reports(now_ns);
  cut_slow(now_ns);
  cycles_.send_feedback(now_ns);
  if (!orders_.stopping() && !references_.canceling())
    for (Connection& connection : clients_)
      connection.behind = connection.behind && connection.in.whole();
  cycles_.send_states(lease_, requests_.dropped(), now_ns);
}

void Server::take_messages(int slot, std::int64_t now_ns) {
  Connection& connection = at(slot);
  Bytes bytes;
  for (int i = 0; i < kMessagesPerTurn && connection.there(); ++i) {
    if (connection.out.free() < kReserveBytes) return;
    if (connection.in.malformed()) {
      Message text("a message is longer than ");
      text << kLongestMessage << " bytes; split it, and send its length first";
      return cut(slot, Status::kBadValue, text, now_ns);
    }
    if (!connection.in.next(bytes)) return;
    if (!connection.rate.count(now_ns)) {
      Message text("more than ");
      text << kMessagesPerSecond << " messages in a second; send less often";
      return cut(slot, Status::kTooManyMessages, text, now_ns);
    }
    take_message(slot, bytes, now_ns);
  }
}

void Server::take_message(int slot, const Bytes& bytes, std::int64_t now_ns) {
  Connection& connection = at(slot);
  const char* why = "";
  if (!decode(bytes, request_, why)) {
    Message text("malformed message: ");
    return cut(slot, Status::kBadValue, text << why, now_ns);
  }
  connection.heard_ns = now_ns;
  if (request_.which_request != tactus_ToServer_ping_tag) connection.asked_ns = now_ns;
  connection.client_ns = request_.client_ns;
  lease_.heard(slot, now_ns);
  const Origin from = {slot, connection.session, request_.number};
  const bool hello = connection.state == Connection::State::kNew &&
                     request_.which_request == tactus_ToServer_hello_tag;
  const Reply reply = execute(slot, from, now_ns);
  if (!hello || reply.status != Status::kOk)
    clients_.answer(connection, from.number, reply, now_ns);
  const bool judged = request_.which_request == tactus_ToServer_parameters_tag &&
                      request_.request.parameters.check && reply.status == Status::kOk;
  if (!judged) return;
  clients_.report({from, Outcome::kExecuted, {}, cycles_.newest().time_s, 0.0}, {}, now_ns);
  cut_slow(now_ns);
}

/// References in datagrams are repeated, so a refused one gets no answer.
void Server::datagram(const Bytes& bytes, std::int64_t now_ns) {
  const char* why = "";
  if (!decode(bytes, request_, why) || request_.session == 0) return;
  for (int slot = 0; slot < kMostClients; ++slot) {
    Connection& connection = at(slot);
    const pb_size_t what = request_.which_request;
    const bool reference = what == tactus_ToServer_point_tag ||
                           what == tactus_ToServer_velocity_tag ||
                           what == tactus_ToServer_chunk_tag;
    if (connection.state != Connection::State::kOpen || connection.session != request_.session ||
        !reference)
      continue;
    if (!connection.rate.count(now_ns))
      return cut(slot, Status::kTooManyMessages, "too many datagrams; send less often", now_ns);
    connection.heard_ns = connection.received_ns = now_ns;
    connection.client_ns = request_.client_ns;
    lease_.heard(slot, now_ns);
    static_cast<void>(execute(slot, {slot, connection.session, request_.number}, now_ns));
  }
}

/// Ends a connection whose client does not do its part.
void Server::judge_silence(int slot, std::int64_t now_ns) {
  Connection& connection = at(slot);
  if (!connection.there()) return;
  if (connection.out.waiting().size == 0) connection.read_ns = now_ns;
  const std::int64_t silent_ns = now_ns - connection.heard_ns;
  if (connection.state == Connection::State::kNew && silent_ns > kHelloWait_ns)
    cut(slot, Status::kClientSilent, "no Hello within 5 s", now_ns);
  else if (silent_ns > kSilence_ns)
    cut(slot, Status::kClientSilent, "no message for 15 s; send a Ping every 5 s", now_ns);
  else if (now_ns - connection.read_ns > kStalled_ns)
    cut(slot, Status::kClientSlow, "nothing was read for 2 s; read what is sent", now_ns);
}

void Server::cut(int slot, Status status, std::string_view text, std::int64_t now_ns) {
  Connection& connection = at(slot);
  clients_.answer(connection, 0, {status, text}, now_ns);
  Message how("is cut: ");
  leave(slot, how << text, now_ns);
  connection.state = Connection::State::kLeaving;
  connection.heard_ns = now_ns;
}

/// The other clients and the log get an event. References of the client go on without reports,
/// unless it owned the motion.
void Server::leave(int slot, std::string_view how, std::int64_t now_ns) {
  Connection& connection = at(slot);
  if (!connection.there()) return;
  const bool owner = lease_.owner() == slot;
  Message text(connection.name.empty() ? "a client" : std::string_view(connection.name));
  text << " " << how;
  connection.state = Connection::State::kLeaving;
  references_.give_up(connection.session);
  clients_.announce("left", Status::kOk, text.c_str(), now_ns, slot);
  if (owner) lose_lease("ends, as it has left", now_ns);
  references_.forget(connection.session);
}

/// A cancel or a stop is under way: references sent before it is in force are void.
void Server::begin_end() {
  references_.begin_epoch();
  for (Connection& connection : clients_) connection.behind = true;
}

void Server::lose_lease(std::string_view how, std::int64_t now_ns) {
  Connection& owner = at(lease_.owner());
  references_.give_up(owner.session);
  lease_.end();
  references_.end_motion();
  stops_.add(StopCount::kNoSession);
  Message text("the lease of ");
  text << std::string_view(owner.name) << " " << how << ": the arm comes to rest";
  clients_.announce("lease", Status::kNotOwner, text.c_str(), now_ns);
}

void Server::cut_slow(std::int64_t now_ns) {
  for (int slot = 0; slot < kMostClients; ++slot)
    if (at(slot).there() && at(slot).slow != nullptr)
      cut(slot, Status::kClientSlow, at(slot).slow, now_ns);
}

void Server::take_reports(std::int64_t now_ns) {
  if (!references_.takes_any()) return;
  references_.with_intake([&](auto& intake) {
    ClientReport report;
    while (intake.work(report)) {
      clients_.report(report, text_about(report, intake.about_turns(report)), now_ns);
      if (report.effect.what != nullptr) report_control(report, now_ns);
      report_late(report, now_ns);
    }
    Credit credit;
    if (!intake.grant(credit)) return;
    clients_.begin_message(tactus_ToClient_credit_tag).message.credit.waypoints =
        static_cast<std::uint32_t>(credit.waypoints);
    Connection& to = at(credit.to.slot);
    if (!clients_.put(to)) to.slow = "credit was not read; read what is sent";
  });
}

/// The text of a refusal has its cause in the turns of a joint, or else the remedy of its status;
/// that of an accepted reference has the warning about turns.
Message Server::text_about(const ClientReport& report, const Message& turns) const {
  if (turns.empty() || report.verdict.ok())
    return turns.empty() ? reply_to(report.verdict, references_.axes()).text : turns;
  Message text = describe(report.verdict, VerdictAxes::kJoints, kInfinity);
  return text << turns;
}

/// Sends a control that has taken effect to all clients, and logs it if its sender did not own the
/// motion.
void Server::report_control(const ClientReport& report, std::int64_t now_ns) {
  const Connection* const by = clients_.sender(report.to);
  if (by == nullptr) return;
  Message text(by->name);
  text << report.effect.what;
  if (report.effect.percent >= 0.0) text << " to " << report.effect.percent << " %";
  if (!report.effect.by_owner) clients_.log(text.c_str());
  clients_.send_event("control", Status::kOk, text, now_ns);
}

/// Announces a client whose chunks have all been late for a second, with the delay of the newest.
void Server::report_late(const ClientReport& report, std::int64_t now_ns) {
  Connection* const by = clients_.sender(report.to);
  if (by == nullptr) return;
  if (report.outcome == Outcome::kExecuted) by->late = 0;
  if (report.verdict.status != Status::kChunkLate) return;
  if (by->late++ == 0) by->late_ns = now_ns;
  if (now_ns - by->late_ns < kSecond_ns) return;
  Message text(by->name);
  text << ": the last " << by->late << " chunks came too late, the newest by "
       << report.verdict.value << " s; send sooner, or targets farther ahead";
  by->late = 0;
  clients_.announce("late", Status::kChunkLate, text.c_str(), now_ns);
}

}  // namespace tactus
