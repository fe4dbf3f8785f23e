#include "tests/trace/traced_player.hpp"

#include <cstring>
#include <new>

namespace tactus {
namespace {

std::uint64_t number_of(int value) {
  return static_cast<std::uint64_t>(std::int64_t{value});
}

/// Adds to a trace what the robot and the client are told.
class TracedHal final : public TapeHal {
 public:
  explicit TracedHal(Trace& trace) : trace_(trace) {}

  Status write(const RobotCommand& command) override {
    add_command();
    command_ = command;
    written_ = true;
    return Status::kOk;
  }
  /// Adds the last command, unless it was added.
  void add_command() {
    if (!written_) return;
    written_ = false;
    add("command.mode", command_.mode);
    add("command.request", command_.request);
    trace_.add("command.value", command_.value);
    trace_.add("command.dq_ff", command_.dq_ff);
    trace_.add("command.tau_ff", command_.tau_ff);
  }

  void told(const Verdict& verdict) override {
    add("verdict.status", verdict.status);
    trace_.add("verdict.waypoint", number_of(verdict.waypoint));
    trace_.add("verdict.axis", number_of(verdict.axis));
    trace_.add("verdict.value", verdict.value);
    trace_.add("verdict.limit", verdict.limit);
  }
  void told(const Report& report) override {
    trace_.add("report.id", std::uint64_t{report.id});
    add("report.outcome", report.outcome);
    trace_.add("report.store", number_of(report.store));
    trace_.add("report.time", report.time_s);
    told(report.verdict);
  }
  void told(const Feedback<JointSpace>& feedback) override {
    add_head(feedback);
    for (const JointSpace::Point* point : {&feedback.desired, &feedback.actual, &feedback.error}) {
      trace_.add("feedback.q", point->q);
      trace_.add("feedback.dq", point->dq);
      trace_.add("feedback.ddq", point->ddq);
      trace_.add("feedback.tau", point->tau);
    }
  }
  void told(const Feedback<TaskSpace>& feedback) override {
    add_head(feedback);
    trace_.add("feedback.x", feedback.desired.x);
    add_vectors(feedback.desired);
    trace_.add("feedback.x", feedback.actual.x);
    add_vectors(feedback.actual);
    trace_.add("feedback.p", feedback.error.p);
    trace_.add("feedback.phi", feedback.error.phi);
    add_vectors(feedback.error);
  }

 private:
  template <class Enumeration>
  void add(const char* name, Enumeration value) {
    trace_.add(name, static_cast<std::uint64_t>(value));
  }
  template <class Space>
  void add_head(const Feedback<Space>& feedback) {
    trace_.add("feedback.time", feedback.time_s);
    trace_.add("feedback.id", std::uint64_t{feedback.id});
    trace_.add("feedback.lost", std::uint64_t{feedback.lost});
  }
  /// What a point of the tip and an error have in common.
  template <class Vectors>
  void add_vectors(const Vectors& of) {
    trace_.add("feedback.v", of.v);
    trace_.add("feedback.a", of.a);
    trace_.add("feedback.h", of.h);
    trace_.add("feedback.dh", of.dh);
  }

  Trace& trace_;
  RobotCommand command_;
  bool written_ = false;
};

void add_events(const EventLog& events, std::uint32_t& seen, Trace& trace) {
  Event event;
  for (; seen < events.count(); ++seen) {
    if (!events.read(seen, event)) continue;
    trace.add("event.stamp", static_cast<std::uint64_t>(event.stamp_ns));
    trace.add("event.cycle", std::uint64_t{event.cycle});
    trace.add("event.code", std::uint64_t{event.code});
    trace.add("event.value", static_cast<double>(event.value));
    trace.add("event.status", static_cast<std::uint64_t>(event.status));
    trace.add("event.cause", static_cast<std::uint64_t>(event.cause));
    trace.add("event.from", static_cast<std::uint64_t>(event.from));
    trace.add("event.to", static_cast<std::uint64_t>(event.to));
    trace.add("event.joint", number_of(event.joint));
  }
}

/// Adds what a cycle leaves behind. The outputs come first, in the order in which they are
/// computed, so that the first value that differs is the nearest to its cause.
void add_cycle(const Player& player, Status status, TracedHal& outside, std::uint32_t& seen,
               Trace& trace) {
  const Executive& executive = player.executive();
  const PortTable& ports = player.pipeline().ports;
  for (int i = 0; i < ports.count(); ++i) trace.add(ports[i]);
  outside.add_command();
  const Guard::Telemetry& guard = executive.guard().telemetry();
  trace.add("guard.limited", std::uint64_t{guard.limited_cycles});
  trace.add("guard.joints", std::uint64_t{guard.limited_joints});
  trace.add("guard.jerky", std::uint64_t{guard.jerky_cycles});
  trace.add("status", static_cast<std::uint64_t>(status));
  trace.add("rung", static_cast<std::uint64_t>(executive.rung()));
  add_events(executive.events(), seen, trace);
}

struct Played {
  Status status = Status::kOk;  ///< of the last tape
  int accepted = 0;             ///< requests of all tapes
};

void play(Player& player, TracedHal& outside, Trace& trace, Played& played) {
  std::uint32_t seen = 0;
  while (player.prepare()) {
    const Status status = player.cycle();
    add_cycle(player, status, outside, seen, trace);
    trace.end_cycle();
  }
  played.status = player.executive().latched();
  played.accepted += player.accepted();
}

Text<512> refusal(const LoadError& error) {
  Text<512> line("refused: line ");
  return line << error.line << ": [" << std::string_view(error.section) << "] "
              << std::string_view(error.key) << ": " << std::string_view(error.reason) << "\n";
}

}  // namespace

int play_job(Bytes job, Waypoint<JointSpace>* store, Trace::Print print) {
  alignas(Player) static unsigned char bytes[sizeof(Player)];
  static LoadError error;
  TraceWindow window;
  for (std::uint32_t* number : {&window.first, &window.last, &window.step})
    *number = job.take<std::uint32_t>();
  const auto fill = job.take<std::uint8_t>();
  const Bytes text = next_tape(job);
  Trace trace(window, print);
  Played played;
  do {
    std::memset(bytes, fill, sizeof bytes);
    asm volatile("" : : "r"(bytes) : "memory");  // or the compiler leaves it out
    TracedHal outside(trace);
    Player& player = *new (bytes) Player(outside);
    player.widen(store, kLongestTape);
    const std::string_view file(reinterpret_cast<const char*>(text.data()), text.size());
    if (player.load(file, error) != Status::kOk) {
      print(refusal(error).c_str());
      return 2;
    }
    player.insert(next_tape(job));
    play(player, outside, trace, played);
  } while (!job.empty());
  Text<128> end("end ");
  end << static_cast<std::size_t>(trace.cycles()) << " "
      << std::string_view(hexadecimal(trace.hash())) << " " << name(played.status) << " "
      << played.accepted << "\n";
  print(end.c_str());
  return 0;
}

}  // namespace tactus
