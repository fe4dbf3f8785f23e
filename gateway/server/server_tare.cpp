// Server: a new zero of the force/torque sensor while the pipeline runs.
#include <algorithm>

#include "gateway/server/server.hpp"
#include "gateway/verdict_text.hpp"

namespace tactus {
namespace {

void add_wrench(Message& text, const Vector6& wrench) {
  for (int i = 0; i < 6; ++i) text << (i == 0 ? "" : i == 3 ? " N, " : " ") << wrench[i];
  text << " N m";
}

/// Why there is no new zero; what to do.
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

/// The cycle judges the rest; its result comes to tell_tare().
Reply Server::tare(const Origin& from, std::int64_t now_ns) {
  const auto under_way = [](const Order& order) {
    return order.id != 0 && order.what == CycleOrder::kTare;
  };
  if (front_end_ < 0)
    return {Status::kNotOffered, "the pipeline has no wrench_front_end, or more than one"};
  const Block& block = (*setup_.loaded)[front_end_];
  if (static_cast<const WrenchFrontEnd*>(block.place)->params.tare_s == 0.0) {
    Message text("[");
    text << std::string_view(block.name)
         << "] tare_s is 0, so it takes no tare; set it in the pipeline file and start again";
    return {Status::kNotOffered, text};
  }
  if (std::any_of(orders_.begin(), orders_.end(), under_way))
    return {Status::kMailboxFull, "a tare is under way; send it again after its Report"};
  return order(CycleOrder::kTare, from, now_ns);
}

/// Everybody and the log hear of a new zero, its client of a refusal too.
void Server::tell_tare(const Order& order, const OrderResult& result, std::int64_t now_ns) {
  const bool good = result.verdict.ok();
  Message text("[");
  text << std::string_view(setup_.loaded->name(front_end_)) << "] ";
  if (good) {
    const Vector6 change = result.zero - result.zero_before;
    text << "the zero moved by " << change.head<3>().norm() << " N, " << change.tail<3>().norm()
         << " N m, to ";
    add_wrench(text, result.zero);
  } else {
    add_refusal(text, result.verdict);
  }
  report({order.from, good ? Outcome::kExecuted : Outcome::kRefused, result.verdict, newest_.time_s,
          0.0},
         text, now_ns, good ? &result.zero : nullptr);
  if (!good) return;
  const Connection& by = at(order.from.slot);
  const bool there = by.there() && by.session == order.from.session;
  text << ", by " << (there ? std::string_view(by.name) : "a client that has left");
  if (setup_.log != nullptr) setup_.log(text.c_str());
  tell_events("tare", Status::kOk, text, -1, now_ns);
}

}  // namespace tactus
