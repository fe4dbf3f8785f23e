// send and check: a trajectory file, of any length, by the credit that the server gives.
#include <unistd.h>

#include <algorithm>
#include <optional>

#include "gateway/ctl/goal_view.hpp"
#include "gateway/ctl/input_devices.hpp"
#include "gateway/ctl/interrupt.hpp"
#include "gateway/ctl/row_reader.hpp"
#include "gateway/ctl/verbs.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ctl {
namespace {

constexpr const char* kPlaybackKeys =
    "p pauses, r resumes, + and - change the speed; Ctrl-C cancels on the path";
constexpr const char* kNoTurns =
    "--wrap nearest: the pipeline takes no joint without end; leave it out";
constexpr int kRowsWait_ms = 20;
constexpr int kRest_ms = 10000;  // longest time that an arm takes to stop on its path

Begin::Interpolation interpolation(const std::string& name) {
  if (name == "linear") return Begin::LINEAR;
  if (name == "cubic") return Begin::CUBIC;
  if (name == "quintic") return Begin::QUINTIC;
  if (name == "monotone") return Begin::MONOTONE;
  return Begin::BY_FIELDS;
}

class Sender {
 public:
  explicit Sender(Session& session) : s_(session) {}

  int run();

 private:
  bool read_once();
  bool begin();
  void take(const ToClient& message);
  bool feed();
  bool send_part(ToServer& request);
  bool cancel();
  bool press(const std::string& keys);
  bool follow();
  bool detaches() const { return s_.options.detach && all_sent_ && view_.moves(); }
  void come_to_rest();
  int detach();
  int code() const;

  Session& s_;
  RowReader reader_;
  GoalView view_{s_.output, s_.client.welcome()};
  std::uint32_t credit_ = 0;
  bool check_ = s_.options.verb == Verb::kCheck;
  bool all_sent_ = false, canceled_ = false, unreadable_ = false;
  std::int64_t give_up_ns_ = 0;  // after a cancel
  double rate_ = 1.0;            // override
};

/// Reads a file that can be read twice to its end, so that a row that cannot be read is found
/// before the arm moves.
bool Sender::read_once() {
  const RowReader::Allow allow = {false, s_.options.partial};
  if (!reader_.open(s_.options.file, joint_names(s_.client.welcome()), allow))
    return s_.client.refuse(reader_.error());
  if (!reader_.regular()) return true;
  Row row;
  std::int64_t count = 0;
  RowResult taken = RowResult::kRow;
  while ((taken = reader_.next(row)) == RowResult::kRow) ++count;
  if (taken == RowResult::kRefused) return s_.client.refuse(reader_.error());
  if (count == 0) return s_.client.refuse(s_.options.file + ": the file has no waypoints");
  view_.set_length(row.time_s);
  s_.output.say(s_.options.file + ": " + std::to_string(count) + " waypoints, " +
                formatted("%.3f s", row.time_s));
  return reader_.rewind() || s_.client.refuse(reader_.error());
}

bool Sender::begin() {
  ToServer subscription;
  subscription.mutable_subscribe()->set_state_ms(50);
  subscription.mutable_subscribe()->set_feedback_ms(check_ ? 0 : 50);
  subscription.mutable_subscribe()->set_events(!check_);
  if (!s_.client.ask(subscription)) return false;
  ToServer request;
  Begin& begin = *request.mutable_begin();
  const RowForm& form = reader_.form();
  fill_terms(s_, form.held_joints, *begin.mutable_terms());
  begin.set_interpolation(interpolation(s_.options.interpolation));
  begin.set_exact(s_.options.exact);
  begin.set_poses(form.poses);
  begin.set_velocities(form.velocities);
  begin.set_accelerations(form.accelerations);
  begin.set_efforts(form.efforts);
  begin.set_check(check_);
  if (s_.options.wrap == "nearest") {
    if (!offers(s_.client.welcome(), FEATURE_WRAP)) return s_.client.refuse(kNoTurns);
    request.add_requires(FEATURE_WRAP);
    begin.set_wrap(Begin::NEAREST);
  }
  if (!s_.client.ask(request)) return false;
  view_.follow(request.number());
  return true;
}

void Sender::take(const ToClient& message) {
  if (message.has_credit()) credit_ += message.credit().waypoints();
  view_.take(message);
}

bool Sender::send_part(ToServer& request) {
  if (request.part().time_s_size() == 0) return true;
  credit_ -= static_cast<std::uint32_t>(request.part().time_s_size());
  return s_.client.post(request) != 0;
}

/// Sends what the credit allows. False: the connection is gone.
bool Sender::feed() {
  const auto longest = static_cast<int>(std::max(1U, s_.client.welcome().longest_part()));
  while (!all_sent_ && !view_.ended() && credit_ > 0) {
    const int most = static_cast<int>(std::min(credit_, static_cast<std::uint32_t>(longest)));
    ToServer request;
    Part& part = *request.mutable_part();
    Row row;
    RowResult taken = RowResult::kRow;
    while (part.time_s_size() < most && (taken = reader_.next(row, 0)) == RowResult::kRow) {
      part.add_time_s(row.time_s);
      for (const double number : row.numbers) part.add_numbers(number);
    }
    if (!send_part(request)) return false;
    if (taken == RowResult::kNotYet) return true;
    if (taken == RowResult::kRow) continue;
    all_sent_ = true;
    unreadable_ = taken == RowResult::kRefused;
    if (unreadable_) return !s_.client.refuse(reader_.error()) && cancel();
    ToServer end;
    end.mutable_end();
    if (s_.client.post(end) == 0) return false;
  }
  return true;
}

bool Sender::cancel() {
  canceled_ = true;
  give_up_ns_ = now_ns() + kRest_ms * kMillisecond_ns;
  ToServer request;
  request.mutable_cancel();
  return s_.client.post(request) != 0;
}

/// Keys while it moves. False: the connection is gone.
bool Sender::press(const std::string& keys) {
  for (const char key : keys) {
    ToServer request;
    if (key == 'p') request.mutable_pause();
    if (key == 'r') request.mutable_resume()->set_stops(s_.client.stops());
    if (key == '+' || key == '-') {
      rate_ = std::clamp(rate_ + (key == '+' ? 0.1 : -0.1), 0.0, 1.0);
      request.mutable_override()->set_rate(rate_);
      request.mutable_override()->set_stops(s_.client.stops());
    }
    if (request.request_case() != ToServer::REQUEST_NOT_SET && s_.client.post(request) == 0)
      return false;
  }
  return true;
}

bool Sender::follow() {
  const bool by_keys = !check_ && s_.options.file != "-" && isatty(STDIN_FILENO) != 0;
  const std::optional<RawTerminal> raw(by_keys ? std::optional<RawTerminal>(std::in_place)
                                               : std::nullopt);
  if (by_keys) s_.output.say(kPlaybackKeys);
  std::string keys;
  while (!view_.ended() && !detaches()) {
    if (interrupts() > 1 || (canceled_ && now_ns() > give_up_ns_)) return false;
    if (interrupts() == 1 && !canceled_) {
      s_.output.say("canceling; Ctrl-C again leaves");
      if (!cancel()) return false;
    }
    if (!canceled_ && !feed()) return false;
    const bool waits_for_rows = !all_sent_ && credit_ > 0 && !canceled_;
    if (!s_.client.wait(waits_for_rows ? kRowsWait_ms : -1, by_keys ? STDIN_FILENO : -1))
      return false;
    if (by_keys && (!take_keys(keys) || !press(keys))) return false;
  }
  return true;
}

void Sender::come_to_rest() {
  const std::int64_t end_ns = now_ns() + kRest_ms * kMillisecond_ns;
  while (!view_.at_rest() && now_ns() < end_ns && interrupts() < 2)
    if (!s_.client.wait(100)) return;
}

int Sender::code() const {
  if (s_.client.gone()) return kNoConnection;
  if (unreadable_) return kRefused;
  if (!view_.ended()) return kEndedOtherwise;
  if (succeeded(view_.report().outcome())) return kSucceeded;
  return view_.report().outcome() == Report::REFUSED ? kRefused : kEndedOtherwise;
}

/// Leaves while it moves: without an owner, what runs continues to its end.
int Sender::detach() {
  s_.client.release_lease();
  s_.output.say("started; it goes on to its end. tactusctl watch shows it, cancel ends it");
  return s_.client.exit_code();
}

int Sender::run() {
  if (!read_once()) return s_.client.exit_code();
  if (!check_ && !s_.client.take_lease()) return s_.client.exit_code();
  count_interrupts();
  s_.client.on_message = [this](const ToClient& message) { take(message); };
  if (!begin()) {
    s_.client.release_lease();
    return s_.client.exit_code();
  }
  if (follow()) {
    if (detaches()) return detach();
    if (!check_) come_to_rest();
    view_.print();
    s_.client.release_lease();
  } else if (!s_.client.gone()) {
    s_.output.error("left; the server brings the arm to rest on its path when the lease ends",
                    kEndedOtherwise);
  }
  return code();
}

}  // namespace

int send_trajectory(Session& session) {
  return Sender(session).run();
}

}  // namespace tactus::ctl
