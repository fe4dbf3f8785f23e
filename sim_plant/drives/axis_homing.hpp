// AxisHoming: the homing mode of one drive (CiA 402-2 / IEC 61800-7-201, homing mode), and where it
// counts from: an incremental encoder counts from power-on until it is homed.
//
// Methods 17 and 18 go to the limit switch at the lower or the upper end of the joint, and back to
// where it opens; 35 and 37 take the present place. The home position then reads 607Ch.
#pragma once

#include "sim_plant/drives/dictionary.hpp"

namespace tactus::drives {

struct HomingSettings {
  bool incremental = false;
  std::int32_t offset = 0;                   ///< 607Ch when power comes on
  bool shows = false;                        ///< by statusword bit 14, whether it is homed
  double lower_rad = -2.5, upper_rad = 2.5;  ///< where the limit switches close
};

/// How the next homings go wrong; an endless one stands still.
enum class HomingFault : std::uint8_t { kNone, kEndless, kErrorAtRest, kErrorMoving };

class AxisHoming {
 public:
  explicit AxisHoming(Dictionary& dictionary) : dictionary_(dictionary) {}

  void power_on(const HomingSettings& settings);
  void spoil(HomingFault fault) { fault_ = fault; }
  /// Takes a controlword; `active`: operation is enabled in homing mode. [any]
  void command(std::uint16_t controlword, bool active);
  /// Goes on where the joint is, rad; `scale`: rad per increment. [cyclic]
  void step(double q, double scale);
  /// Of the motion, rad/s. [cyclic]
  double velocity(double scale) const;
  /// Notes the first place of an encoder that has just been switched on. [cyclic]
  void measure(double q);

  double origin_rad() const { return origin_rad_; }  ///< where it counts 0
  bool referenced() const { return referenced_; }
  /// Bits of the statusword in homing mode. [any]
  std::uint16_t bits() const;

 private:
  enum class Phase : std::uint8_t { kIdle, kSeeks, kReturns, kAttained, kError };

  void attain(double q, double scale);

  Dictionary& dictionary_;
  HomingSettings settings_;
  HomingFault fault_ = HomingFault::kNone;
  Phase phase_ = Phase::kIdle;
  std::uint16_t controlword_ = 0;
  bool referenced_ = true, counts_ = true;  // counts_: from a known place
  double origin_rad_ = 0.0;
};

}  // namespace tactus::drives
