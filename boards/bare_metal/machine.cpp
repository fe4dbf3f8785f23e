#include "boards/bare_metal/machine.hpp"

#include "program/pil/row_hash.hpp"

namespace bare {

using namespace tactus;

Status Machine::load(std::string_view text, LoadError& error) {
  Loader loader({&joints_.channel, &poses_.channel}, hal_.capabilities(), sections_);
  return loader.load(text, pipeline_, error);
}

Status Machine::start() {
  return executive_.start();
}

/// A change of the order is what counts, so an old order that comes again does nothing.
void Machine::follow(serial::Order order) {
  if (order == order_) return;
  order_ = order;
  if (order == serial::Order::kArmed)
    static_cast<void>(executive_.arm());  // the log says why not
  else
    executive_.halt();
}

void Machine::cycle(const CycleTime& now, serial::CycleResult& result) {
  follow(hal_.order());
  result.status = executive_.cycle(now);
  if (result.status == Status::kArming && order_ == serial::Order::kArmed)
    static_cast<void>(executive_.arm());
  result.cycle = ++cycles_;
  result.stamp_ns = now.stamp_ns;
  result.command = hal_.command();
  result.rung = static_cast<std::uint8_t>(executive_.rung());
  result.row = row_hash(pipeline_.recording);
}

Report Machine::next_report() {
  return joints_.server.waiting() > 0 ? joints_.server.next() : poses_.server.next();
}

}  // namespace bare
