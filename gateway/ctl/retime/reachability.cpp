#include "gateway/ctl/retime/reachability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::ctl {
namespace {

/// A blend, as a share of the steps of its section, and at least.
constexpr int kBlendShare = 10, kStepsOfBlend = 4;
constexpr int kBisections = 60;
constexpr double kBracket = 1e-14;  // of x: to rounding

/// Path derivatives at a node.
struct Slopes {
  Numbers d1, d2;
  double x_max = 0.0;
};

Slopes slopes_at(const PathNode& node, const MotionBounds& bounds) {
  const PathPlace place = node.piece->at(node.offset);
  const Eigen::Index channels = bounds.v.size();
  const double by_v = (lengths(place.dq, channels) / bounds.v).maxCoeff();
  const double by_j = std::cbrt((lengths(place.dddq, channels) / bounds.j).maxCoeff());
  const double speed = 1.0 / std::max(by_v, by_j);
  return {place.dq, place.ddq, speed * speed};
}

std::vector<PathNode> grid(const PathSection& section, int steps) {
  double length = 0.0;
  for (const PathPiece& piece : section.pieces) length += piece.length;
  const int in_blend = std::max(kStepsOfBlend, steps / kBlendShare);
  std::vector<PathNode> nodes;
  double begin = 0.0;
  for (const PathPiece& piece : section.pieces) {
    const double share = piece.length / length * steps;
    const int count = std::max(piece.straight() ? 2 : in_blend, static_cast<int>(share) + 1);
    for (int i = 0; i < count; ++i) {
      const double offset = piece.length * i / count;
      nodes.push_back({&piece, offset, begin + offset});
    }
    begin += piece.length;
  }
  const PathPiece& last = section.pieces.back();
  nodes.push_back({&last, last.length, begin});
  return nodes;
}

struct Interval {
  double low, high;

  void keep(double least, double most) {
    low = std::max(low, least);
    high = std::min(high, most);
  }
};

/// |u m + x n| <= a for vectors m and n: along m an interval of u, across it a bound of x.
class Ball {
 public:
  Ball(const Eigen::VectorXd& m, const Eigen::VectorXd& n, double a) : length_(m.norm()), a_(a) {
    const Eigen::VectorXd axis = m / (length_ > 0.0 ? length_ : 1.0);
    along_ = axis.dot(n);
    across_ = (n - along_ * axis).norm();
  }

  void keep(double x, Interval& u) const {
    const double left = a_ * a_ - across_ * across_ * (x * x);
    if (!(left >= 0.0)) {
      u.high = -std::numeric_limits<double>::infinity();
    } else if (length_ > 0.0) {
      const double reach = std::sqrt(left);
      u.keep((-along_ * x - reach) / length_, (-along_ * x + reach) / length_);
    }
  }

 private:
  double length_, along_ = 0.0, across_ = 0.0, a_;
};

/// The bounds of an interval of the grid.
class Step {
 public:
  Step(const Slopes& here, const Slopes& there, double length, const Numbers& a)
      : whole_(2.0 * length), x_max_(here.x_max) {
    const Eigen::Index size = here.d1.size() / a.size();
    const auto channel = [size](const Numbers& vector, Eigen::Index k) {
      return vector.matrix().segment(k * size, size);
    };
    balls_.reserve(2 * static_cast<std::size_t>(a.size()));
    for (Eigen::Index k = 0; k < a.size(); ++k) {
      balls_.emplace_back(channel(here.d1, k), channel(here.d2, k), a[k]);
      balls_.emplace_back(channel(there.d1 + whole_ * there.d2, k), channel(there.d2, k), a[k]);
    }
  }

  /// Returns the u that lead from x to one up to `next_x`; none if high < low.
  Interval from(double x, double next_x) const {
    Interval u = {-x / whole_, (next_x - x) / whole_};
    for (const Ball& ball : balls_) ball.keep(x, u);
    return u;
  }

  /// Returns the largest x from which one up to `next_x` can be reached.
  double controllable(double next_x) const {
    const auto reaches = [&](double x) {
      const Interval u = from(x, next_x);
      return u.low <= u.high;
    };
    if (reaches(x_max_)) return x_max_;
    double least = 0.0, beyond = x_max_;
    for (int i = 0; i < kBisections && beyond - least > kBracket * beyond; ++i) {
      const double x = 0.5 * (least + beyond);
      (reaches(x) ? least : beyond) = x;
    }
    return least;
  }

 private:
  double whole_, x_max_;
  std::vector<Ball> balls_;
};

}  // namespace

std::vector<PathNode> time_optimal(const PathSection& section, const MotionBounds& bounds,
                                   int steps) {
  std::vector<PathNode> nodes = grid(section, steps);
  std::vector<Slopes> slopes;
  slopes.reserve(nodes.size());
  for (const PathNode& node : nodes) slopes.push_back(slopes_at(node, bounds));
  const std::size_t last = nodes.size() - 1;
  std::vector<Step> steps_between;
  steps_between.reserve(last);
  for (std::size_t i = 0; i < last; ++i)
    steps_between.emplace_back(slopes[i], slopes[i + 1], nodes[i + 1].s - nodes[i].s, bounds.a);
  std::vector<double> most(nodes.size(), 0.0);
  for (std::size_t i = last; i-- > 0;) most[i] = steps_between[i].controllable(most[i + 1]);
  for (std::size_t i = 0; i < last; ++i) {
    PathNode &node = nodes[i], &next = nodes[i + 1];
    const double step = next.s - node.s;
    const Interval u = steps_between[i].from(node.x, most[i + 1]);
    // The interval may be a point, up to rounding.
    const double largest = u.high >= u.low ? u.high : (u.high + u.low) / 2.0;
    next.x = std::clamp(node.x + 2.0 * step * largest, 0.0, most[i + 1]);
    node.u = (next.x - node.x) / (2.0 * step);
    const double speeds = std::sqrt(node.x) + std::sqrt(next.x);
    if (!(speeds > 0.0)) return {};
    next.time_s = node.time_s + 2.0 * step / speeds;
  }
  return nodes;
}

}  // namespace tactus::ctl
