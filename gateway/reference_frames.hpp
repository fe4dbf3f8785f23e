// The payloads of the messages that carry references over a link, for both of its ends.
//
//   terms      space u8, fields u8, interpolation u8, exact u8, start_s f64, the joints held u32,
//   the
//              names of the motion and the wrench frame as short texts
//   waypoint   time_s f64, then the numbers of position and given fields f64
#pragma once

#include "hal/net/protocol_bytes.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "kernel/streams/stream_messages.hpp"

namespace tactus {

/// A trajectory but for its waypoints. The frames are outputs of the pipeline, "block.port".
struct TrajectoryTerms {
  bool poses = false;
  Fields fields = 0;
  Interpolation interpolation = Interpolation::kByFields;
  bool exact = false;
  double start_s = kStartAtOnce;
  int window = 0;  ///< waypoints that may be in the store at once; 0: all that fit. Not in a frame
  bool check = false;  ///< it is judged and not sent. Not in a frame
  std::uint32_t held = 0;
  std::string_view motion, wrench;  ///< into the payload; empty: the base frame
};

/// [any]
void write_terms(ByteWriter& to, const TrajectoryTerms& terms);
/// False: they are malformed. [any]
bool read_terms(ByteReader& from, TrajectoryTerms& terms);

/// Appends a waypoint with the numbers of `fields`. [any]
template <class Space>
void write_waypoint(ByteWriter& to, const Waypoint<Space>& waypoint, Fields fields);
/// Reads one; ok() of `from` is false if it was not whole. [any]
template <class Space>
Waypoint<Space> read_waypoint(ByteReader& from, Fields fields);

/// [any]
void write_verdict(ByteWriter& to, const Verdict& verdict);
Verdict read_verdict(ByteReader& from);
void write_report(ByteWriter& to, const Report& report);
Report read_report(ByteReader& from);

}  // namespace tactus
