// The verbs of tactusctl, one file each or one for a few alike. Each takes a client that is
// connected, and returns the exit code.
#pragma once

#include "gateway/ctl/client.hpp"
#include "gateway/ctl/row_reader.hpp"

namespace tactus::ctl {

/// Arguments of a verb.
struct Session {
  const Options& options;
  Client& client;
  Output& output;
};

int send_trajectory(Session& session);  ///< send, check
int send_point(Session& session);
int send_stream(Session& session);
int jog(Session& session);
int control(Session& session);  ///< cancel, override, pause, resume, stop, rearm, tare
int params(Session& session);
int watch(Session& session);
int record(Session& session);
int info(Session& session);
/// Works without a client if the options name a robot.
int retime_path(const Options& options, Output& output);

/// Fills in joints and frames of a reference.
void fill_terms(Session& session, std::uint32_t held_joints, Terms& terms);
/// True if the server offers a feature.
bool offers(const Welcome& welcome, Feature feature);
/// Returns the names of the robot's joints.
std::vector<JointName> joint_names(const Welcome& welcome);

}  // namespace tactus::ctl
