// Random paths of all joints, of kinds that planners send, with results computed without the
// kernel: their derivatives, their use of the limits, and the quickest stop that acceleration
// allows. They are scaled in time so that the worst place uses a given share of a limit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/reference/motion/trajectory.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "tests/reference/generator/reference_bench.hpp"

namespace tactus {

enum class PathKind { kSmooth, kWild, kLinearAcceleration, kConstantAcceleration, kLines };
inline constexpr PathKind kPathKinds[] = {PathKind::kSmooth, PathKind::kWild,
                                          PathKind::kLinearAcceleration,
                                          PathKind::kConstantAcceleration, PathKind::kLines};
inline constexpr const char* kPathKindNames[] = {
    "quintic, smooth", "quintic, wild", "linear acceleration", "constant acceleration", "lines"};

/// Derivatives of all joints at one path time.
struct PathPlace {
  JointVector q, d1, d2, d3;
};

/// Polynomials between knots, with their derivatives and their quickest stop.
class KnownPath {
 public:
  static constexpr int kMostPieces = 100;

  KnownPath() = default;
  /// The cubics or quintics through the waypoints of a trajectory.
  explicit KnownPath(const Trajectory<JointSpace>& trajectory) : pieces_(trajectory.count - 1) {
    for (int i = 0; i <= pieces_; ++i) time_[at(i)] = trajectory.at(i).time_s;
    for (int i = 0; i < pieces_; ++i) {
      const JointSpace::Point &from = trajectory.at(i).point, &to = trajectory.at(i + 1).point;
      const bool quintic = (trajectory.fields & kAccelerationField) != 0;
      for (int j = 0; j < kDof; ++j) {
        const double begin[3] = {from.q[j], from.dq[j], from.ddq[j]};
        const double end[3] = {to.q[j], to.dq[j], to.ddq[j]};
        quintic ? join_quintic(i, j, begin, end) : join_cubic(i, j, begin, end);
      }
    }
  }

  double end_s() const { return time_[at(pieces_)]; }
  double time_s(int knot) const { return time_[at(knot)]; }

  /// Returns the derivatives at path time s; at a knot, or up to a billionth of a second before it,
  /// those of the next piece.
  PathPlace place(double s) const { return on_piece(piece(s + 1e-9), s); }
  PathPlace on_piece(int k, double s) const {
    const double t = s - time_[at(k)];
    PathPlace place;
    for (int j = 0; j < kDof; ++j) {
      double d[4] = {};
      for (int n = 5; n >= 0; --n) {
        d[3] = d[3] * t + 3.0 * d[2];
        d[2] = d[2] * t + 2.0 * d[1];
        d[1] = d[1] * t + d[0];
        d[0] = d[0] * t + c_[at(k)][at(j)][at(n)];
      }
      place.q[j] = d[0];
      place.d1[j] = d[1];
      place.d2[j] = d[2];
      place.d3[j] = d[3];
    }
    return place;
  }

  /// Returns the time of the stop from rate 1 at s that brakes at every place as hard as
  /// acceleration allows, s; infinite if the path ends before.
  double quickest_stop_s(double s) const {
    constexpr double kStep_s = 5e-5;
    double w = 1.0, time_s = 0.0;
    while (w > 1e-9 && s < end_s()) {
      const double u = lowest_slope(place(s), w);
      const double ahead = std::min(kStep_s, end_s() - s + 1e-9);
      const double next = std::max(0.0, w + 2.0 * u * ahead);
      if (u >= 0.0 || next > 0.0) {
        time_s += 2.0 * ahead / (std::sqrt(w) + std::sqrt(next));
      } else {
        time_s += std::sqrt(w) / -u;
      }
      w = next;
      s += ahead;
    }
    return w > 1e-9 ? kInfinity : time_s;
  }

 protected:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int piece(double s) const {
    const auto after = std::upper_bound(time_.begin(), time_.begin() + pieces_ + 1, s);
    return std::clamp(static_cast<int>(after - time_.begin()) - 1, 0, pieces_ - 1);
  }
  double lowest_slope(const PathPlace& p, double w) const {
    double lo = -1e9;
    for (int j = 0; j < kDof; ++j) {
      if (std::fabs(p.d1[j]) < 1e-12) continue;
      const double sign = p.d1[j] > 0.0 ? 1.0 : -1.0;
      lo = std::fmax(lo, (-limits_.ddq_max[j] - sign * p.d2[j] * w) / std::fabs(p.d1[j]));
    }
    return std::fmin(lo, 0.0);
  }

  void join_quintic(int k, int j, const double* from, const double* to) {
    const double T = time_[at(k + 1)] - time_[at(k)];
    auto& c = c_[at(k)][at(j)];
    c = {from[0], from[1], 0.5 * from[2], 0.0, 0.0, 0.0};
    // p, v and a: what the last three coefficients must add at T.
    const double p = to[0] - c[0] - T * (c[1] + T * c[2]), v = to[1] - c[1] - 2.0 * T * c[2];
    const double a = to[2] - 2.0 * c[2];
    c[3] = (10.0 * p - 4.0 * v * T + 0.5 * a * T * T) / (T * T * T);
    c[4] = (-15.0 * p + 7.0 * v * T - a * T * T) / (T * T * T * T);
    c[5] = (6.0 * p - 3.0 * v * T + 0.5 * a * T * T) / (T * T * T * T * T);
  }
  void join_cubic(int k, int j, const double* from, const double* to) {
    const double T = time_[at(k + 1)] - time_[at(k)];
    auto& c = c_[at(k)][at(j)];
    c = {from[0], from[1], 0.0, 0.0, 0.0, 0.0};
    const double p = to[0] - c[0] - T * c[1], v = to[1] - c[1];
    c[2] = (3.0 * p - v * T) / (T * T);
    c[3] = (v * T - 2.0 * p) / (T * T * T);
  }

  int pieces_ = 0;
  JointLimits limits_;
  std::array<double, kMostPieces + 1> time_{};
  std::array<std::array<std::array<double, 6>, kDof>, kMostPieces> c_{};
};

class RandomPath : public KnownPath {
 public:
  static constexpr int kPieces = 63;

  RandomPath(PathKind kind, Random& random, double share) : kind_(kind) {
    pieces_ = kPieces;
    static constexpr double kShortest[] = {0.3, 0.15, 0.1, 0.1, 0.05};
    static constexpr double kLongest[] = {0.9, 0.9, 0.45, 0.45, 0.3};
    const std::size_t k = static_cast<std::size_t>(kind);
    for (int i = 0; i < kPieces; ++i)
      time_[at(i + 1)] = time_[at(i)] + random.uniform(kShortest[k], kLongest[k]);
    for (int j = 0; j < kDof; ++j) {
      if (kind == PathKind::kSmooth || kind == PathKind::kWild) quintics(j, random);
      if (kind == PathKind::kLines) lines(j, random);
      if (kind == PathKind::kLinearAcceleration) accelerations(j, random, false);
      if (kind == PathKind::kConstantAcceleration) accelerations(j, random, true);
    }
    scale(worst(share) * (1.0 + 1e-4));  // extrema are between samples
  }

  /// Writes the path as waypoints of a trajectory, with the fields that give the same path.
  void fill(Trajectory<JointSpace>& trajectory, int first, int last) const {
    const bool quintic = kind_ == PathKind::kSmooth || kind_ == PathKind::kWild;
    trajectory.fields = kind_ == PathKind::kLines ? Fields{0}
                        : quintic ? static_cast<Fields>(kVelocityField | kAccelerationField)
                                  : Fields{kVelocityField};
    for (int i = first; i <= last; ++i) {
      const PathPlace here = on_piece(std::min(i, kPieces - 1), time_[at(i)]);
      Waypoint<JointSpace>& waypoint = trajectory.waypoints[i % trajectory.capacity];
      waypoint.time_s = time_[at(i)];
      waypoint.point = {here.q, here.d1, here.d2, JointVector::Zero()};
    }
  }

 private:
  void quintics(int j, Random& random) {
    const bool wild = kind_ == PathKind::kWild;
    double from[3] = {};
    for (int k = 0; k < kPieces; ++k) {
      const double T = time_[at(k + 1)] - time_[at(k)];
      const double v1 = random.uniform(-1.0, 1.0), mean = 0.5 * (from[1] + v1);
      const double beside = (wild ? 0.5 : 0.05) * random.uniform(-1.0, 1.0);
      const double to[3] = {from[0] + (mean + beside) * T, v1,
                            (wild ? 3.0 : 0.5) * random.uniform(-1.0, 1.0) / T};
      join_quintic(k, j, from, to);
      std::copy(to, to + 3, from);
    }
  }
  void lines(int j, Random& random) {
    double q = 0.0;
    for (int k = 0; k < kPieces; ++k) {
      const double v = random.uniform(-1.0, 1.0);
      c_[at(k)][at(j)] = {q, v, 0.0, 0.0, 0.0, 0.0};
      q += v * (time_[at(k + 1)] - time_[at(k)]);
    }
  }
  void accelerations(int j, Random& random, bool steps) {
    double q = 0.0, v = 0.0, a = 0.0;
    for (int k = 0; k < kPieces; ++k) {
      const double T = time_[at(k + 1)] - time_[at(k)], bias = v > 0.0 ? -0.6 : 0.6;
      const double next = random.uniform(-1.0, 1.0) + bias * std::fabs(v) / 1.5;
      if (steps) a = next;
      const double j3 = steps ? 0.0 : (next - a) / T;
      c_[at(k)][at(j)] = {q, v, 0.5 * a, j3 / 6.0, 0.0, 0.0};
      q += T * (v + T * (0.5 * a + T * j3 / 6.0));
      v += T * (a + 0.5 * T * j3);
      a += T * j3;
    }
  }
  /// Returns the factor by which times must grow to keep the limits, those of acceleration and jerk
  /// times `share`.
  double worst(double share) const {
    double scale = 0.0;
    for (int k = 0; k < kPieces; ++k) {
      for (int i = 0; i <= 100; ++i) {
        const double s = time_[at(k)] + (time_[at(k + 1)] - time_[at(k)]) * i / 100;
        const PathPlace p = on_piece(k, s);
        for (int j = 0; j < kDof; ++j) {
          scale = std::fmax(scale, std::fabs(p.d1[j]) / limits_.dq_max[j]);
          scale = std::fmax(scale, std::sqrt(std::fabs(p.d2[j]) / (share * limits_.ddq_max[j])));
          scale = std::fmax(scale, std::cbrt(std::fabs(p.d3[j]) / (share * limits_.dddq_max[j])));
        }
      }
    }
    return scale;
  }
  void scale(double factor) {
    for (double& t : time_) t *= factor;
    for (auto& piece : c_) {
      for (auto& c : piece) {
        double power = 1.0;
        for (double& x : c) {
          x /= power;
          power *= factor;
        }
      }
    }
  }

  PathKind kind_;
};

}  // namespace tactus
