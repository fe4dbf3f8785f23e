// The verbs watch, record and info: states, events and description of the arm.
#include <google/protobuf/descriptor.pb.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "gateway/ctl/interrupt.hpp"
#include "gateway/ctl/verbs.hpp"
#include "gateway/mcap_writer.hpp"
#include "gateway/version.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ctl {
namespace {

constexpr const char* kHome = "\x1b[H\x1b[2J";

std::string per_joint(const char* format, const google::protobuf::RepeatedField<double>& values) {
  std::string text;
  for (const double value : values) text += formatted(format, value);
  return text;
}

/// States per second, by their times of arrival.
class Rate {
 public:
  double count(std::int64_t cycle, std::int64_t server_ns) {
    if (server_ns - begin_ns_ >= kSecond_ns) {
      if (begin_ns_ > 0)
        hz_ =
            static_cast<double>(cycle - begin_) * 1e9 / static_cast<double>(server_ns - begin_ns_);
      begin_ = cycle;
      begin_ns_ = server_ns;
    }
    return hz_;
  }

 private:
  std::int64_t begin_ = 0, begin_ns_ = 0;
  double hz_ = 0.0;
};

std::string one_line(const State& state) {
  return formatted("%10.3f s  ", state.time_s()) + rung_name(state.rung()) + "  " +
         phase_name(state.phase()) + "  q" + per_joint(" %.4f", state.q());
}

/// The digital outputs that are commanded, with their values.
std::string set_outputs(const State& state) {
  std::string text;
  for (unsigned i = 0; i < 32; ++i)
    if ((state.outputs_mask() >> i & 1u) != 0)
      text += formatted(" %.0f", i) + ((state.outputs() >> i & 1u) != 0 ? ":1" : ":0");
  return text;
}

/// The view that fills a terminal.
std::string whole_view(const Welcome& welcome, const State& state, double cycle_hz) {
  std::string text = kHome + printed(welcome.robot()) + " on " + printed(welcome.board()) + ", " +
                     printed(welcome.pipeline()) + formatted("   t = %.1f s\n\n", state.time_s());
  text += "rung   " + rung_name(state.rung());
  if (state.status() != 0) text += ": " + status_name(state.status());
  text += "\nphase  " + phase_name(state.phase()) + formatted("   epoch %.0f", state.epoch());
  text += "\nowner  " + (state.owner().empty() ? "nobody" : printed(state.owner()));
  text += formatted("\nspeed  override %.0f %%", state.override() * 100.0) +
          formatted(", robot %.0f %%", state.speed_scaling() * 100.0);
  text += formatted("\nrate   %.1f cycles/s", cycle_hz) + formatted(", slips %.0f", state.slips()) +
          formatted(", overruns %.0f", state.overruns()) + formatted(", lost %.0f", state.lost());
  text += formatted("\nmargin %.3f s until a stream starves\n", state.margin_s());
  if (state.outputs_mask() != 0) text += "outputs" + set_outputs(state) + "\n";
  text += "\njoint                      q         q_d     error          dq         tau\n";
  text += "                         rad         rad      mrad       rad/s         N m\n";
  for (int i = 0; i < state.q_size(); ++i) {
    char line[160];
    const bool given = i < state.q_d_size();
    std::snprintf(line, sizeof line, "%-20.20s %9.4f",
                  i < welcome.joints_size() ? printed(welcome.joints(i).name()).c_str() : "",
                  state.q(i));
    text += line;
    text += given ? formatted("   %9.4f", state.q_d(i)) +
                        formatted(" %9.2f", (state.q_d(i) - state.q(i)) * 1e3)
                  : std::string("           -         -");
    text += i < state.dq_size() ? formatted("   %9.4f", state.dq(i)) : "           -";
    text += i < state.tau_size() ? formatted("   %9.2f", state.tau(i)) : "           -";
    text += i < welcome.joints_size() && welcome.joints(i).prismatic() ? "  m, N\n" : "\n";
  }
  if (state.pose_size() == 7) text += "\ntip  " + per_joint(" %8.4f", state.pose()) + "\n";
  return text + "\nCtrl-C ends this view; the arm goes on.\n";
}

/// Subscribes and hands every state to `take` until the time is over or Ctrl-C. False: no
/// connection.
template <class Take>
bool each_state(Session& session, int default_ms, bool events, const Take& take) {
  const Options& options = session.options;
  session.client.on_message = take;
  count_interrupts();
  ToServer request;
  request.mutable_subscribe()->set_state_ms(
      static_cast<std::uint32_t>(options.every_ms > 0 ? options.every_ms : default_ms));
  request.mutable_subscribe()->set_events(events);
  if (!session.client.ask(request)) return false;
  const std::int64_t end_ns = now_ns() + static_cast<std::int64_t>(options.duration_s * 1e9);
  while (interrupts() == 0 && (!(options.duration_s > 0.0) || now_ns() < end_ns))
    if (!session.client.wait(50)) return false;
  return true;
}

/// Writes the states as rows of a CSV file.
class Recorder {
 public:
  Recorder(std::FILE* file, bool trajectory) : file_(file), trajectory_(trajectory) {}

  void take(const ToClient& message, const Welcome& welcome) {
    if (!message.has_state()) return;
    const State& state = message.state();
    if (rows_ == 0) begin(state, welcome);
    if (state.server_ns() == last_ns_) return;
    last_ns_ = state.server_ns();
    ++rows_;
    std::fprintf(file_, "%.6f", static_cast<double>(last_ns_ - first_ns_) * 1e-9);
    numbers(state.q());
    if (!trajectory_) {
      for (const auto* values : {&state.dq(), &state.tau(), &state.q_d(), &state.dq_d()})
        numbers(*values);
      std::fprintf(file_, ",%s,%s,%.17g", rung_name(state.rung()).c_str(),
                   phase_name(state.phase()).c_str(), state.override());
    }
    std::fputc('\n', file_);
  }
  int rows() const { return rows_; }

 private:
  void begin(const State& state, const Welcome& welcome) {
    first_ns_ = state.server_ns();
    std::fputs("time_s", file_);
    const auto header = [&](const char* prefix, int count, const char* of, const char* prismatic) {
      for (int i = 0; i < count; ++i) {
        const bool slides = i < welcome.joints_size() && welcome.joints(i).prismatic();
        std::fprintf(file_, ",%s%d_%s", prefix, i + 1, slides ? prismatic : of);
      }
    };
    header("q", state.q_size(), "rad", "m");
    if (!trajectory_) {
      header("dq", state.dq_size(), "rad_s", "m_s");
      header("tau", state.tau_size(), "Nm", "N");
      header("q_d", state.q_d_size(), "rad", "m");
      header("dq_d", state.dq_d_size(), "rad_s", "m_s");
      std::fputs(",rung,phase,override", file_);
    }
    std::fputc('\n', file_);
  }
  void numbers(const google::protobuf::RepeatedField<double>& values) {
    for (const double value : values) std::fprintf(file_, ",%.17g", value);
  }

  std::FILE* file_;
  bool trajectory_;
  int rows_ = 0;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
};

/// Writes states and events into an MCAP file, at the times of the server.
class MessageRecorder {
 public:
  explicit MessageRecorder(std::FILE* file) {
    google::protobuf::FileDescriptorSet files;
    State::descriptor()->file()->CopyTo(files.add_file());
    const std::string schema = files.SerializeAsString();
    writer_.begin(file, std::string("tactusctl ") + kVersion);
    const auto add = [&](const char* message, const char* topic) {
      return writer_.add_channel(writer_.add_schema(message, schema), topic);
    };
    state_ = add("tactus.State", "/state");
    event_ = add("tactus.Event", "/event");
  }

  void take(const ToClient& message) {
    if (message.has_state()) write(state_, message.state());
    if (message.has_event()) write(event_, message.event());
  }
  /// Returns the number of messages.
  int end() {
    writer_.end();
    return messages_;
  }

 private:
  template <class Timed>
  void write(McapWriter::Id channel, const Timed& message) {
    writer_.write(channel, message.server_ns(), message.SerializeAsString());
    ++messages_;
  }

  McapWriter writer_;
  McapWriter::Id state_, event_;
  int messages_ = 0;
};

}  // namespace

int watch(Session& session) {
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  Rate rate;
  each_state(session, 100, true, [&](const ToClient& message) {
    if (message.has_event()) {
      session.output.object("event", message.event());
      session.output.say("event " + printed(message.event().name()) + ": " +
                         printed(message.event().text()));
    }
    if (!message.has_state()) return;
    const State& state = message.state();
    const double hz = rate.count(static_cast<std::int64_t>(state.cycle()), state.server_ns());
    session.output.object("state", state);
    session.output.say(terminal ? whole_view(session.client.welcome(), state, hz)
                                : one_line(state));
  });
  return session.client.exit_code();
}

int record(Session& session) {
  const std::string& out = session.options.out;
  if (is_mcap(out) && session.options.trajectory) {
    session.client.refuse(out + ": --trajectory writes CSV; leave it out, or name a file .csv");
    return session.client.exit_code();
  }
  std::FILE* file = out == "-" ? stdout : std::fopen(out.c_str(), "wb");
  if (file == nullptr) {
    session.client.refuse(out + ": " + std::strerror(errno) + "; give a file that can be written");
    return session.client.exit_code();
  }
  std::string count;
  if (is_mcap(out)) {
    MessageRecorder recorder(file);
    each_state(session, 10, true, [&](const ToClient& message) { recorder.take(message); });
    count = std::to_string(recorder.end()) + " messages";
  } else {
    Recorder recorder(file, session.options.trajectory);
    each_state(session, 10, false,
               [&](const ToClient& message) { recorder.take(message, session.client.welcome()); });
    count = std::to_string(recorder.rows()) + " states";
  }
  const bool failed = std::ferror(file) != 0;
  const bool closed = (file == stdout ? std::fflush(file) : std::fclose(file)) == 0;
  if (!closed || failed)
    session.client.refuse(out + ": " + std::strerror(errno) + "; rows are missing");
  else if (out != "-")
    session.output.say(out + ": " + count);
  return session.client.exit_code();
}

int info(Session& session) {
  const Welcome& welcome = session.client.welcome();
  session.output.object("welcome", welcome);
  session.output.say(printed(welcome.robot()) + " on " + printed(welcome.board()) + ", pipeline " +
                     printed(welcome.pipeline()) +
                     formatted(", %.3g ms per cycle", welcome.period_s() * 1e3));
  session.output.say(std::string("takes ") + (welcome.takes_joints() ? "joints" : "no joints") +
                     (welcome.takes_poses() ? ", poses" : ", no poses") +
                     formatted(", chunks of %.0f", welcome.longest_chunk()) +
                     formatted(", trajectories through a window of %.0f", welcome.window()));
  std::string outputs;
  for (unsigned i = 0, named = 0; i < 32; ++i) {
    if ((welcome.outputs() >> i & 1u) == 0) continue;
    outputs += formatted(" %.0f", i);
    const int name = static_cast<int>(named++);
    if (name < welcome.output_names_size()) outputs += " " + printed(welcome.output_names(name));
  }
  if (!outputs.empty()) session.output.say("digital outputs" + outputs);
  session.output.say(
      "joint                       from         to      rad/s    rad/s^2    rad/s^3        N m");
  for (const Joint& joint : welcome.joints()) {
    char line[160];
    std::snprintf(line, sizeof line, "%-20.20s %10.4f %10.4f %10.4g %10.4g %10.4g %10.4g",
                  printed(joint.name()).c_str(), joint.min_rad(), joint.max_rad(), joint.velocity(),
                  joint.acceleration(), joint.jerk(), joint.effort());
    session.output.say(line + std::string(joint.continuous()  ? "  without end"
                                          : joint.prismatic() ? "  in m and N"
                                                              : ""));
  }
  return kSucceeded;
}

}  // namespace tactus::ctl
