// Server: the requests of clients to a pipeline, and the messages to them. It has no sockets, so
// that it runs in virtual time and takes any bytes: its caller passes the bytes of each connection
// and the time, calls work(), and sends the bytes that wait. Runs outside the cycle, in one thread;
// it shares the reference channels and CycleMailboxes with the cycle, nothing else.
//
//   connections --bytes--> messages --references--> ReferenceIntake --> reference channel
//        ^                    |  ^---- lease          reports <------------'
//        |                    '------ orders --> CycleMailboxes --> executive
//        '--- answers, reports, states <-------- snapshots, results
#pragma once

#include "gateway/server/cycle_orders.hpp"
#include "gateway/server/parameter_requests.hpp"
#include "gateway/server/reference_requests.hpp"
#include "gateway/server/state_publisher.hpp"

namespace tactus {

/// Facts about the server for its clients, and the receiver of its log.
struct ServerSetup {
  const char* board = "";
  std::string_view pipeline;                    ///< name of its file
  std::uint64_t configuration = 0;              ///< hash of the file's text
  std::string_view motion_frame, wrench_frame;  ///< of its own trajectory
  const Pipeline* loaded = nullptr;
  /// Names of its digital outputs; null: they have none.
  std::array<const char*, kMostOutputs> output_names{};
  int joint_window = 0, task_window = 0;  ///< waypoints that a store holds with all fields
  void (*log)(const char* line) = nullptr;
  ParameterBook* parameters = nullptr;  ///< null: they do not change while the pipeline runs
  const EventLog* events = nullptr;     ///< null: no events about drives
  const Hal* hal = nullptr;             ///< explains their codes
};

class Server {
 public:
  Server(const ServerSetup& setup, ReferenceClient<JointSpace>& joints,
         ReferenceClient<TaskSpace>& poses, CycleMailboxes& mailboxes)
      : setup_(setup),
        references_(*setup.loaded, joints, poses),
        clients_(references_, stops_, setup.log),
        cycles_(setup.events, setup.hal, mailboxes, references_, stops_, clients_),
        requests_(references_, *setup.loaded, cycles_, clients_),
        parameters_(setup.parameters, *setup.loaded, mailboxes, clients_),
        orders_(references_, *setup.loaded, mailboxes, clients_) {}

  /// A client has connected; `session` is a number that cannot be guessed. Returns the slot of its
  /// connection, -1: there are too many.
  int open(std::uint64_t session, std::int64_t now_ns);
  /// Refuses a new connection for lack of a slot, and disconnects the longest idle client, if any
  /// is idle. Returns the message to the new client, without its length, with the names of the
  /// others.
  Bytes refuse_connection(std::int64_t now_ns);
  /// Returns the space for received bytes; of size 0: the connection is not to be read at present.
  ByteSpace space(int slot);
  void received(int slot, std::size_t count, std::int64_t now_ns);
  /// Takes a datagram, which holds one message.
  void datagram(const Bytes& bytes, std::int64_t now_ns);
  /// The client has closed the connection, or the network has.
  void closed(int slot, std::int64_t now_ns);
  /// Bytes that wait to be sent.
  Bytes waiting(int slot) const { return at(slot).out.waiting(); }
  void sent(int slot, std::size_t count, std::int64_t now_ns);
  /// True if the connection is to be closed; then call closed().
  bool finished(int slot, std::int64_t now_ns) const;
  /// True if a client is connected in this slot.
  bool used(int slot) const { return at(slot).state != Connection::State::kFree; }

  /// Processes pending messages and reports; bounded. To be called every few milliseconds.
  void work(std::int64_t now_ns);

  int owner() const { return lease_.owner(); }
  std::uint32_t epoch() const { return references_.epoch(); }

 private:
  Connection& at(int slot) { return clients_.at(slot); }
  const Connection& at(int slot) const { return clients_.at(slot); }

  void take_messages(int slot, std::int64_t now_ns);
  void take_message(int slot, const Bytes& bytes, std::int64_t now_ns);
  void judge_silence(int slot, std::int64_t now_ns);
  void cut(int slot, Status status, std::string_view text, std::int64_t now_ns);
  void cut_slow(std::int64_t now_ns);
  void leave(int slot, std::string_view how, std::int64_t now_ns);
  void begin_end();
  void lose_lease(std::string_view how, std::int64_t now_ns);
  void take_reports(std::int64_t now_ns);
  Message text_about(const ClientReport& report, const Message& turns) const;
  void report_control(const ClientReport& report, std::int64_t now_ns);
  void report_late(const ClientReport& report, std::int64_t now_ns);

  // server_requests.cpp: the execution of requests
  Reply execute(int slot, const Origin& from, std::int64_t now_ns);
  Reply greet(int slot, const Origin& from, std::int64_t now_ns);
  void welcome(Connection& to, std::uint32_t number, std::int64_t now_ns);
  Reply lease(int slot, std::int64_t now_ns);
  Reply stop(const Origin& from, std::int64_t now_ns);
  bool raises(pb_size_t what) const;
  Reply judge_stops(int slot) const;
  Reply control(const Origin& from);
  Reply subscribe(int slot, std::int64_t now_ns);

  ServerSetup setup_;
  References references_;
  Lease lease_;
  StopCount stops_;
  Clients clients_;
  StatePublisher cycles_;
  ReferenceRequests requests_;
  ParameterRequests parameters_;
  CycleOrders orders_;
  int turn_ = 0;             // the connection that is served first
  tactus_ToServer request_;  // that is being executed
};

}  // namespace tactus
