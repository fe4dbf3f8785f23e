// Faults that tests inject into a drive: what, where, and when by the count of SYNCs on its bus.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <random>

#include "sim_plant/drives/fault_kinds.hpp"

namespace tactus::drives {

struct Fault {
  int node = 0;  ///< 0: every node
  FaultKind kind = FaultKind::kDropTpdo;
  std::int64_t at = 0;  ///< active from this SYNC on, the first is 1; 0: from the beginning
  std::int64_t until = std::numeric_limits<std::int64_t>::max();  ///< and before this one
  double probability = 1.0;                                       ///< at each occasion
  std::uint32_t value = 0;
  std::uint32_t abort = 0x08000000;
};

/// The faults of one drive. The same seed gives the same faults.
class Faults {
 public:
  static constexpr std::size_t kMost = 16;

  /// Begins without faults. [init]
  void seed(std::uint64_t seed, int node) {
    node_ = node;
    count_ = 0;
    done_ = {};
    random_.seed(seed * 1000 + static_cast<std::uint64_t>(node));
  }
  /// Adds a fault if it concerns this node. False: there is no room. [init]
  bool add(const Fault& fault) {
    if (fault.node != 0 && fault.node != node_) return true;
    if (count_ == kMost) return false;
    faults_[count_++] = fault;
    return true;
  }
  /// Ends all faults. [any]
  void clear() {
    count_ = 0;
    done_.fill(false);
  }
  /// Returns the fault of a kind that is active now, or null. Each call is an occasion. [any]
  const Fault* active(FaultKind kind, std::int64_t syncs) {
    for (std::size_t i = 0; i < count_; ++i) {
      const Fault& fault = faults_[i];
      if (fault.kind == kind && syncs >= fault.at && syncs < fault.until && happens(fault))
        return &fault;
    }
    return nullptr;
  }
  /// As active(), for faults that happen once; each has then happened. [any]
  const Fault* once(FaultKind kind, std::int64_t syncs) {
    for (std::size_t i = 0; i < count_; ++i) {
      const Fault& fault = faults_[i];
      if (done_[i] || fault.kind != kind || syncs < fault.at || syncs >= fault.until) continue;
      if (!happens(fault)) continue;
      done_[i] = fault.probability >= 1.0;
      return &fault;
    }
    return nullptr;
  }

 private:
  bool happens(const Fault& fault) {
    if (fault.probability >= 1.0) return true;
    return static_cast<double>(random_() >> 11) * 0x1p-53 < fault.probability;
  }

  int node_ = 0;
  std::array<Fault, kMost> faults_{};
  std::array<bool, kMost> done_{};
  std::size_t count_ = 0;
  std::mt19937_64 random_;
};

}  // namespace tactus::drives
