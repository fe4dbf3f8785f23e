#include "kernel/control/cartesian_pose.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"
#include "kernel/math/so3.hpp"

namespace tactus {
namespace {

using Inverse = DampedInverse<kDof>;

/// Part of the joints' acceleration that brakes a correction; the rest is for the reference.
constexpr double kBrakingShare = 0.5;
/// Part of it with which the posture's velocity changes, so that the task need not wait for it.
constexpr double kPostureShare = 0.25;

bool finite(const Pose& pose) {
  return pose.p.allFinite() && pose.r.coeffs().allFinite();
}

/// Returns the twist that moves x onto x_d in one second, in the base frame.
[[gnu::noinline]] Vector6 pose_error(const Pose& x_d, const Pose& x) {
  return stacked(x_d.p - x.p, log_so3(x_d.r * x.r.conjugate()));
}

/// Returns the length of an error or a twist; a metre counts as a radian.
[[gnu::noinline]] double length(const Vector6& v) {
  return v.norm();
}

/// Returns the joint furthest beyond its bounds, or -1.
int worst_joint(const JointVector& dq, const JointVector& low, const JointVector& high) {
  int worst = -1;
  double most = 1e-12;  // rad/s; a joint that was left out is at its bound within rounding
  for (int i = 0; i < kDof; ++i) {
    const double beyond = std::max(low[i] - dq[i], dq[i] - high[i]);
    if (beyond > most) {
      most = beyond;
      worst = i;
    }
  }
  return worst;
}

/// Returns the largest share of `dq`, 0 to 1, that can be added to `to` within the bounds.
double share_within(const JointVector& to, const JointVector& dq, const JointVector& low,
                    const JointVector& high) {
  double share = 1.0;
  for (int i = 0; i < kDof; ++i) {
    const double speed = std::abs(dq[i]);
    const double room = std::max(0.0, dq[i] > 0.0 ? high[i] - to[i] : to[i] - low[i]);
    if (speed * share > room) share = room / speed;
  }
  return share;
}

}  // namespace

/// Demand on the tip: the twist of its reference, and the correction of its error with the floor of
/// the damping.
struct CartesianPose::Demand {
  Vector6 v_d, correction;
  double floor;

  Vector6 v() const { return v_d + correction; }
  JointVector joints(const Inverse& inverse) const { return inverse.times(v_d, correction); }
};

/// Joint velocities for a demand, and the joints that were not left out.
struct CartesianPose::Task {
  JointVector dq;
  Eigen::Array<bool, kDof, 1> free;
};

double CartesianPose::largest_gain() const {
  return std::max(params.position_gain.maxCoeff(), params.rotation_gain.maxCoeff());
}

/// Returns the factor by which a twist exceeds the tip's speed limits; 1 within them.
double CartesianPose::excess(const Vector6& v) const {
  return std::max(
      {1.0, v.head<3>().norm() / params.max_speed, v.tail<3>().norm() / params.max_angular_speed});
}

/// Returns the error e of the measured pose.
Vector6 CartesianPose::error() const {
  return pose_error(*x_d, *x) - params.measurement_delay * *v_d;
}

/// Returns the twist that corrects an error, within the tip's speed limits.
Vector6 CartesianPose::correction(const Vector6& e) const {
  const Vector6 wanted = stacked(params.position_gain.cwiseProduct(e.head<3>()),
                                 params.rotation_gain.cwiseProduct(e.tail<3>()));
  return wanted / excess(wanted);
}

Status CartesianPose::judge(double dt_s) const {
  return largest_gain() * (dt_s + params.measurement_delay) <= kMaxGainPeriods
             ? Status::kOk
             : Status::kUnstableGain;
}

Status CartesianPose::start(double dt_s) {
  TRY(judge(dt_s));
  if (!q->allFinite()) return Status::kStateNotFinite;
  const JointLimits& limits = params.limits;
  motion_.start({limits.q_min + params.position_margin, limits.q_max - params.position_margin,
                 limits.dq_max, limits.ddq_max, params.max_lead},
                *q);
  q_c.value = posture_ = *q;
  dq_c.value.setZero();
  posture_dq_.setZero();
  transfer_.clear();
  tracking_ = 1.0;
  scale.value = 1.0;
  sigma.value = damping.value = 0.0;
  return resume();
}

Status CartesianPose::resume() {
  braked_ = at_once_ = false;
  rests_s_ = 0.0;
  return Status::kOk;
}

void CartesianPose::retune(const Params& next, const JointLimits& /*limits*/) {
  const Vector6 e = error();
  const Vector6 before = correction(e) + transfer_.value();
  params = next;
  transfer_.start(before - correction(e), kTransfer_s);
}

Status CartesianPose::step(double dt_s) {
  JointVector dq;
  Status status = Status::kOk;
  if (at_once_)
    motion_.brake(dt_s);
  else if (status = command_velocity(dt_s, dq); status == Status::kOk)
    motion_.step(dq, *q, dt_s);
  else
    motion_.halt();
  q_c.value = motion_.q();
  dq_c.value = motion_.dq();
  return status == Status::kOk && left_ && !braked_ ? Status::kPathTolerance : status;
}

Status CartesianPose::command_velocity(double dt_s, JointVector& dq) {
  if (!(finite(*x) && J->allFinite() && q->allFinite())) return Status::kStateNotFinite;
  const Vector6 e = error();
  const double passed = speed_scaling.wired() ? *speed_scaling : 1.0;
  if (!(e.allFinite() && v_d->allFinite() && q_posture->allFinite() && passed >= 0.0 &&
        passed <= 1.0))
    return Status::kReferenceFault;
  run_down(dt_s);
  left_ = leaves(e, dt_s);

  transfer_.step(dt_s);
  Vector6 wanted = correction(e);
  if (transfer_.runs()) wanted += transfer_.value();
  const double rate = largest_gain();
  Demand demand{*v_d, wanted, rate > 0.0 ? kBend * length(wanted) / rate : 0.0};
  Inverse inverse(*J, params.damping_onset, demand.floor);
  const double distance = inverse.sigma();
  share_out(inverse, dt_s, demand);
  demand.correction *= passed * tracking_;
  const double fastest = excess(demand.v());
  demand.v_d /= fastest;
  demand.correction /= fastest;
  const Task task = solve(demand, inverse, dt_s);

  const JointVector low = motion_.lowest(dt_s).cwiseMax(-params.limits.dq_max);
  const JointVector high = motion_.highest(dt_s).cwiseMin(params.limits.dq_max);
  const double share = share_within(JointVector::Zero(), task.dq, low, high);
  dq = share * task.dq;
  if constexpr (kDof > 6) {
    const JointVector rest = posture_velocity(task, inverse, dt_s);
    dq += share_within(dq, rest, low, high) * rest;
  }
  if (!dq.allFinite()) return Status::kCommandNotFinite;
  const double speed = dq.norm(), before = motion_.dq().norm();
  if (braked_ && tracking_ < 1.0 && speed > before) dq *= before / speed;
  scale.value = share / fastest;
  sigma.value = distance;
  damping.value = inverse.lambda();
  return Status::kOk;
}

/// When braked on the path with the reference at rest, fades out the correction of the remaining
/// error; the arm then gets no faster, as it would where the error was in balance with the posture,
/// which no longer acts. After the brake it fades in again.
void CartesianPose::run_down(double dt_s) {
  stands_ = x_d->p == last_x_d_.p && x_d->r.coeffs() == last_x_d_.r.coeffs();
  if (braked_ && stands_) tracking_ = std::max(0.0, tracking_ - dt_s / kRunDown_s);
  if (!braked_) tracking_ = std::min(1.0, tracking_ + dt_s / kRunDown_s);
  last_x_d_ = *x_d;
}

/// True if the error differs by more than the tolerance from its mean, or has grown by more from
/// the least one, since kSettles_s after x_d came to rest. An arm that comes nearer lets it shrink,
/// and one that creeps at the edge of its reach turns it slowly.
bool CartesianPose::leaves(const Vector6& e, double dt_s) {
  rests_s_ += dt_s;
  if (length(pose_error(*x_d, held_x_d_)) > kRests * params.hold_tolerance) {
    held_x_d_ = *x_d;
    rests_s_ = 0.0;
  }
  const double error = length(e), most = params.hold_tolerance;
  const bool settled = rests_s_ > kSettles_s;
  const bool nearer = error < (settled ? kNearer : 1.0) * least_;
  mean_ += std::min(1.0, dt_s / kMean_s) * (e - mean_);
  if (nearer || rests_s_ == 0.0) mean_ = e;
  if (nearer || !settled) least_ = error;
  return most > 0.0 && settled && (length(e - mean_) > most || error > least_ + most);
}

Verdict CartesianPose::held() const {
  if (!left_) return {};
  const Vector6 e = error(), swing = e - mean_;
  const double grown = length(e) - least_, swung = length(swing);
  const Vector6& way = swung > grown ? swing : e;
  const int axis = way.head<3>().norm() < way.tail<3>().norm() ? 3 : 0;
  return {Status::kPathTolerance, -1, axis, std::max(swung, grown), params.hold_tolerance};
}

/// Scales the correction so that every joint can brake before it is complete: at the rate of the
/// greatest gain K the joint has |dq| / K to go.
void CartesianPose::share_out(const Inverse& inverse, double dt_s, Demand& demand) const {
  const double rate = largest_gain();
  const JointVector dq = inverse.correcting(demand.correction);
  double share = 1.0;
  for (int i = 0; i < kDof; ++i) {
    const double speed = std::abs(dq[i]);
    const double most =
        stopping_speed(speed / rate, kBrakingShare * params.limits.ddq_max[i], dt_s);
    if (speed * share > most) share = most / speed;
  }
  demand.correction *= share;
}

/// Limits the joints whose part of the demand exceeds what their position limits admit, one after
/// the other, the furthest beyond first; the free joints take the rest of the task. The joints are
/// left out of `inverse` too.
CartesianPose::Task CartesianPose::solve(const Demand& demand, Inverse& inverse,
                                         double dt_s) const {
  const JointVector low = motion_.lowest(dt_s), high = motion_.highest(dt_s);
  Task task{demand.joints(inverse), Eigen::Array<bool, kDof, 1>::Constant(true)};
  Demand rest = demand;
  JointVector fixed = JointVector::Zero();
  LoopBound<kDof> limited;
  for (int left_out = 0; left_out < kDof; ++left_out) {
    limited.tick();
    const int i = worst_joint(task.dq, low, high);
    if (i < 0) break;
    fixed[i] = std::clamp(task.dq[i], low[i], high[i]);
    rest.v_d -= J->col(i) * fixed[i];
    task.free[i] = false;
    inverse.leave_out(i);
    task.dq = rest.joints(inverse) + fixed;
  }
  return task;
}

/// Returns the null-space velocity that moves the free joints towards the posture or, braked, to
/// rest. The posture of the start moves no elbow while the tip rests.
JointVector CartesianPose::posture_velocity(const Task& task, const Inverse& inverse, double dt_s) {
  const JointVector most = kPostureShare * dt_s * params.limits.ddq_max;
  const JointVector& posture = q_posture.wired() ? *q_posture : posture_;
  const bool rests = braked_ || (stands_ && !q_posture.wired());
  const JointVector wanted =
      rests ? JointVector(JointVector::Zero()) : JointVector(params.posture_gain * (posture - *q));
  posture_dq_ += (wanted - posture_dq_).cwiseMax(-most).cwiseMin(most);
  return inverse.null_space(task.free.select(posture_dq_, 0.0));
}

}  // namespace tactus
