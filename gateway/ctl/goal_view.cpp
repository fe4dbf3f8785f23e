#include "gateway/ctl/goal_view.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ctl {
namespace {

constexpr int kBar = 24;

TrackingError error_of(const Feedback& feedback) {
  TrackingError error;
  const auto &q_d = feedback.joint_desired().q(), &q = feedback.joint_actual().q();
  for (int i = 0; i < std::min(q_d.size(), q.size()); ++i) {
    const double difference = std::abs(q_d[i] - q[i]);
    if (!(difference > error.joint_rad)) continue;
    error.joint_rad = difference;
    error.joint = i;
  }
  const auto &x_d = feedback.task_desired().pose(), &x = feedback.task_actual().pose();
  if (x_d.size() != 7 || x.size() != 7) return error;
  double cosine = 0.0;  // of half the angle between the orientations
  for (int i = 3; i < 7; ++i) cosine += x_d[i] * x[i];
  error.tip_m = std::hypot(x_d[0] - x[0], x_d[1] - x[1], x_d[2] - x[2]);
  error.tip_rad = 2.0 * std::acos(std::min(1.0, std::abs(cosine)));
  return error;
}

}  // namespace

std::string TrackingError::text(const Welcome& welcome) const {
  if (tip_m > 0.0 || tip_rad > 0.0)
    return formatted("%.2f mm, ", tip_m * 1e3) + formatted("%.2f mrad", tip_rad * 1e3);
  const bool prismatic = joint < welcome.joints_size() && welcome.joints(joint).prismatic();
  return formatted(prismatic ? "%.2f mm" : "%.2f mrad", joint_rad * 1e3) +
         formatted(" (joint %.0f)", joint + 1.0);
}

void GoalView::take(const ToClient& message) {
  if (message.has_report() && message.report().number() == number_) take_report(message.report());
  if (message.has_feedback()) take_feedback(message.feedback());
  if (message.has_state()) take_state(message.state());
  const bool control = message.has_event() && message.event().name() == "control";
  if (control || (message.has_event() && message.event().status() != 0)) {
    output_.object("event", message.event());
    output_.say("event " + printed(message.event().name()) + ": " +
                printed(message.event().text()));
  }
}

void GoalView::take_report(const Report& report) {
  output_.object("report", report);
  const bool first = !started_ && report.outcome() == Report::STARTED;
  const bool warns = report.status() == 0 && !report.text().empty();
  if (warns) output_.say("warning: " + printed(report.text()));
  if (report.outcome() == Report::SCHEDULED) output_.say("scheduled");
  if (first) {
    started_ = true;
    start_s_ = report.time_s();
    if (report.status() != 0) output_.say("started: " + printed(report.text()));
  }
  if (report.outcome() == Report::STARVED && !starved_)
    output_.say("starved: the arm waits on its path for waypoints");
  starved_ = report.outcome() == Report::STARVED;
  if (report.outcome() < Report::SUCCEEDED) return;
  report_ = report;
  if (warns) report_.clear_text();  // already printed
  ended_ = true;
}

void GoalView::take_feedback(const Feedback& feedback) {
  output_.object("feedback", feedback);
  if (!moves()) return;
  now_ = error_of(feedback);
  if (now_.joint_rad >= largest_.joint_rad) {
    largest_.joint_rad = now_.joint_rad;
    largest_.joint = now_.joint;
  }
  largest_.tip_m = std::max(largest_.tip_m, now_.tip_m);
  largest_.tip_rad = std::max(largest_.tip_rad, now_.tip_rad);
  elapsed_s_ = feedback.time_s() - start_s_;
  passed_s_ = feedback.path_s();
  show();
}

void GoalView::take_state(const State& state) {
  state_ = state;
  at_rest_ = ended_ && state.phase() == PHASE_HOLDING;
}

void GoalView::show() {
  std::string line = phase_name(state_.phase());
  if (length_s_ > 0.0) {
    const double part = std::clamp(passed_s_ / length_s_, 0.0, 1.0);
    const int filled = static_cast<int>(part * kBar);
    line = "[" + std::string(static_cast<std::size_t>(filled), '=') + ">" +
           std::string(static_cast<std::size_t>(kBar - filled), ' ') + "] " +
           formatted("%3.0f %%  ", part * 100.0) + formatted("%.1f of ", part * length_s_) +
           formatted("%.1f s  ", length_s_) + line;
  }
  line += "  error " + now_.text(welcome_);
  if (state_.override() < 1.0) line += formatted("  override %.0f %%", state_.override() * 100.0);
  output_.progress(line);
}

void GoalView::print() const {
  output_.result(report_);
  if (started_ && elapsed_s_ > 0.0)
    output_.say("largest tracking error " + largest_.text(welcome_) +
                formatted(" in %.1f s", elapsed_s_));
}

}  // namespace tactus::ctl
