// SetPoints: the registers through which the program on the robot is given its set-points, as in
// hal/ur/servo_program.hpp. Nothing else is ever written to them.
#pragma once

#include "hal/ur/rtde_client.hpp"

namespace tactus::ur {

class SetPoints {
 public:
  /// `why` explains a Status that is not kOk.
  SetPoints(RtdeClient& session, Message& why) : session_(session), why_(why) {}

  /// Begins with a new connection. `max_missed`: periods in a row in which nothing can be sent.
  /// [init]
  void start(int max_missed);
  /// Sends the next set-point. kConnectionLost; kBusTimeout after more than `max_missed` that could
  /// not be sent. [cyclic]
  Status send(const Vector6& q);
  /// Tells the program that there is no set-point yet, and counts from there. False: it could not
  /// be sent in this cycle. As send(). [cyclic]
  Status clear(bool& sent);
  /// Tells the program to brake and to end. As clear(). [cyclic]
  Status end(bool& sent);

  /// The count of the last set-point, as in the register; 0: none yet. [any]
  std::int32_t count() const { return count_; }

 private:
  Status write(std::int32_t count, const Vector6& q, bool& sent);

  RtdeClient& session_;
  Message& why_;
  Vector6 last_ = Vector6::Zero();  // rad
  std::int32_t count_ = 0;
  int max_missed_ = 0, unsent_ = 0;  // unsent_: periods in a row
};

}  // namespace tactus::ur
