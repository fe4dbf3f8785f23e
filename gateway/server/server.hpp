// Server: what clients may ask of a pipeline, and what they are told; without sockets, so that it
// runs in virtual time and takes any bytes. Whoever has the sockets gives it the bytes of each
// connection and the time, calls work(), and sends what waits. Runs outside the cycle, in one
// thread; it meets the cycle in the reference channels and in CycleMail only.
//
//   connections --bytes--> messages --references--> ReferenceIntake --> reference channel
//        ^                    |  ^---- lease          reports <------------'
//        |                    '------ orders --> CycleMail --> executive
//        '--- answers, reports, states <-------- snapshots, results
#pragma once

#include "gateway/server/codec.hpp"
#include "gateway/server/connection.hpp"
#include "gateway/server/cycle_mail.hpp"
#include "gateway/server/generator_clock.hpp"
#include "gateway/server/lease.hpp"
#include "gateway/server/reference_intake.hpp"
#include "gateway/server/stop_count.hpp"
#include "kernel/cycle/event_log.hpp"
#include "kernel/load/parameter_book.hpp"
#include "kernel/pipeline/only_block.hpp"

namespace tactus {

/// What a server says of itself, and where its log goes.
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
  const EventLog* events = nullptr;     ///< null: nothing is told of drives
  const Hal* hal = nullptr;             ///< explains their codes
};

/// Result of a request: kOk, or the reason of a refusal in words, and the number that it is about.
struct Reply {
  Status status = Status::kOk;
  Message text;
  Verdict verdict;

  Reply() = default;
  Reply(Status why, std::string_view words) : status(why), text(words) {}
};

class Server {
 public:
  Server(const ServerSetup& setup, ReferenceClient<JointSpace>& joints,
         ReferenceClient<TaskSpace>& poses, CycleMail& mail)
      : setup_(setup),
        joints_(joints, setup.loaded->ports),
        poses_(poses, setup.loaded->ports),
        mail_(mail),
        front_end_(only_block<WrenchFrontEnd>(*setup.loaded)) {}

  /// A client has connected; `session` is a number that nobody can guess. Returns the slot of its
  /// connection, -1: there are too many.
  int open(std::uint64_t session, std::int64_t now_ns);
  /// There is no slot for a client that has connected. The longest idle one gives way, if one is;
  /// returns the message, without its length, that tells the new one who has the places.
  Bytes turn_away(std::int64_t now_ns);
  /// Where bytes of the connection go that have come; of size 0: none are to be received at
  /// present.
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

  /// Does what there is to do; bounded. To be called every few milliseconds.
  void work(std::int64_t now_ns);

  int owner() const { return lease_.owner(); }
  std::uint32_t epoch() const { return epoch_; }

 private:
  struct Order {
    std::uint32_t id = 0;  // 0: free
    Origin from;
    CycleOrder what = CycleOrder::kStop;
  };
  Connection& at(int slot) { return connections_[static_cast<std::size_t>(slot)]; }
  const Connection& at(int slot) const { return connections_[static_cast<std::size_t>(slot)]; }
  bool takes_poses() const { return setup_.loaded->takes_poses; }
  bool puts_out() const { return setup_.loaded->robot.puts_out(); }
  bool wraps() const {
    return Robot::kContinuousJoints != 0 && setup_.loaded->takes_joints && !takes_poses();
  }
  bool takes_references() const { return takes_poses() || setup_.loaded->takes_joints; }
  /// Calls act(intake) with that of the references that the pipeline takes.
  template <class Act>
  auto with_intake(Act act) {
    return takes_poses() ? act(poses_) : act(joints_);
  }

  // server.cpp: connections, time-outs, the lease
  void take_messages(int slot, std::int64_t now_ns);
  void take_message(int slot, const Bytes& bytes, std::int64_t now_ns);
  void watch(int slot, std::int64_t now_ns);
  void cut(int slot, Status status, std::string_view text, std::int64_t now_ns);
  void leave(int slot, std::string_view how, std::int64_t now_ns);
  void begin_epoch();
  void begin_end();
  void end_motion();
  void lose_lease(std::string_view how, std::int64_t now_ns);

  // server_requests.cpp: what is asked
  Reply execute(int slot, const Origin& from, std::int64_t now_ns);
  Reply refuse_unknown() const;
  Reply greet(int slot, const Origin& from, std::int64_t now_ns);
  Reply lease(int slot, std::int64_t now_ns);
  Reply order(CycleOrder what, const Origin& from, std::int64_t now_ns);
  bool raises(pb_size_t what) const;
  Reply judge_stops(int slot) const;
  Reply control(const Origin& from);
  void tell_deed(const Told& told, std::int64_t now_ns);
  void tell_late(const Told& told, std::int64_t now_ns);
  Reply subscribe(int slot, std::int64_t now_ns);
  // server_references.cpp: references
  Reply judge_place(int slot, bool given, const tactus_Place& place);
  bool ending() const;
  Reply judge_void(int slot) const;
  Reply judge_fields() const;
  Reply point(int slot, const Origin& from);
  Reply begin(const Origin& from, std::int64_t now_ns);
  JointVector present_joints() const;
  Reply part(const Origin& from);
  Reply end(const Origin& from);
  Reply reply(const Verdict& verdict) const;

  // server_parameters.cpp: parameters of the pipeline
  Reply parameters(const Origin& from);
  Reply list_parameters(const Origin& from);
  void tell_changes(std::int64_t now_ns);
  void take_tuned(std::int64_t now_ns);

  // server_tare.cpp: the zero of the force/torque sensor
  Reply tare(const Origin& from, std::int64_t now_ns);
  void tell_tare(const Order& order, const OrderResult& result, std::int64_t now_ns);

  // server_streams.cpp: chunks and velocities
  Reply velocity(int slot, const Origin& from);
  Reply chunk(int slot, const Origin& from, std::int64_t now_ns);
  Reply read_chunk_time(int slot, std::int64_t now_ns, double& origin_s, double& observed_s) const;
  Verdict judge_targets(double origin_s, std::int64_t now_ns) const;
  Chunk<JointSpace>& chunk_of(const JointSpace&) { return joint_chunk_; }
  Chunk<TaskSpace>& chunk_of(const TaskSpace&) { return task_chunk_; }

  // server_telling.cpp: what is told
  void answer(Connection& to, std::uint32_t number, const Reply& reply, std::int64_t now_ns);
  bool put(Connection& to);
  void welcome(Connection& to, std::uint32_t number, std::int64_t now_ns);
  void tell_events(std::string_view name, Status status, std::string_view text, int except,
                   std::int64_t now_ns);
  void take_results(std::int64_t now_ns);
  void take_reports(std::int64_t now_ns);
  Message text_about(const Told& told, const Message& turns) const;
  void report(const Told& told, std::string_view text, std::int64_t now_ns,
              const Vector6* zero = nullptr);

  // server_watching.cpp: what is told of the cycles
  void take_snapshots(std::int64_t now_ns);
  void tell_drives(std::int64_t now_ns);
  void take_feedback(std::int64_t now_ns);
  void tell_state(Connection& to);
  template <class Space>
  void tell_feedback(const Feedback<Space>& feedback, ReferenceIntake<Space>& from,
                     std::int64_t now_ns);

  ServerSetup setup_;
  ReferenceIntake<JointSpace> joints_;
  ReferenceIntake<TaskSpace> poses_;
  CycleMail& mail_;
  int front_end_;  // the block whose sensor can be tared; -1: there is none, or more than one
  Lease lease_;
  std::uint32_t epoch_ = 1;
  StopCount stops_;
  GeneratorClock clock_;
  Chunk<JointSpace> joint_chunk_;  // that is being read
  Chunk<TaskSpace> task_chunk_;
  CycleSnapshot newest_;
  bool seen_ = false;          // a snapshot
  std::uint32_t events_ = 0;   // of the executive's log, that are read
  std::uint32_t dropped_ = 0;  // references that were duplicates or overtaken
  std::uint32_t lost_feedback_ = 0;
  std::array<Order, 16> orders_{};
  std::uint32_t next_order_ = 1;
  bool tuning_ = false;  // a set of parameters is the cycle's
  Origin tuning_from_;
  Name tuning_by_;
  std::uint32_t parameter_sets_ = 0;  // that have taken effect
  int turn_ = 0;                      // the connection that is served first
  std::array<Connection, kMostClients> connections_{};
  tactus_ToServer request_;  // that is being executed
  tactus_ToClient told_;     // that is being written
  std::array<std::uint8_t, kLongestTold> bytes_;
};

}  // namespace tactus
