// tactusctl: references, controls and views of an arm, from a terminal or a script.
#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {
namespace {

int run(Session& session) {
  switch (session.options.verb) {
    case Verb::kSend:
    case Verb::kCheck: return send_trajectory(session);
    case Verb::kPoint: return send_point(session);
    case Verb::kStream: return send_stream(session);
    case Verb::kJog: return jog(session);
    case Verb::kWatch: return watch(session);
    case Verb::kRecord: return record(session);
    case Verb::kInfo: return info(session);
    case Verb::kParams: return params(session);
    default: return control(session);
  }
}

}  // namespace
}  // namespace tactus::ctl

int main(int argc, char** argv) {
  using namespace tactus::ctl;
  Options options;
  int exit_code = kSucceeded;
  if (!parse_options(argc, argv, options, exit_code)) return exit_code;
  Output output(options.json);
  if (options.verb == Verb::kRetime) return retime_path(options, output);
  Client client(options, output);
  if (!client.connect()) return client.exit_code();
  Session session = {options, client, output};
  return run(session);
}
