#include "gateway/chunk_fit.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "kernel/reference/motion/time_rounding.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/judge_channels.hpp"
#include "kernel/reference/space/task_space.hpp"

#if TACTUS_CHUNK_TARGETS > 0
namespace tactus {
namespace {

constexpr auto kMost = static_cast<std::size_t>(kChunkTargets);
/// Least share of a limit that the stop at the end may use, whatever the curve itself takes, and
/// the share that both may take together.
constexpr double kLeastShare = 0.2, kMostShare = 0.9;
/// Fastest change of the rate of path time, 1/s and 1/s^2, where the limits would allow more.
constexpr double kFastest = 20.0, kSharpest = 1000.0;
/// Periods by which the stop begins earlier than it must, for the cycle in which that is noticed.
constexpr double kEarly = 2.0;

template <class Space>
struct Fit {
  using Difference = typename Space::Difference;
  int n = 0;
  std::array<double, kMost> t;
  std::array<Difference, kMost> f;  // at the knots, from the target in the middle

  double h(std::size_t i) const { return t[i + 1] - t[i]; }
};

/// Takes the one of the two rotation vectors on an axis that is nearest to the one before it.
template <class Space>
void unwrap(typename Space::Difference& now, const typename Space::Difference& before) {
  if constexpr (std::is_same_v<Space, TaskSpace>) {
    const Vector3 phi = now.x.template tail<3>(), last = before.x.template tail<3>();
    const double angle = phi.norm();
    if (!(angle > 1e-6)) return;
    const Vector3 other = (1.0 - 2.0 * 3.14159265358979323846 / angle) * phi;
    if ((other - last).norm() < (phi - last).norm()) now.x.template tail<3>() = other;
  }
}

/// The symmetric matrix R + L Q^T W Q of bandwidth two, factorized in place, where W is one but for
/// a last knot that is `fixed`: 0.
class Band {
 public:
  template <class Space>
  Band(const Fit<Space>& fit, double smoothing, bool fixed)
      : size_(static_cast<std::size_t>(fit.n) - 2) {
    for (std::size_t k = 0; k < size_; ++k) {
      const double a = 1.0 / fit.h(k), b = 1.0 / fit.h(k + 1);
      const double last = fixed && k + 1 == size_ ? 0.0 : b * b;
      d_[k] = (fit.h(k) + fit.h(k + 1)) / 3.0 + smoothing * (a * a + (a + b) * (a + b) + last);
      if (k + 1 >= size_) continue;
      const double c = 1.0 / fit.h(k + 2);
      e_[k] = fit.h(k + 1) / 6.0 - smoothing * b * (a + 2.0 * b + c);
      if (k + 2 < size_) f_[k] = smoothing * b * c;
    }
    for (std::size_t k = 0; k < size_; ++k) {
      if (k > 0) d_[k] -= e_[k - 1] * e_[k - 1] * d_[k - 1];
      if (k > 1) d_[k] -= f_[k - 2] * f_[k - 2] * d_[k - 2];
      if (k + 1 >= size_) continue;
      if (k > 0) e_[k] -= f_[k - 1] * e_[k - 1] * d_[k - 1];
      e_[k] /= d_[k];
      if (k + 2 < size_) f_[k] /= d_[k];
    }
  }
  /// Solves for the vectors in x, in place.
  template <class Vectors>
  void solve(Vectors& x) const {
    for (std::size_t k = 1; k < size_; ++k) {
      x[k] -= e_[k - 1] * x[k - 1];
      if (k > 1) x[k] -= f_[k - 2] * x[k - 2];
    }
    for (std::size_t k = 0; k < size_; ++k) x[k] /= d_[k];
    for (std::size_t k = size_ - 1; k-- > 0;) {
      x[k] -= e_[k] * x[k + 1];
      if (k + 2 < size_) x[k] -= f_[k] * x[k + 2];
    }
  }

 private:
  std::size_t size_;
  std::array<double, kMost> d_, e_, f_;
};

/// Sets velocities and accelerations at the knots to those of the spline, and moves the positions
/// if it smooths, but a last one that is `fixed`.
template <class Space>
void fit_spline(Fit<Space>& fit, double smoothing_s, bool fixed) {
  using Vector = typename Space::Difference::Vector;
  const auto n = static_cast<std::size_t>(fit.n);
  std::array<Vector, kMost> g;  // second derivatives at the inner knots
  auto& f = fit.f;
  if (n > 2) {
    const double mean_h = (fit.t[n - 1] - fit.t[0]) / static_cast<double>(n - 1);
    const double square = smoothing_s * smoothing_s, smoothing = square * square / mean_h;
    for (std::size_t k = 0; k + 2 < n; ++k)
      g[k] = (f[k + 2].x - f[k + 1].x) / fit.h(k + 1) - (f[k + 1].x - f[k].x) / fit.h(k);
    const Band band(fit, smoothing, fixed);
    band.solve(g);
    for (std::size_t k = 0; k + 2 < n; ++k) {
      const double a = 1.0 / fit.h(k), b = 1.0 / fit.h(k + 1);
      f[k].x -= smoothing * a * g[k];
      f[k + 1].x += smoothing * (a + b) * g[k];
      if (!fixed || k + 3 < n) f[k + 2].x -= smoothing * b * g[k];
      f[k + 1].ddx = g[k];
    }
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = fit.h(i);
    const Vector secant = (f[i + 1].x - f[i].x) / h;
    f[i].dx = secant - h / 6.0 * (2.0 * f[i].ddx + f[i + 1].ddx);
    f[i + 1].dx = secant + h / 6.0 * (f[i].ddx + 2.0 * f[i + 1].ddx);
  }
}

/// Sets the accelerations at the knots to those of the parabolas through the given velocities.
template <class Space>
void fit_velocities(Fit<Space>& fit) {
  const auto n = static_cast<std::size_t>(fit.n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = i > 0 ? i - 1 : 0, b = i + 1 < n ? i + 1 : i;
    fit.f[i].ddx = (fit.f[b].dx - fit.f[a].dx) / (fit.t[b] - fit.t[a]);
  }
}

/// Sets from when on, and how, path time stops if no successor arrives: the stop uses what the
/// curve itself leaves of every limit on the way that it takes.
template <class Space>
void plan_stop_at_end(const Fit<Space>& fit, const AdmissionSettings<Space>& settings,
                      ChunkCurve<Space>& curve) {
  constexpr int kSize = Space::kChannelSize;
  const typename Space::Peaks limits = Space::peaks(settings.limits);
  typename Space::Peaks most;
  for (int i = fit.n - 1; i > 0; --i) {
    const auto to = static_cast<std::size_t>(i);
    double a = kFastest, j = kSharpest;
    for (int c = 0; c < Space::kChannels; ++c) {
      const auto k = static_cast<std::size_t>(c);
      const auto part = [&](const auto& vector) {
        return vector.template segment<kSize>(c * kSize).norm();
      };
      for (const std::size_t end : {to - 1, to}) {
        most.v[k] = std::max(most.v[k], part(fit.f[end].dx));
        most.a[k] = std::max(most.a[k], part(fit.f[end].ddx));
      }
      most.j[k] = std::max(most.j[k], part(fit.f[to].ddx - fit.f[to - 1].ddx) / fit.h(to - 1));
      const double v = std::max(most.v[k], 1e-9);
      a = std::min(a,
                   std::max(kMostShare * limits.a[k] - most.a[k], kLeastShare * limits.a[k]) / v);
      const double taken = most.j[k] + 3.0 * most.a[k] * a;
      j = std::min(j, std::max(kMostShare * limits.j[k] - taken, kLeastShare * limits.j[k]) / v);
    }
    const double stop_s = a * a >= j ? 2.0 / std::sqrt(j) : 1.0 / a + a / j;
    const double begin_s = curve.end_s() - 0.5 * stop_s - kEarly * settings.period_s;
    curve.brake_a = a;
    curve.brake_j = j;
    curve.brake_way_s = 0.5 * stop_s;
    curve.brake_s = std::max(begin_s, curve.first_s());
    if (begin_s >= fit.t[to - 1]) return;
  }
}

/// Judges the mean velocity from one target to the next: limits shape what exceeds them a little.
template <class Space>
Verdict judge_step(const typename Space::Point& from, const typename Space::Point& to, double dt_s,
                   const typename Space::Limits& limits) {
  constexpr double kMostOver = 4.0;
  Verdict verdict = judge_reach<Space>(from, to, limits, kMostOver * dt_s);
  verdict.value *= kMostOver;
  verdict.limit *= kMostOver;
  return verdict;
}

}  // namespace

template <class Space>
Verdict judge_chunk(const Chunk<Space>& chunk, const AdmissionSettings<Space>& settings) {
  if (chunk.count < 1 || chunk.count > kChunkTargets)
    return {Status::kReferenceSize, -1, -1, static_cast<double>(chunk.count),
            static_cast<double>(kChunkTargets)};
  if (!(chunk.fade_s >= 0.0 && chunk.fade_s <= kLongestFade_s))
    return {Status::kBadValue, -1, -1, chunk.fade_s, kLongestFade_s};
  if (!(chunk.smoothing_s >= 0.0 && chunk.smoothing_s < kInfinity))
    return {Status::kBadValue, -1, -1, chunk.smoothing_s, 0.0};
  if (!(std::abs(chunk.outputs_lead_s) <= kLongestLead_s))
    return {Status::kBadValue, -1, -1, chunk.outputs_lead_s, kLongestLead_s};
  const typename Space::Limits limits = Space::known_limits(chunk.header, settings.limits);
  const typename Space::Placement placement = Space::anywhere(chunk.header, limits);
  double earliest_s = -kInfinity;
  for (int i = 0; i < chunk.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double time_s = chunk.time_s[k];
    if (!std::isfinite(time_s)) return {Status::kReferenceNotFinite, i, -1, time_s, 0.0};
    if (!(time_s >= earliest_s)) return {Status::kReferenceTime, i, -1, time_s, earliest_s};
    if (!(time_s - chunk.time_s[0] <= kLongestChunk_s))
      return {Status::kReferenceTime, i, -1, time_s, chunk.time_s[0] + kLongestChunk_s};
    earliest_s = time_s + settings.period_s - kTimeRounding_s;
    typename Space::Point placed = Space::placed(chunk.targets[k], placement);
    static_cast<void>(Space::saturate(placed, limits));  // as in fit_chunk(), which reports it
    Verdict verdict = Space::judge_waypoint(placed, limits);
    if (verdict.ok() && chunk.velocities)
      verdict = judge_velocity<Space>(Space::rates(chunk.targets[k]), limits);
    if (verdict.ok() && i > 0)
      verdict = judge_step<Space>(chunk.targets[k - 1], chunk.targets[k],
                                  time_s - chunk.time_s[k - 1], limits);
    verdict.waypoint = i;
    if (!verdict.ok()) return verdict;
  }
  return {};
}

template Verdict judge_chunk(const Chunk<JointSpace>&, const AdmissionSettings<JointSpace>&);
template Verdict judge_chunk(const Chunk<TaskSpace>&, const AdmissionSettings<TaskSpace>&);

template <class Space>
void fit_chunk(const Chunk<Space>& chunk, const AdmissionSettings<Space>& settings,
               ChunkCurve<Space>& curve) {
  const auto n = static_cast<std::size_t>(chunk.count);
  const typename Space::Limits limits = Space::known_limits(chunk.header, settings.limits);
  const typename Space::Placement placement = Space::anywhere(chunk.header, limits);
  curve.saturation = {};
  const auto inside = [&](std::size_t i) {
    typename Space::Point target = Space::placed(chunk.targets[i], placement);
    Verdict saturation = Space::saturate(target, limits);
    saturation.waypoint = static_cast<int>(i);
    if (curve.saturation.ok()) curve.saturation = saturation;
    return target;
  };
  const typename Space::Point origin = inside(n / 2).at_rest();
  Fit<Space> fit;
  fit.n = chunk.count;
  for (std::size_t i = 0; i < n; ++i) {
    const typename Space::Point target = inside(i);
    fit.t[i] = chunk.time_s[i];
    fit.f[i] = Space::difference(chunk.velocities ? target : target.at_rest(), origin);
    fit.f[i].ddx.setZero();
  }
  for (std::size_t i = n / 2 + 1; i < n; ++i) unwrap<Space>(fit.f[i], fit.f[i - 1]);
  for (std::size_t i = n / 2; i-- > 0;) unwrap<Space>(fit.f[i], fit.f[i + 1]);
  if (chunk.velocities && n > 1) fit_velocities(fit);
  if (!chunk.velocities) fit_spline(fit, chunk.smoothing_s, chunk.ends);
  if (chunk.ends) fit.f[n - 1].dx = fit.f[n - 1].ddx = 0.0 * fit.f[n - 1].dx;
  curve.count = chunk.count;
  curve.ends = chunk.ends;
  curve.stamped = chunk.stamped;
  curve.sender = chunk.sender;
  curve.epoch = chunk.epoch;
  curve.sequence = chunk.sequence;
  curve.header = chunk.header;
  curve.fade_s = chunk.fade_s;
  curve.outputs_mask = chunk.outputs_mask;
  curve.outputs_lead_s = chunk.outputs_lead_s;
  if (chunk.outputs_mask != 0)
    std::copy(chunk.outputs.begin(), chunk.outputs.begin() + chunk.count, curve.outputs.begin());
  for (std::size_t i = 0; i < n; ++i) {
    Knot<Space>& knot = curve.knots[i] = {chunk.time_s[i], Space::sum(origin, fit.f[i])};
    if (Space::judge_waypoint(knot.point, limits).ok()) continue;
    fit.f[i].x = Space::difference(inside(i), origin).x;  // smoothed beyond a limit
    knot.point = Space::sum(origin, fit.f[i]);
  }
  if (n == 1) curve.knots[0].point = chunk.targets[0];
  plan_stop_at_end(fit, settings, curve);
}

template void fit_chunk(const Chunk<JointSpace>&, const AdmissionSettings<JointSpace>&,
                        ChunkCurve<JointSpace>&);
template void fit_chunk(const Chunk<TaskSpace>&, const AdmissionSettings<TaskSpace>&,
                        ChunkCurve<TaskSpace>&);

}  // namespace tactus
#endif
