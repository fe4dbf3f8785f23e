#include "program/session/goal_watch.hpp"

#include <algorithm>
#include <type_traits>

#include "kernel/pipeline/with_block.hpp"

namespace tactus {
namespace {

constexpr double kReportPeriods = 10.0;  // a report arrives a few cycles after its event

template <class Space>
double goal_time_s(const ReferenceClient<Space>& client) {
  const Tolerances<Space>* const tolerances = client.tolerances();
  return tolerances != nullptr ? std::max(tolerances->goal_time_s, 0.0) : 0.0;
}

/// True if the pipeline has a law whose gains can be raised; drives that take positions have
/// theirs.
bool has_law(const Pipeline& pipeline) {
  bool found = false;
  for (int i = 0; i < pipeline.count(); ++i)
    with_block(pipeline[i], [&found](const auto& block) {
      found = found || kTunes<std::decay_t<decltype(block)>>;
    });
  return found;
}

}  // namespace

VerdictAxes GoalWatch::axes() const {
  return input_.takes_poses() ? VerdictAxes::kTip : VerdictAxes::kJoints;
}

void GoalWatch::follow() {
  while (input_.takes_poses() ? session_.task_client.poll_feedback(tip_)
                              : session_.client.poll_feedback(joints_))
    reported_ = true;
}

double GoalWatch::latest_report_s() const {
  const double waits_s =
      input_.takes_poses() ? goal_time_s(session_.task_client) : goal_time_s(session_.client);
  return input_.planned_end_s() + waits_s + kReportPeriods * session_.pipeline.robot.period_s();
}

Verdict GoalWatch::last_verdict() const {
  if (!reported_) return {Status::kNotStarted};
  return input_.takes_poses() ? session_.task_client.judge_goal(tip_)
                              : session_.client.judge_goal(joints_);
}

Reason GoalWatch::given_up(const Verdict& verdict) const {
  const Message remedy = goal_remedy(verdict.status, axes(), has_law(session_.pipeline));
  Reason text;
  if (remedy.empty()) return text;
  text << (verdict.status == Status::kPathTolerance ? "path not followed: " : "goal not reached: ");
  return text << describe(verdict, axes()) << "; " << remedy;
}

Reason GoalWatch::left() {
  return Reason(
      "goal reached, but not for dwell_ms within goal_time_s after the end of the trajectory; give "
      "a shorter dwell_ms or a longer goal_time_s");
}

Reason GoalWatch::unfinished(double time_s) const {
  Reason text;
  const double end_s = input_.planned_end_s();
  if (time_s < end_s) {
    text << "the run ended at " << time_s << " s, the trajectory ends at " << end_s;
    return text << " s; give a longer --duration";
  }
  const Verdict verdict = last_verdict();
  if (text << given_up(verdict); !text.empty()) {
    return text << ", or give a longer --duration";
  }
  text << "the run ended " << time_s - end_s << " s after the planned end of the trajectory";
  return text << ", before the generator reported it; the robot was slowed down or must stay at "
                 "the goal for dwell_ms: give a longer --duration";
}

}  // namespace tactus
