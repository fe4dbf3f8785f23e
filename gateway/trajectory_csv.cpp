#include "gateway/trajectory_csv.hpp"

namespace tactus {

template <class Space>
bool read_trajectory(const char* path, bool partial, Trajectory<Space>& trajectory,
                     CsvError& error) {
  TrajectoryReader<Space> reader;
  trajectory.count = 0;
  if (!reader.open(path, partial, 0, error)) return false;
  Waypoint<Space> waypoint;
  RowTaken taken = reader.next(waypoint, error);
  for (; taken == RowTaken::kWaypoint; taken = reader.next(waypoint, error)) {
    if (trajectory.count == trajectory.capacity) {
      error.line = reader.lines().line();
      error.reason << "too many waypoints; at most " << trajectory.capacity << " fit";
      return false;
    }
    trajectory.set(trajectory.count++, waypoint);
  }
  trajectory.fields = reader.fields();
  reader.note_left_out(trajectory.header);
  return taken == RowTaken::kEnd;
}

template bool read_trajectory(const char*, bool, Trajectory<JointSpace>&, CsvError&);
template bool read_trajectory(const char*, bool, Trajectory<TaskSpace>&, CsvError&);

}  // namespace tactus
