#include "hal/can/bus_load.hpp"

#include <cmath>

namespace tactus::can {
namespace {

int rounded(double value) {
  return std::isfinite(value) && std::abs(value) < 1e9 ? static_cast<int>(std::lround(value)) : -1;
}

}  // namespace

Status BusLoad::judge(const char* interface, int joints, double period_us, double most, bool packs,
                      Message& why) const {
  const double limit_us = most * period_us;
  if (worst_us() <= limit_us) return Status::kOk;  // NaN is not
  why = Message();
  why << "bus " << interface << ": " << rounded(worst_us()) << " us of frames in a cycle of "
      << rounded(period_us) << " us, at most " << rounded(limit_us) << " us (" << joints
      << (joints == 1 ? " joint, " : " joints, ") << (rates_.fd() ? "CAN FD " : "classic ")
      << rounded(rates_.nominal_hz / 1e3);
  if (rates_.fd()) why << "/" << rounded(rates_.data_hz / 1e3);
  why << " kbit/s); use more buses" << (packs ? ", packed commands" : "")
      << (rates_.fd() ? " or a higher data bit rate" : " or CAN FD");
  return Status::kOverBudget;
}

Status judge_queue(const char* interface, int queue, int frames, Message& why) {
  if (queue < 0 || queue >= frames) return Status::kOk;
  why = Message("bus ");
  why << interface << ": its queue holds " << queue << " frames, a cycle sends up to " << frames
      << "; ip link set " << interface << " txqueuelen 64";
  return Status::kTooLarge;
}

}  // namespace tactus::can
