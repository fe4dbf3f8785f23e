// TrajectoryStream: a trajectory file of any length, on its way through the window of a store. The
// first waypoints fill the store and are sent as an open trajectory; the others follow in parts of
// a fixed number of waypoints, so that a file is judged before it moves exactly as it is judged
// when its parts are sent.
#pragma once

#include "gateway/open_trajectory.hpp"
#include "gateway/trajectory/smoothed_reader.hpp"

namespace tactus {

/// Why a file was refused: a row that cannot be read, or else a waypoint that cannot be followed.
struct StreamRefusal {
  CsvError row;     ///< if its reason is not empty
  Verdict verdict;  ///< otherwise
  int line = 0;     ///< of the verdict's waypoint; 0: none in particular
};

/// True of what a smoother curve through the same positions may repair.
bool of_derivatives(Status status);

enum class FeedResult : std::uint8_t {
  kIdle,     ///< nothing to feed: the file fits its store, or its trajectory has ended
  kAhead,    ///< the window is full, or the generator has not yet answered the last part
  kNotYet,   ///< a pipe has no more rows at present
  kMore,     ///< a part was sent, more may follow
  kWhole,    ///< the last part was sent
  kRefused,  ///< refusal() has the reason; nothing more is sent
};

template <class Space>
class TrajectoryStream {
 public:
  /// As that of TrajectoryReader; before open(). [init]
  void take_angles(Wrap wrap, const JointVector& reference) {
    reader_.take_angles(wrap, reference);
  }
  const JointTurns& turns() const { return reader_.turns(); }
  /// Opens a file and fills the store with its first waypoints. False: refused. [init]
  bool open(const char* path, bool partial, std::uint64_t hash, Trajectory<Space>& store);
  /// Judges the file except for the way from the robot to its first waypoint: the whole file if it
  /// fits the store or can be read twice, otherwise its first waypoints. The store then holds the
  /// first waypoints, ready to be sent. A file that can be read twice is smoothed within the
  /// tolerance if it has positions without velocities, or is refused or slowed down for its
  /// velocities or their derivatives; if no smooth curve is that near, it is judged as given.
  /// False: refused. [init]
  bool judge(const AdmissionSettings<Space>& settings, const SmoothingTolerance& tolerance = {});
  /// Judges the rest of a file that cannot be read twice, and is not to be sent. False: refused.
  /// [init]
  bool judge_rest(const AdmissionSettings<Space>& settings);

  /// Appends and sends the next part of a trajectory that was sent, if there is space. Waits for a
  /// pipe at most `wait_ms`. [any, not cyclic]
  FeedResult feed(ReferenceClient<Space>& client, int wait_ms);
  /// Takes the answer to a part. [any, not cyclic]
  void answered(const Report& report);
  /// Gives up: the trajectory has ended.
  void end() { state_ = FeedResult::kIdle; }

  /// True if the file does not fit into the store.
  bool longer() const { return longer_; }
  /// True if the last waypoint is known, since the file was judged or read to its end.
  bool whole_known() const { return whole_known_ || reader_.lines().regular(); }
  std::int64_t count() const { return count_; }          ///< waypoints known so far
  double end_s() const { return end_s_; }                ///< time of the last of them
  double longer_s() const { return judge_.longer_s(); }  ///< time by which they are slowed down
  /// The same as a fraction of the time from the first to the last of them.
  double stretch() const { return judge_.stretch(end_s_); }
  std::uint64_t hash() const { return reader_.lines().hash(); }  ///< of the bytes read so far
  const StreamRefusal& refusal() const { return refusal_; }
  /// How far positions were moved at most, to smooth them.
  const SmoothingTolerance& moved() const { return reader_.moved(); }
  const Smoothing& smoothing() const { return reader_.smoothing(); }
  const SmoothedReader<Space>& reader() const { return reader_; }
  /// Returns the time of a waypoint, or infinity if it is not in the window.
  double time_s(int waypoint) const;

 private:
  bool refuse(const Verdict& verdict);
  bool refuse(std::string_view reason);
  template <class Reason>
  FeedResult give_up(const Reason& reason) {
    refuse(reason);
    return state_;
  }
  bool fill_window();
  bool judge_once(const AdmissionSettings<Space>& settings);
  bool judge_smoothed(const AdmissionSettings<Space>& settings,
                      const SmoothingTolerance& tolerance);
  bool restart(const Smoothing& smoothing);
  bool may_be_smoothed(bool accepted) const;
  RowResult take(int wait_ms);
  bool judge_parts(const AdmissionSettings<Space>& settings);
  bool judged(const Verdict& verdict);
  FeedResult send_part(ReferenceClient<Space>& client, bool last);
  bool changed(bool at_end) const;
  /// Notes the line of the waypoint that becomes number `index`.
  void note(int index);
  bool in_window(int index) const {
    return index <= newest_ && index > newest_ - window_->capacity;
  }

  SmoothedReader<Space> reader_;
  Trajectory<Space>* window_ = nullptr;
  Waypoint<Space> next_;  // read, but not yet in the window
  bool has_next_ = false, longer_ = false, whole_known_ = false;
  PartJudge<Space> judge_;
  PartSender<Space> sender_;
  FeedResult state_ = FeedResult::kIdle;
  std::int64_t count_ = 0;
  double end_s_ = 0.0;
  std::uint64_t judged_hash_ = 0;
  StreamRefusal refusal_;
  int newest_ = -1;                          // the newest waypoint in the window
  std::array<int, kMostWaypoints> lines_{};  // of the waypoints in the window
};

}  // namespace tactus
