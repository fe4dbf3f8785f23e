// HalfPlanes: a linear program in two unknowns, solved on the polygon of what is feasible. Each
// constraint cuts the polygon; a linear function has its maximum in a corner. Exact up to rounding,
// and with the few constraints of an arm's joints as fast as an incremental solver.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace tactus::ctl {

class HalfPlanes {
 public:
  struct Corner {
    double u, x;
  };

  /// Begins with a convex polygon, given by its corners in order.
  explicit HalfPlanes(std::vector<Corner> corners) : corners_(std::move(corners)) {}

  /// Cuts off what violates a u + b x <= c. [any]
  void cut(double a, double b, double c) {
    kept_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Corner &from = corners_[i], &to = corners_[(i + 1) % corners_.size()];
      const double over = a * from.u + b * from.x - c, next = a * to.u + b * to.x - c;
      if (over <= 0.0) kept_.push_back(from);
      if ((over < 0.0 && next > 0.0) || (over > 0.0 && next < 0.0)) {
        const double part = over / (over - next);
        kept_.push_back({from.u + part * (to.u - from.u), from.x + part * (to.x - from.x)});
      }
    }
    corners_.swap(kept_);
  }

  /// Returns the largest feasible x; minus infinity if nothing is feasible. [any]
  double largest_x() const {
    double largest = -std::numeric_limits<double>::infinity();
    for (const Corner& corner : corners_) largest = std::max(largest, corner.x);
    return largest;
  }

 private:
  std::vector<Corner> corners_, kept_;
};

}  // namespace tactus::ctl
