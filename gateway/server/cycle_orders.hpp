// CycleOrders: orders of clients to the executive (stop, rearm, tare), from their request to the
// report of their result.
#pragma once

#include "gateway/server/clients.hpp"
#include "gateway/server/cycle_mailboxes.hpp"
#include "kernel/pipeline/only_block.hpp"

namespace tactus {

class CycleOrders {
 public:
  CycleOrders(const References& references, const Pipeline& pipeline, CycleMailboxes& mailboxes,
              Clients& clients)
      : references_(references),
        pipeline_(pipeline),
        mailboxes_(mailboxes),
        clients_(clients),
        front_end_(only_block<WrenchFrontEnd>(pipeline)) {}

  /// Posts an order; `faults` is that of the newest snapshot. kMailboxFull: there is no space.
  Reply post(CycleOrder what, const Origin& from, std::uint32_t faults);
  /// Posts an order for a new zero of the force/torque sensor. kNotOffered: the pipeline has none.
  Reply post_tare(const Origin& from, std::uint32_t faults);
  /// True if the pipeline has exactly one force/torque sensor, so that a tare is possible.
  bool offers_tare() const { return front_end_ >= 0; }
  /// True while a stop is not yet in force.
  bool stopping() const { return under_way(CycleOrder::kStop); }
  /// Takes the results of the cycle and reports them, with the generator time of its newest.
  void take_results(double time_s, std::int64_t now_ns);

 private:
  struct Order {
    std::uint32_t id = 0;  // 0: free
    Origin from;
    CycleOrder what = CycleOrder::kStop;
  };
  bool under_way(CycleOrder what) const;
  void report_tare(const Order& order, const OrderResult& result, double time_s,
                   std::int64_t now_ns);

  const References& references_;
  const Pipeline& pipeline_;
  CycleMailboxes& mailboxes_;
  Clients& clients_;
  int front_end_;  // the block whose sensor can be tared; -1: there is none, or more than one
  std::array<Order, 16> orders_{};
  std::uint32_t next_ = 1;
};

}  // namespace tactus
