#include "gateway/page/description.hpp"
#include "kernel/pipeline/channels.hpp"
#include "kernel/pipeline/kinds.hpp"

namespace tactus {
namespace {

/// The visitor that writes the inputs or the outputs of a block, and passes over the rest.
class PortLister {
 public:
  PortLister(const PortTable& ports, bool outputs, Json& to)
      : ports_(ports), outputs_(outputs), to_(to) {}

  template <class Value>
  void param(const char*, const Value&, const Range&, const char*) {}
  template <class Value>
  void tunable(const char*, const Value&, const Range&, const char*) {}
  template <class Value>
  void optional(const char*, const Value&, const Range&, const char*) {}
  void limit(const char*, const JointVector&, const char*) {}
  template <std::size_t N>
  void text(const char*, const Text<N>&, const char*) {}
  template <class List>
  void lines(const char*, const List&, const char*) {}
  template <class Enum>
  void choice(const char*, Enum&) {}
  template <class Space>
  void channel(ReferenceChannel<Space>*&) {}
  template <Quantity Q>
  void in(const char* key, In<Q>& port) {
    if (outputs_) return;
    to_.open('{').string(key, "port").integer(number_of(port.source), "from").close('}');
  }
  template <Quantity Q>
  void optional(const char* key, In<Q>& port) {
    if (port.wired()) in(key, port);
  }
  template <Quantity Q>
  void out(const char* key, Out<Q>& port) {
    if (!outputs_) return;
    to_.open('{').string(key, "port").integer(number_of(&port.value), "number");
    to_.string(info(Q).name, "quantity").string(info(Q).unit, "unit");
    to_.string(info(Q).components, "components").integer(info(Q).recorded, "count").close('}');
  }

 private:
  int number_of(const void* value) const {
    for (int i = 0; i < ports_.count(); ++i)
      if (ports_[i].value == value) return i;
    return -1;
  }

  const PortTable& ports_;
  bool outputs_;
  Json& to_;
};

/// Calls describe(visitor) for the inputs, and then for the outputs.
template <class Describe>
void block(const PortTable& ports, std::string_view name, std::string_view type, Json& to,
           const Describe& describe) {
  to.open('{').string(name, "name").string(type, "type");
  for (const bool outputs : {false, true}) {
    to.open('[', outputs ? "outputs" : "inputs");
    PortLister lister(ports, outputs, to);
    describe(lister);
    to.close(']');
  }
  to.close('}');
}

}  // namespace

void describe_blocks(Pipeline& pipeline, Json& to) {
  const PortTable& ports = pipeline.ports;
  RobotSection& robot = pipeline.robot;
  to.open('[', "blocks");
  block(ports, "robot", "measured", to, [&](auto& visit) { robot.describe_robot(visit); });
  for (int i = 0; i < pipeline.count(); ++i) {
    const Block& placed = pipeline[i];
    with_kind(placed.kind, [&](auto kind) {
      auto& its = *static_cast<typename decltype(kind)::Type*>(placed.place);
      block(ports, placed.name, Kinds::kTypes[placed.kind], to,
            [&](auto& visit) { its.describe(visit); });
    });
  }
  block(ports, "command", "to the robot", to, [&](auto& visit) { robot.describe_command(visit); });
  to.close(']');
}

}  // namespace tactus
