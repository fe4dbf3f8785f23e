#include "hal/can/bus_load.hpp"

#include <cmath>

namespace tactus::can {
namespace {

int rounded(double value) {
  return std::isfinite(value) && std::abs(value) < 1e9 ? static_cast<int>(std::lround(value)) : -1;
}

}  // namespace

Status BusLoad::judge(const char* interface, int joints, double period_us, double most,
                      Message& why) const {
  const double limit_us = most * period_us;
  if (worst_us() <= limit_us) return Status::kOk;  // NaN is not
  why = Message();
  why << "bus " << interface << ": " << rounded(worst_us()) << " us of frames in a cycle of "
      << rounded(period_us) << " us, at most " << rounded(limit_us) << " us (" << joints
      << (joints == 1 ? " joint, " : " joints, ");
  if (rates_.fd())
    why << "CAN FD " << rounded(rates_.nominal_hz / 1e3) << "/" << rounded(rates_.data_hz / 1e3)
        << " kbit/s); use more buses, packed commands or a higher data bit rate";
  else
    why << "classic " << rounded(rates_.nominal_hz / 1e3)
        << " kbit/s); use more buses, packed commands or CAN FD";
  return Status::kOverBudget;
}

}  // namespace tactus::can
