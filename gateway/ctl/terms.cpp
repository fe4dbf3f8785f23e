#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {

std::vector<JointName> joint_names(const Welcome& welcome) {
  std::vector<JointName> names;
  for (const Joint& joint : welcome.joints()) names.push_back({joint.name(), joint.prismatic()});
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

}  // namespace tactus::ctl
