// TareRequest: a tare requested while a block runs, from its begin to its one result; and
// TareLimits, by how much it may move the zero, from the present one and from that of the start. A
// steady contact looks like a zero that has moved: the limits keep a contact beyond them from
// becoming zero, and a law that then presses on from making it zero by and by.
//
// A board without a server of references has neither: TACTUS_TUNING=0.
#pragma once

#include <algorithm>

#include "kernel/core/describe.hpp"
#include "kernel/core/types.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/math/bumpless_transfer.hpp"

namespace tactus {

template <bool kPresent = kTuning>
struct TareLimits {
  double max_tare_force = 5.0;   ///< N, for the change of the zero by tares while the block runs
  double max_tare_moment = 0.5;  ///< N m

  template <class Visitor>
  void describe_limits(Visitor& visit) {
    visit.param("max_tare_force", max_tare_force, Range{0.1, 50.0}, "N");
    visit.param("max_tare_moment", max_tare_moment, Range{0.01, 5.0}, "N m");
  }
  /// Returns kTareLimit, with axis 0 for the force and 3 for the moment, if the zero would move by
  /// more at once, or since the start. [any]
  Verdict judge(const Vector6& change, const Vector6& in_sum) const {
    const double force = std::max(change.head<3>().norm(), in_sum.head<3>().norm());
    const double moment = std::max(change.tail<3>().norm(), in_sum.tail<3>().norm());
    if (!(force <= max_tare_force)) return {Status::kTareLimit, -1, 0, force, max_tare_force};
    if (!(moment <= max_tare_moment)) return {Status::kTareLimit, -1, 3, moment, max_tare_moment};
    return {};
  }
};

template <>
struct TareLimits<false> {
  template <class Visitor>
  void describe_limits(Visitor& /*visit*/) {}
  Verdict judge(const Vector6& /*change*/, const Vector6& /*in_sum*/) const { return {}; }
};

template <bool kPresent = kTuning>
class TareRequest {
 public:
  /// Takes the zero of a start. [cyclic]
  void start(const Vector6& zero) { zero_ = zero; }
  const Vector6& zero() const { return zero_; }
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
  Vector6 zero_ = Vector6::Zero();  // of the last start
  Verdict verdict_;
  bool runs_ = false;
};

template <>
class TareRequest<false> {
 public:
  void start(const Vector6& /*zero*/) {}
  Vector6 zero() const { return Vector6::Zero(); }
  void begin() {}
  void end(const Verdict& /*verdict*/) {}
  bool runs() const { return false; }
  Verdict verdict() const { return {Status::kNotOffered}; }
};

}  // namespace tactus
