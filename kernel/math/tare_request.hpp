// TareRequest: a tare that was asked for while a block runs, from its begin to its one result; and
// TareLimits, by how much it may move the zero. A steady contact looks like a zero that has moved:
// the limits keep a contact beyond them from becoming zero.
//
// A board without a server of references has neither: TACTUS_TUNING=0.
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/core/types.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/math/fade.hpp"

namespace tactus {

template <bool kPresent = kTuning>
struct TareLimits {
  double max_tare_force = 10.0;  ///< N, for the change of the zero by a tare while the block runs
  double max_tare_moment = 1.0;  ///< N m

  template <class Visitor>
  void describe_limits(Visitor& visit) {
    visit.param("max_tare_force", max_tare_force, kPositive, "N");
    visit.param("max_tare_moment", max_tare_moment, kPositive, "N m");
  }
  /// Returns kTareLimit, with axis 0 for the force and 3 for the moment, if the zero would move by
  /// more. [any]
  Verdict judge(const Vector6& change) const {
    const double force = change.head<3>().norm(), moment = change.tail<3>().norm();
    if (!(force <= max_tare_force)) return {Status::kTareLimit, -1, 0, force, max_tare_force};
    if (!(moment <= max_tare_moment)) return {Status::kTareLimit, -1, 3, moment, max_tare_moment};
    return {};
  }
};

template <>
struct TareLimits<false> {
  template <class Visitor>
  void describe_limits(Visitor& /*visit*/) {}
  Verdict judge(const Vector6& /*change*/) const { return {}; }
};

template <bool kPresent = kTuning>
class TareRequest {
 public:
  /// [between two cycles]
  void begin() { runs_ = true; }
  /// Ends it, if it runs, with its result. [any]
  void end(const Verdict& verdict) {
    if (runs_) verdict_ = verdict;
    runs_ = false;
  }
  bool runs() const { return runs_; }
  /// The result of the last one. [any]
  Verdict verdict() const { return verdict_; }

 private:
  Verdict verdict_;
  bool runs_ = false;
};

template <>
class TareRequest<false> {
 public:
  void begin() {}
  void end(const Verdict& /*verdict*/) {}
  bool runs() const { return false; }
  Verdict verdict() const { return {Status::kNotOffered}; }
};

}  // namespace tactus
