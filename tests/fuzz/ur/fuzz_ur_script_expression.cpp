// Fuzzes expressions, calls, names and the text of external control in a script's text, without
// running it: a reader must consume text from the front, and every name it returns must lie within
// the text.
#include <cmath>

#include "sim_plant/ur/script/script_check.hpp"
#include "tests/fuzz/ur/ur_controller.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

bool is_rest(std::string_view rest, std::string_view text) {
  return rest.size() <= text.size() && rest.data() + rest.size() == text.data() + text.size();
}

bool within(std::string_view part, std::string_view text) {
  return part.empty() ||
         (part.data() >= text.data() && part.data() + part.size() <= text.data() + text.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::RunningController controller;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ScriptVariables variables;
  for (const Machine* machine :
       {static_cast<const Machine*>(nullptr), static_cast<const Machine*>(&controller.machine())}) {
    std::string_view rest = text;
    ScriptValue value;
    const bool valued = evaluate(rest, {&variables, machine}, value);
    MUST(is_rest(rest, text) && (valued || rest == text));
    if (valued) MUST(value.count <= value.elements.size() && within(value.text, text));
    if (valued) variables.set("x", value);
    rest = text;
    ScriptCall call;
    const bool called = read_call(rest, {&variables, machine}, call);
    MUST(is_rest(rest, text) && (called || rest == text) && call.count <= ScriptCall::kMost);
  }
  ScriptFault fault;
  if (ScriptCheck(text).find(fault))
    MUST(fault.line >= 1 && fault.column >= 1 && within(fault.name, text));
  const ExternalReading read = read_external_control(text);
  for (const SocketPlace& place : read.places) MUST(within(place.host, text));
  MUST(within(read.behind, text) && std::isfinite(read.law.gain));
  return 0;
}
