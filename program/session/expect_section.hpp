// ExpectSection: the [expect] section of a pipeline file: what a run must have seen. A run that has
// not seen it does not succeed, however well it followed its trajectory.
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/core/load_error.hpp"
#include "kernel/core/port.hpp"

namespace tactus {

struct ExpectSection {
  In<Quantity::kWrench> h;  ///< the measured wrench; the section is below its block
  /// Bounds of the contact force: the largest magnitude of h's force, averaged by a low-pass.
  double contact_force_min = 0.0, contact_force_max = 1e4;
  double average_s = 0.5;  ///< time constant of the average; noise does not count as contact
  /// Largest tracking error of a joint and of the tip's position; 0: not stated.
  double tracking_rad = 0.0, tracking_m = 0.0;
  Text<63> collision_stop;  ///< "tool table": before these two meet, the arm is stopped

  /// True if a bound of the force can fail. [any]
  bool states_force() const { return contact_force_min > 0.0 || contact_force_max < 1e4; }

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.optional("h", h);
    visit.param("contact_force_min", contact_force_min, Range{0.0, 1e4}, "N");
    visit.param("contact_force_max", contact_force_max, Range{0.0, 1e4}, "N");
    visit.param("average_s", average_s, Range{0.0, 60.0}, "s");
    visit.param("tracking_rad", tracking_rad, kNonNegative, "rad");
    visit.param("tracking_m", tracking_m, kNonNegative, "m");
    visit.text("collision_stop", collision_stop,
               "pair before whose contact [collision] stops the arm: tool table");
  }
};

}  // namespace tactus
