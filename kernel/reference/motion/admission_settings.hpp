// AdmissionSettings: the settings by which both ends of a channel judge trajectories.
#pragma once

namespace tactus {

/// Settings of admission; set when the pipeline is loaded, the same at both ends of the channel.
template <class Space>
struct AdmissionSettings {
  typename Space::Limits limits;
  double period_s = 0.0;
  /// Fraction of the acceleration and jerk limits that a trajectory leaves free, so that it can be
  /// stopped on its path at any time.
  double stop_reserve = 0.02;
  /// How much longer a trajectory may become by slowing down where it exceeds a limit, as a
  /// fraction.
  double max_stretch = 0.1;
};

}  // namespace tactus
