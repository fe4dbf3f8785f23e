#include "gateway/server/cycle_orders.hpp"

#include <algorithm>

namespace tactus {
namespace {

void add_wrench(Message& text, const Vector6& wrench) {
  for (int i = 0; i < 6; ++i) text << (i == 0 ? "" : i == 3 ? " N, " : " ") << wrench[i];
  text << " N m";
}

/// Appends why there is no new zero, and the remedy.
void add_refusal(Message& text, const Verdict& verdict) {
  const bool force = verdict.axis < 3;
  const char* const unit = force ? " N" : " N m";
  switch (verdict.status) {
    case Status::kTareLimit:
      text << "the zero would move by " << verdict.value << unit << ", more than "
           << (force ? "max_tare_force, " : "max_tare_moment, ") << verdict.limit << unit
           << ", now or in sum since the start; is there a contact? Free the tool and ask again. A "
              "drift as large is taken by Stop and Rearm, with the tool free";
      break;
    case Status::kSensorNotSteady:
      text << "the sensor was not steady for tare_s within tare_timeout_s; let the arm rest, and "
              "free it of what shakes it";
      break;
    case Status::kMailboxFull: text << "a tare is under way; send it again when it is done"; break;
    case Status::kArming: text << "drives are being armed; the start takes a new zero"; break;
    default:
      text << "the arm is stopped, " << meaning(verdict.status) << "; Rearm takes a new zero";
  }
  text << " (" << static_cast<int>(verdict.status) << ")";
}

}  // namespace

bool CycleOrders::under_way(CycleOrder what) const {
  return std::any_of(orders_.begin(), orders_.end(),
                     [what](const Order& order) { return order.id != 0 && order.what == what; });
}

Reply CycleOrders::post(CycleOrder what, const Origin& from, std::uint32_t faults) {
  const auto is_free = [](const Order& order) { return order.id == 0; };
  const auto free = std::find_if(orders_.begin(), orders_.end(), is_free);
  constexpr std::ptrdiff_t kForStops = 4;  // of the places, which no rearm may fill
  const bool space = what == CycleOrder::kStop ||
                     (static_cast<std::ptrdiff_t>(mailboxes_.orders.space()) > kForStops &&
                      std::count_if(orders_.begin(), orders_.end(), is_free) > kForStops);
  if (free == orders_.end() || !space || !mailboxes_.orders.post({next_, what, faults}))
    return {Status::kMailboxFull, "the cycle has not yet taken the last orders; send it again"};
  *free = {next_, from, what};
  next_ += next_ == ~std::uint32_t{0} ? 2 : 1;
  return {};
}

/// The cycle judges the rest; report_tare() has its result.
Reply CycleOrders::post_tare(const Origin& from, std::uint32_t faults) {
  if (!offers_tare())
    return {Status::kNotOffered, "the pipeline has no wrench_front_end, or more than one"};
  const Block& block = pipeline_[front_end_];
  if (static_cast<const WrenchFrontEnd*>(block.place)->params.tare_s == 0.0) {
    Message text("[");
    text << std::string_view(block.name)
         << "] tare_s is 0, so it takes no tare; set it in the pipeline file and start again";
    return {Status::kNotOffered, text};
  }
  if (under_way(CycleOrder::kTare))
    return {Status::kMailboxFull, "a tare is under way; send it again after its Report"};
  return post(CycleOrder::kTare, from, faults);
}

void CycleOrders::take_results(double time_s, std::int64_t now_ns) {
  OrderResult result;
  while (mailboxes_.results.take(result)) {
    for (Order& order : orders_) {
      if (order.id == 0 || order.id != result.id) continue;
      const Verdict& verdict = result.verdict;
      const Outcome outcome = verdict.ok() ? Outcome::kExecuted : Outcome::kRefused;
      if (order.what == CycleOrder::kTare)
        report_tare(order, result, time_s, now_ns);
      else
        clients_.report({order.from, outcome, verdict, time_s, 0.0},
                        reply_to(verdict, references_.axes()).text, now_ns);
      order = {};
    }
  }
}

/// A new zero goes to the log and to all clients, a refusal to its client only.
void CycleOrders::report_tare(const Order& order, const OrderResult& result, double time_s,
                              std::int64_t now_ns) {
  const bool good = result.verdict.ok();
  Message text("[");
  text << std::string_view(pipeline_.name(front_end_)) << "] ";
  if (good) {
    const Vector6 change = result.zero - result.zero_before;
    text << "the zero moved by " << change.head<3>().norm() << " N, " << change.tail<3>().norm()
         << " N m, to ";
    add_wrench(text, result.zero);
  } else {
    add_refusal(text, result.verdict);
  }
  clients_.report(
      {order.from, good ? Outcome::kExecuted : Outcome::kRefused, result.verdict, time_s, 0.0},
      text, now_ns, good ? &result.zero : nullptr);
  if (!good) return;
  const Connection* const by = clients_.sender(order.from);
  text << ", by " << (by != nullptr ? std::string_view(by->name) : "a client that has left");
  clients_.announce("tare", Status::kOk, text.c_str(), now_ns);
}

}  // namespace tactus
