// Emulator: the controller with its clients. The owner of the network opens a session for every
// connection, passes bytes in and out, and calls tick() once per cycle. A client that does not read
// loses packets and, after some seconds, its session. Every service has places of its own, so that
// clients of one do not lock out those of another. An idle client keeps its place, as on a robot,
// until another needs it.
#pragma once

#include "sim_plant/ur/controller/controller.hpp"
#include "sim_plant/ur/programs/runner.hpp"
#include "sim_plant/ur/wire/rtde_session.hpp"

namespace tactus::ur {

enum class Service : std::uint8_t { kDashboard, kPrimary, kSecondary, kRealtime, kRtde };

/// When the next cycle may begin if real time need not be kept.
enum class Pace : std::uint8_t {
  kByTime,  ///< no client closes a loop, or one has just begun to
  kAtOnce,  ///< all clients that close a loop have answered the last packet
  kWaits,   ///< a client that always answered has not answered yet
};

class Emulator {
 public:
  static constexpr int kPlaces = 8;              ///< of each service
  static constexpr int kSessions = 5 * kPlaces;  ///< of all services
  static constexpr double kIdle_s = 10.0;        ///< after which a client may lose its place

  explicit Emulator(const Settings& settings) : controller_(settings) {}

  Status start() { return controller_.start(); }  ///< [init]
  void tick();                                    ///< [cyclic]

  /// Opens a session for a new client; -1: no place of the service is free. [any]
  int open(Service service);
  /// Returns the session of the service whose client has sent and taken no byte for the longest
  /// time, and for kIdle_s; -1: there is none. [any]
  int find_idle(Service service) const;
  void close(int session);
  /// Takes bytes from the client, in pieces of any size.
  void receive(int session, const std::uint8_t* data, std::size_t size);
  /// The bytes to send to the client.
  Outbox& outbox(int session) { return at(session).out; }
  /// True if the session has ended: send the remaining bytes and close it.
  bool ended(int session) { return at(session).ended; }
  /// True if it has because the client took no bytes.
  bool stalled(int session) { return at(session).stalled() && !at(session).writes; }

  Pace pace() const;

  Controller& controller() { return controller_; }
  Links& links() { return controller_.machine().links; }

 private:
  // Cycles in which a client may be idle while packets are dropped for it.
  static constexpr int kPatience = 625;

  struct Session {
    bool open = false, ended = false;
    Service service = Service::kDashboard;
    Outbox out;
    RtdeSession rtde;
    ScriptIntake script;
    std::array<char, 1024> line;  // of the dashboard
    std::size_t line_size = 0;
    int idle = 0;          // cycles in which no byte was exchanged
    std::size_t kept = 0;  // bytes that waited at the end of the last cycle
    bool told = false;     // has been sent a whole state
    bool writes = false;   // has sent a program

    bool stalled() const { return idle > kPatience && out.dropped() > 0 && !out.empty(); }
  };

  Session& at(int session) { return sessions_[static_cast<std::size_t>(session)]; }
  void greet(Session& session);
  void take_lines(Session& session, const std::uint8_t* data, std::size_t size);
  void take_script(Session& session, const std::uint8_t* data, std::size_t size);
  void send_cycle(Session& session);
  void send_state(Session& session);
  void send_messages();
  void watch_client(Session& session);
  bool state_is_due();

  Controller controller_;
  std::array<Session, kSessions> sessions_;
  Claims claims_;
  double state_due_ = 0.0;
  bool protective_before_ = false;
};

}  // namespace tactus::ur
