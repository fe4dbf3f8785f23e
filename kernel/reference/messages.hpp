// What a client sends to a reference generator and what comes back. Every request ends in exactly
// one final report.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/joint_limits.hpp"
#include "kernel/mailbox.hpp"
#include "kernel/reference/trajectory.hpp"
#include "kernel/status.hpp"

namespace tactus {

enum class RequestKind : std::uint8_t { kPoint, kTrajectory, kCancel };

template <class Space>
struct Request {
  std::uint32_t id = 0;  ///< the client's number, returned in every report
  RequestKind kind = RequestKind::kPoint;
  int store = -1;               ///< kTrajectory: which store it lies in
  typename Space::Point point;  ///< kPoint
};

enum class Outcome : std::uint8_t {
  kStarted,     ///< a trajectory began; a final report follows
  kSucceeded,   ///< final: a trajectory reached its end
  kPreempted,   ///< final: a newer trajectory took its place
  kAborted,     ///< final: an online point took its place
  kCanceled,    ///< final: a client cancelled the trajectory
  kExecuted,    ///< final: a point became the reference, a cancel took effect
  kSuperseded,  ///< final: a newer point took its place before it was ever written
  kRefused,     ///< final: not accepted; the verdict says why
};

/// The name of an outcome, for example "succeeded". Never null. [any]
const char* name(Outcome outcome);

/// Why something was refused: which waypoint and joint (-1: none in particular), the value and the
/// limit it broke.
struct Verdict {
  Status status = Status::kOk;
  int waypoint = -1;
  int joint = -1;
  double value = 0.0, limit = 0.0;

  bool ok() const { return status == Status::kOk; }
};

struct Report {
  std::uint32_t id = 0;
  Outcome outcome = Outcome::kRefused;
  int store = -1;  ///< a trajectory's store, which is the client's again after a final report
  Verdict verdict;
};

/// What admission goes by: the same values on both sides of the channel, set when the pipeline is
/// loaded.
struct AdmissionSettings {
  JointLimits limits;
  double period_s = 0.0;
};

inline constexpr int kStores = 3;  ///< one running, one in the mailbox, one being filled

/// The way into one reference generator and back out. Owned by the board; one client, one
/// generator.
template <class Space>
struct ReferenceChannel {
  AdmissionSettings settings;
  Mailbox<Request<Space>, 16> requests;
  Mailbox<Report, 64> reports;
  std::array<Trajectory<Space>, kStores> stores;
};

}  // namespace tactus
