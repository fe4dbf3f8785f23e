// tactusctl: references, controls and views of an arm, from a terminal or a script.
#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {

std::vector<std::string> joint_names(const Welcome& welcome) {
  std::vector<std::string> names;
  for (const Joint& joint : welcome.joints()) names.push_back(joint.name());
  return names;
}

bool offers(const Welcome& welcome, Feature feature) {
  for (const int offered : welcome.features())
    if (offered == feature) return true;
  return false;
}

namespace {

/// Returns the frame that is named, as Terms have it; `usual` if none is.
std::string frame(const std::optional<std::string>& named, const std::string& usual) {
  return named.value_or(usual) == "base" ? "" : named.value_or(usual);
}

}  // namespace

void fill_terms(Session& session, std::uint32_t held_joints, Terms& terms) {
  const Welcome& usual = session.client.welcome();
  terms.set_held_joints(held_joints);
  terms.set_motion_frame(frame(session.options.motion_frame, usual.motion_frame()));
  terms.set_wrench_frame(frame(session.options.wrench_frame, usual.wrench_frame()));
}

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
