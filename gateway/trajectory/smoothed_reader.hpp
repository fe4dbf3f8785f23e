// SmoothedReader: the waypoints of a trajectory file, as they are given or on a smooth curve
// through their positions. Positions that were written with few digits, or measured, have errors
// that are nothing beside the motion, but between samples close together they are any velocity,
// acceleration and jerk. The curve (smoothing_spline.hpp) is fitted to as many samples as depend on
// each other; it continues where the samples before ended, so that a file of any length remains a
// stream. It stays within the tolerance of the given numbers, and within half of the last digit
// that was written of each.
#pragma once

#include "gateway/trajectory/smoothing/smoothing_spline.hpp"
#include "gateway/trajectory/trajectory_reader.hpp"

namespace tactus {

/// By how much positions may be moved, in addition to half of the last digit; 0: not at all.
struct SmoothingTolerance {
  double rad = 0.0, m = 0.0;

  bool allows() const { return rad > 0.0 && m > 0.0; }
};

/// How a file is read.
struct Smoothing {
  SmoothingTolerance tolerance;  ///< 0: as it is given
  /// By how many steps the curve is smoother than the likeliest, where the tolerance allows it.
  int rounding = 0;

  static constexpr int kMostRounding = 6;
};

/// Says how far positions were moved at most: "smoothed, by up to 0.00031 rad"; empty if they were
/// not. [any]
Message describe(const SmoothingTolerance& moved);

template <class Space>
class SmoothedReader {
 public:
  /// As TrajectoryReader::open(). [init]
  bool open(const char* path, bool partial, std::uint64_t hash, CsvError& error) {
    smoothing_ = {};
    return reader_.open(path, partial, hash, error);
  }
  /// As those of TrajectoryReader. [init]
  void take_angles(Wrap wrap, const JointVector& reference) {
    reader_.take_angles(wrap, reference);
  }
  const JointTurns& turns() const { return reader_.turns(); }
  /// Sets the limits of the run-up to a file that begins in motion; before, there is none. [init]
  void run_up_within(const typename Space::Peaks& limits) { limits_ = limits; }
  /// Returns to the first waypoint of a regular file, to read it so. False: refused. [init]
  bool restart(const Smoothing& smoothing, CsvError& error);
  /// The same, to read it as another reader of the file does: smoothed by as much, and with its
  /// run-up. [init]
  bool restart_as(const SmoothedReader& other, CsvError& error) {
    limits_ = other.limits_;
    return restart(other.smoothing_, error);
  }
  /// The same, to read it as before. [init]
  bool rewind(CsvError& error);
  /// As TrajectoryReader::next(). Refuses also what no smooth curve is near to. [any, not cyclic]
  RowResult next(Waypoint<Space>& waypoint, CsvError& error, int wait_ms = -1);

  /// Fields of the waypoints; known once one was taken.
  Fields fields() const;
  void note_terms(typename Space::Header& header) const { reader_.note_terms(header); }
  const LineReader& lines() const { return reader_.lines(); }
  /// Line of the waypoint that was taken last.
  int line() const { return line_; }
  /// Waypoints before those of the file: 1 where a run-up begins, else 0.
  int run_ups() const { return run_ups_; }
  /// How far positions were moved at most, since restart().
  const SmoothingTolerance& moved() const { return moved_; }
  const Smoothing& smoothing() const { return smoothing_; }

 private:
  static constexpr int kMost = SmoothingSpline::kMostSamples;
  static constexpr int kAhead = kMost / 4;  // samples that are fitted once more, with later ones
  static constexpr int kFewest = 8;         // of a file
  using Axes = SmoothingSpline::Axes;

  bool smooths() const { return smoothing_.tolerance.allows(); }
  bool run_up(Waypoint<Space>& waypoint);
  bool fit_more(CsvError& error);
  bool read_window(CsvError& error);
  void prepare();
  bool fit();
  bool near(int sample);
  Axes allowed(int sample, const typename Space::Point& smooth) const;
  typename Space::Point point(int sample) const;
  const Waypoint<Space>& row(int sample) const { return rows_[static_cast<std::size_t>(sample)]; }

  TrajectoryReader<Space> reader_;
  Smoothing smoothing_;
  typename Space::Peaks limits_{};  // of the run-up
  int run_ups_ = 0;
  SmoothingTolerance moved_;
  bool at_end_ = false, begun_ = false;
  int line_ = 0;

  SmoothingSpline spline_;
  std::array<Waypoint<Space>, kMost> rows_;  // as given
  std::array<int, kMost> lines_;
  int count_ = 0;                 // of the rows
  int next_ = 0, ready_ = 0;      // the row to hand out next, and the first that is not ready
  typename Space::Point origin_;  // of the axes: the first row's place
};

}  // namespace tactus
