// Follower: a second machine that runs the same pipeline beside this program and is to do the same:
// it receives the same messages as the first.
#pragma once

namespace tactus {

struct Session;
struct TrajectoryInput;

class Follower {
 public:
  /// Takes the session that is to be run. [init]
  virtual void prepare(const Session& session) = 0;
  /// The trajectory begins with the next cycle. False: refused; prints the reason to stderr.
  virtual bool begin(const TrajectoryInput& input) = 0;
  /// The arm is to be brought to rest. [between two cycles]
  virtual void halt() = 0;

 protected:
  ~Follower() = default;
};

}  // namespace tactus
