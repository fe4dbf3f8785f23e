#include "sim_plant/ur/controller/emulator.hpp"

#include "sim_plant/ur/wire/state_messages.hpp"

namespace tactus::ur {
namespace {

constexpr double kStateRate_Hz = 10.0;

}  // namespace

int Emulator::open(Service service) {
  int taken = 0;
  for (const Session& session : sessions_) taken += session.open && session.service == service;
  if (taken == kPlaces) return -1;
  for (int i = 0; i < kSessions; ++i) {
    Session& session = at(i);
    if (session.open) continue;
    session.open = true;
    session.ended = session.told = false;
    session.service = service;
    session.out.clear();
    session.script.clear();
    session.line_size = 0;
    session.writes = false;
    session.kept = 0;
    session.idle = 0;
    session.rtde.open(i);
    greet(session);
    return i;
  }
  return -1;
}

int Emulator::find_idle(Service service) const {
  int found = -1, longest = static_cast<int>(kIdle_s / controller_.machine().cycle_s());
  for (int i = 0; i < kSessions; ++i) {
    const Session& session = sessions_[static_cast<std::size_t>(i)];
    if (!session.open || session.service != service || session.idle < longest) continue;
    found = i;
    longest = session.idle + 1;
  }
  return found;
}

void Emulator::close(int session) {
  if (at(session).service == Service::kRtde) at(session).rtde.close(claims_);
  at(session).open = false;
}

void Emulator::greet(Session& session) {
  if (session.service == Service::kDashboard) session.out.put(kDashboardGreeting);
  if (session.service != Service::kPrimary && session.service != Service::kSecondary) return;
  std::array<std::uint8_t, 256> bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  controller_.machine().messages.write_version(writer);
  session.out.put(writer.data(), writer.size());
}

void Emulator::receive(int session, const std::uint8_t* data, std::size_t size) {
  Session& client = at(session);
  if (!client.open || client.ended) return;
  client.idle = 0;
  Machine& machine = controller_.machine();
  switch (client.service) {
    case Service::kDashboard: return take_lines(client, data, size);
    case Service::kRtde: {
      const RtdeContext context{machine.settings.version, machine.io, claims_, machine.cycle};
      if (!client.rtde.receive(data, size, context, client.out)) client.ended = true;
      return;
    }
    default: return take_script(client, data, size);
  }
}

void Emulator::take_lines(Session& session, const std::uint8_t* data, std::size_t size) {
  for (std::size_t i = 0; i < size && !session.ended; ++i) {
    if (data[i] != '\n') {
      if (session.line_size < session.line.size())
        session.line[session.line_size++] = static_cast<char>(data[i]);
      continue;
    }
    Reply reply;
    session.ended = controller_.dashboard().run({session.line.data(), session.line_size}, reply);
    session.line_size = 0;
    session.out.put(reply);
  }
}

void Emulator::take_script(Session& session, const std::uint8_t* data, std::size_t size) {
  Runner& runner = controller_.runner();
  Machine& machine = controller_.machine();
  session.writes = true;
  session.script.take(data, size, [&](std::string_view piece) {
    if (!run_direct_command(piece, runner, machine)) runner.upload(piece, machine);
  });
}

void Emulator::tick() {
  controller_.tick();
  const bool due = state_is_due();
  for (Session& session : sessions_) {
    if (!session.open) continue;
    watch_client(session);
    send_cycle(session);
    const bool state =
        session.service == Service::kPrimary || session.service == Service::kSecondary;
    if (state && (due || !session.told)) send_state(session);
  }
  send_messages();
  for (Session& session : sessions_) session.kept = session.out.size();
}

Pace Emulator::pace() const {
  Pace pace = Pace::kByTime;
  for (const Session& session : sessions_) {
    const bool asked = session.open && !session.ended && session.service == Service::kRtde;
    if (!asked || !session.rtde.closes_loop()) continue;
    const Answers& answers = session.rtde.answers();
    if (answers.missing()) return answers.steady() ? Pace::kWaits : Pace::kByTime;
    pace = Pace::kAtOnce;
  }
  return pace;
}

/// True ten times a second, and at once when a protective stop begins.
bool Emulator::state_is_due() {
  state_due_ += kStateRate_Hz * controller_.machine().cycle_s();
  const bool stopped = controller_.machine().safety.protective_stopped();
  const bool sudden = stopped && !protective_before_;
  protective_before_ = stopped;
  if (state_due_ < 1.0 - 1e-9) return sudden;
  state_due_ -= 1.0;
  return true;
}

void Emulator::send_cycle(Session& session) {
  if (session.ended) return;
  if (session.service == Service::kRtde) session.rtde.tick(controller_.image(), session.out);
  if (session.service != Service::kRealtime) return;
  std::array<std::uint8_t, 1220> bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  write_realtime(controller_.image(), controller_.machine().settings.version, writer);
  session.out.put(writer.data(), writer.size());
}

void Emulator::send_state(Session& session) {
  std::array<std::uint8_t, 2048> bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  const Settings& settings = controller_.machine().settings;
  write_robot_state(controller_.image(), settings.version, settings.dh, !session.told, writer);
  if (session.out.put(writer.data(), writer.size())) session.told = true;
}

void Emulator::send_messages() {
  RobotMessages& messages = controller_.machine().messages;
  const Outbox& pending = messages.pending();
  if (pending.empty()) return;
  for (Session& session : sessions_)
    if (session.open && session.service == Service::kPrimary)
      session.out.put(pending.data(), pending.size());
  messages.clear();
}

/// Counts the cycles in which no byte was exchanged, and ends the session of a client for which
/// packets are dropped meanwhile. One that uploads programs misses packets instead; it is ended
/// where another needs its place.
void Emulator::watch_client(Session& session) {
  session.idle = session.out.size() < session.kept ? 0 : session.idle + 1;
  session.ended = session.ended || (session.stalled() && !session.writes);
}

}  // namespace tactus::ur
