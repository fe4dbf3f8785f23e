#include "hal/ur/set_points.hpp"

#include <limits>

#include "hal/ur/servo_program.hpp"

namespace tactus::ur {

void SetPoints::start(int max_missed) {
  max_missed_ = max_missed;
  count_ = unsent_ = 0;
  last_.setZero();
}

Status SetPoints::send(const Vector6& q) {
  bool sent = false;
  last_ = q;
  count_ = count_ < std::numeric_limits<std::int32_t>::max() ? count_ + 1 : 1;
  return write(count_, q, sent);
}

Status SetPoints::clear(bool& sent) {
  count_ = 0;
  return write(0, last_, sent);
}

Status SetPoints::end(bool& sent) {
  return write(kServoEnded, last_, sent);
}

Status SetPoints::write(std::int32_t count, const Vector6& q, bool& sent) {
  const Socket::Sent result = session_.send(count, q);
  sent = result == Socket::Sent::kAll;
  unsent_ = result == Socket::Sent::kNothing ? unsent_ + 1 : 0;
  if (result == Socket::Sent::kLost) {
    why_ = Message("RTDE: the connection no longer accepts set-points");
    return Status::kConnectionLost;
  }
  if (unsent_ <= max_missed_) return Status::kOk;
  why_ = Message("RTDE: no set-point could be sent for ");
  why_ << unsent_ << (unsent_ == 1 ? " period" : " periods") << ", limit " << max_missed_
       << "; check the network";
  return Status::kBusTimeout;
}

}  // namespace tactus::ur
