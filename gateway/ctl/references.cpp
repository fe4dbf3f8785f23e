// The verbs point and stream: single targets, and targets as they arrive.
#include <cmath>

#include "gateway/ctl/goal_view.hpp"
#include "gateway/ctl/interrupt.hpp"
#include "gateway/ctl/row_reader.hpp"
#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {
namespace {

constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;
constexpr int kRowWait_ms = 5;
constexpr int kStarted_ms = 200;  // in which a point has begun to be reached

/// Returns the target of a row; its form defines the numbers.
void fill_target(const RowForm& form, const std::vector<double>& numbers, Point& point) {
  std::size_t at = 0;
  const auto take = [&](int count, auto* to) {
    for (int i = 0; i < count; ++i) to->Add(numbers[at++]);
  };
  const auto take_groups = [&](auto* position, auto* velocity, auto* acceleration, auto* effort) {
    take(form.position(), position);
    if (form.velocities) take(form.derivative(), velocity);
    if (form.accelerations) take(form.derivative(), acceleration);
    if (form.efforts) take(form.derivative(), effort);
  };
  if (form.poses) {
    TaskPoint& task = *point.mutable_task();
    take_groups(task.mutable_pose(), task.mutable_twist(), task.mutable_acceleration(),
                task.mutable_wrench());
  } else {
    JointPoint& joint = *point.mutable_joint();
    take_groups(joint.mutable_q(), joint.mutable_dq(), joint.mutable_ddq(), joint.mutable_tau());
  }
}

/// Waits until the arm holds the point, or was stopped.
void wait_at_rest(Session& session, std::uint32_t number) {
  GoalView view(session.output, session.client.welcome());
  view.follow(number);
  session.client.on_message = [&](const ToClient& message) { view.take(message); };
  ToServer subscription;
  subscription.mutable_subscribe()->set_state_ms(20);
  if (!session.client.ask(subscription)) return;
  const std::int64_t begun_ns = now_ns() + kStarted_ms * std::int64_t{1'000'000};
  ToClient ended;
  ended.mutable_report()->set_number(number);
  ended.mutable_report()->set_outcome(Report::EXECUTED);
  view.take(ended);
  while (interrupts() == 0 && (now_ns() < begun_ns || !view.at_rest()))
    if (!session.client.wait(100)) return;
  if (view.state().status() != 0)
    session.client.refuse("the arm was stopped on its way: " + status_name(view.state().status()) +
                          "; tactusctl rearm takes it over again");
}

class Streamer {
 public:
  explicit Streamer(Session& session) : s_(session) {}

  bool run();

 private:
  bool send(const Row& row);
  bool pace();
  void take(const ToClient& message);

  Session& s_;
  RowReader reader_;
  std::int64_t next_ns_ = 0;
  int sent_ = 0, executed_ = 0, superseded_ = 0;
  bool refused_ = false;
};

void Streamer::take(const ToClient& message) {
  if (message.has_answer() && message.answer().status() != 0 && !refused_) {
    refused_ = true;
    s_.client.refuse(message.answer().text());
  }
  if (!message.has_report()) return;
  const Report& report = message.report();
  s_.output.object("report", report);
  executed_ += report.outcome() == Report::EXECUTED ? 1 : 0;
  superseded_ += report.outcome() == Report::SUPERSEDED ? 1 : 0;
  if (report.outcome() == Report::REFUSED && !refused_) {
    refused_ = true;
    s_.client.refuse("row in line " + std::to_string(reader_.line()) +
                     " or before it: " + report.text());
  }
}

bool Streamer::send(const Row& row) {
  ToServer request;
  Point& point = *request.mutable_point();
  fill_terms(s_, reader_.form().held_joints, *point.mutable_terms());
  fill_target(reader_.form(), row.numbers, point);
  ++sent_;
  return s_.client.post(request) != 0;
}

/// Waits until the next row is due.
bool Streamer::pace() {
  if (!(s_.options.period_ms > 0.0)) return true;
  if (next_ns_ == 0) next_ns_ = now_ns();
  next_ns_ += static_cast<std::int64_t>(s_.options.period_ms * 1e6);
  while (now_ns() < next_ns_ && interrupts() == 0 && !refused_)
    if (!s_.client.wait(static_cast<int>((next_ns_ - now_ns() + 999'999) / 1'000'000)))
      return false;
  return true;
}

bool Streamer::run() {
  s_.client.on_message = [this](const ToClient& message) { take(message); };
  const RowReader::Allow allow = {true, s_.options.partial};
  if (!reader_.open(s_.options.file, joint_names(s_.client.welcome()), allow))
    return s_.client.refuse(reader_.error());
  if (!s_.client.take_lease()) return false;
  Row row;
  while (interrupts() == 0 && !refused_) {
    const RowResult taken = reader_.next(row, 0);
    if (taken == RowResult::kEnd) break;
    if (taken == RowResult::kRefused) return s_.client.refuse(reader_.error());
    if (taken == RowResult::kRow && (!send(row) || !pace())) return false;
    if (!s_.client.wait(taken == RowResult::kNotYet ? kRowWait_ms : 0)) return false;
  }
  while (executed_ + superseded_ < sent_ && !refused_ && interrupts() < 2)
    if (!s_.client.wait(100)) return false;
  s_.output.say(std::to_string(sent_) + " targets: " + std::to_string(executed_) + " executed, " +
                std::to_string(superseded_) + " superseded");
  s_.client.release_lease();
  return !refused_;
}

}  // namespace

int send_point(Session& session) {
  const Options& options = session.options;
  const Welcome& welcome = session.client.welcome();
  RowForm form;
  form.poses = options.pose;
  form.joints = welcome.joints_size();
  if (static_cast<int>(options.numbers.size()) != form.position()) {
    session.client.refuse(std::to_string(options.numbers.size()) + " numbers, but a " +
                          (form.poses ? "pose has 7: x y z qw qx qy qz"
                                      : "point of " + welcome.robot() + " has " +
                                            std::to_string(form.joints) +
                                            "; with --pose it is one of the tip"));
    return session.client.exit_code();
  }
  std::vector<double> numbers = options.numbers;
  if (options.degrees && !options.pose)
    for (int i = 0; i < form.joints; ++i)
      if (!welcome.joints(i).prismatic()) numbers[static_cast<std::size_t>(i)] *= kDegree_rad;
  ToServer request;
  fill_terms(session, 0, *request.mutable_point()->mutable_terms());
  fill_target(form, numbers, *request.mutable_point());
  if (!session.client.take_lease()) return session.client.exit_code();
  count_interrupts();
  if (session.client.ask_and_wait(request) && options.wait) wait_at_rest(session, request.number());
  session.client.release_lease();
  return interrupts() > 0 ? kEndedOtherwise : session.client.exit_code();
}

int send_stream(Session& session) {
  count_interrupts();
  Streamer(session).run();
  return interrupts() > 0 && session.client.exit_code() == kSucceeded ? kEndedOtherwise
                                                                      : session.client.exit_code();
}

}  // namespace tactus::ctl
