// The program of tests/trace: plays the tapes of a job and prints their trace. The same source runs
// on the host, on aarch64 and on a bare core.
#pragma once

#include "tests/trace/trace.hpp"
#include "tests/wcet/player.hpp"

namespace tactus {

/// Plays the tapes of a job, each with a player that has never run, and prints their trace, then
/// "end CYCLES HASH STATUS REQUESTS": the status of the last tape and the requests that passed
/// admission. A job is the window as three u32; a u8 that fills the player's memory before it is
/// constructed, so that what is read without having been written makes a difference; then a reel of
/// the pipeline's text and the tapes. `store` is for the waypoints of a long trajectory. Returns
/// the exit code: 2 if the pipeline is refused.
int play_job(Bytes job, Waypoint<JointSpace>* store, Trace::Print print);

}  // namespace tactus
