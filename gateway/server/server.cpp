#include "gateway/server/server.hpp"

namespace tactus {
namespace {

constexpr std::int64_t kFarewell_ns = kSecond_ns;  // to send what a client was told last

}  // namespace

int Server::open(std::uint64_t session, std::int64_t now_ns) {
  for (int slot = 0; slot < kMostClients; ++slot) {
    if (used(slot)) continue;
    at(slot).open(session, now_ns);
    return slot;
  }
  return -1;
}

/// Idle is who neither owns the motion nor watches, and has sent nothing but Pings for a minute.
Bytes Server::turn_away(std::int64_t now_ns) {
  int idle = Lease::kNobody;
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
  told_ = tactus_ToClient_init_zero;
  told_.which_message = tactus_ToClient_answer_tag;
  told_.message.answer.status = static_cast<std::uint32_t>(Status::kTooLarge);
  set_text(told_.message.answer.text, text);
  told_.message.answer.server_ns = now_ns;
  return {bytes_.data(), encode(told_, bytes_)};
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
         (connection.out.waiting().size == 0 || now_ns - connection.heard_ns > kFarewell_ns);
}

void Server::work(std::int64_t now_ns) {
  take_snapshots(now_ns);
  tell_drives(now_ns);
  take_results(now_ns);
  take_tuned(now_ns);
  take_reports(now_ns);
  for (int i = 0; i < kMostClients; ++i) {
    const int slot = (turn_ + i) % kMostClients;
    take_messages(slot, now_ns);
    watch(slot, now_ns);
  }
  turn_ = (turn_ + 1) % kMostClients;
  if (lease_.expired(now_ns)) lose_lease("was not renewed in time", now_ns);
  take_reports(now_ns);
  take_feedback(now_ns);
  if (!ending())
    for (Connection& connection : connections_)
      connection.behind = connection.behind && connection.in.whole();
  for (Connection& connection : connections_)
    if (connection.state == Connection::State::kOpen && seen_ && connection.states.due(now_ns))
      tell_state(connection);
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
  if (!hello || reply.status != Status::kOk) answer(connection, from.number, reply, now_ns);
  const bool judged = request_.which_request == tactus_ToServer_parameters_tag &&
                      request_.request.parameters.check && reply.status == Status::kOk;
  if (judged) report({from, Outcome::kExecuted, {}, newest_.time_s, 0.0}, {}, now_ns);
}

/// References come again in datagrams, so nobody is told that one is not taken.
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
void Server::watch(int slot, std::int64_t now_ns) {
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
  answer(connection, 0, {status, text}, now_ns);
  Message how("is cut: ");
  leave(slot, how << text, now_ns);
  connection.state = Connection::State::kLeaving;
  connection.heard_ns = now_ns;
}

/// The others and the log are told; what a client has sent and nobody waits for goes on, unless it
/// owned the motion.
void Server::leave(int slot, std::string_view how, std::int64_t now_ns) {
  Connection& connection = at(slot);
  if (!connection.there()) return;
  const bool owner = lease_.owner() == slot;
  Message text(connection.name.empty() ? "a client" : std::string_view(connection.name));
  text << " " << how;
  if (setup_.log != nullptr) setup_.log(text.c_str());
  connection.state = Connection::State::kLeaving;
  joints_.give_up(connection.session);
  poses_.give_up(connection.session);
  tell_events("left", Status::kOk, text, slot, now_ns);
  if (owner) lose_lease("ends, as it has left", now_ns);
  joints_.forget(connection.session);
  poses_.forget(connection.session);
}

/// A cancel or a stop is on its way: what comes or waits before it is in force is void.
void Server::begin_end() {
  begin_epoch();
  for (Connection& connection : connections_) connection.behind = true;
}

/// What was sent before is void, whether it has a place or not.
void Server::begin_epoch() {
  ++epoch_;
  if (takes_references()) with_intake([](auto& intake) { intake.drop_waiting(); });
}

/// What moves is brought to rest on its path, and what is on its way is void.
void Server::end_motion() {
  begin_epoch();
  if (takes_references()) with_intake([](auto& intake) { intake.cancel(); });
}

void Server::lose_lease(std::string_view how, std::int64_t now_ns) {
  Connection& owner = at(lease_.owner());
  with_intake([&owner](auto& intake) { intake.give_up(owner.session); });
  lease_.end();
  end_motion();
  stops_.add(StopCount::kNobody);
  Message text("the lease of ");
  text << std::string_view(owner.name) << " " << how << ": the arm comes to rest";
  if (setup_.log != nullptr) setup_.log(text.c_str());
  tell_events("lease", Status::kNotOwner, text, -1, now_ns);
}

}  // namespace tactus
