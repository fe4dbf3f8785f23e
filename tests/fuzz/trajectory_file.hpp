// Fuzzes trajectory files of one space: a refusal must name a line and a reason, a file that is
// read must be finite, and a trajectory that is also admitted must keep its limits at every sample.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include "gateway/trajectory/trajectory_reader.hpp"
#include "kernel/reference/motion/admission.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace tactus::fuzz {

inline constexpr double kRounding = 1e-6;  // relative; limits are judged at extrema

inline bool within(const JointSpace::Point& point, const JointLimits& limits) {
  const double span = 1.0 + kRounding;
  return (point.q.array() <= limits.q_max.array() + kRounding).all() &&
         (point.q.array() >= limits.q_min.array() - kRounding).all() &&
         (point.dq.cwiseAbs().array() <= span * limits.dq_max.array()).all() &&
         (point.ddq.cwiseAbs().array() <= span * limits.ddq_max.array()).all() &&
         (point.tau.cwiseAbs().array() <= span * limits.tau_max.array()).all();
}

inline bool within(const TaskSpace::Point& point, const TaskLimits& limits) {
  const double span = 1.0 + kRounding;
  return (point.x.p.array() <= limits.p_max.array() + kRounding).all() &&
         (point.x.p.array() >= limits.p_min.array() - kRounding).all() &&
         point.v.head<3>().norm() <= span * limits.v_max &&
         point.v.tail<3>().norm() <= span * limits.w_max &&
         point.a.head<3>().norm() <= span * limits.a_max &&
         point.a.tail<3>().norm() <= span * limits.alpha_max &&
         point.h.head<3>().norm() <= span * limits.force_max;
}

/// The file that the parsers read, in memory.
class MemoryFile {
 public:
  MemoryFile() : file_(memfd_create("trajectory", 0)) {
    MUST(file_ >= 0);
    std::snprintf(path_, sizeof path_, "/proc/self/fd/%d", file_);
  }
  const char* holding(const std::uint8_t* data, std::size_t size) {
    MUST(ftruncate(file_, 0) == 0);
    MUST(pwrite(file_, data, size, 0) == static_cast<ssize_t>(size));
    return path_;
  }

 private:
  int file_;
  char path_[32];
};

template <class Space>
class TrajectoryFile {
 public:
  static constexpr int kCapacity = 6;
  using Store = std::array<Waypoint<Space>, kCapacity>;

  /// `store` is a separate object, so that the address sanitizer detects an access past its end.
  explicit TrajectoryFile(Store& store) : waypoints_(store.data()) {}
  void play(const std::uint8_t* data, std::size_t size) {
    const char* path = file_.holding(data, size);
    lines_ = static_cast<int>(std::count(data, data + size, '\n')) + 1;
    const bool whole = reads(path, false);
    const bool partial = reads(path, true);
    MUST(partial || !whole);
  }

 private:
  static constexpr int kSamples = 16;  // per segment

  bool reads(const char* path, bool partial) {
    trajectory_ = {};
    trajectory_.waypoints = waypoints_;
    trajectory_.capacity = kCapacity;
    CsvError error;
    if (!read_trajectory(path, partial, trajectory_, error)) {
      const std::string_view reason = error.reason;
      MUST(error.line >= 0 && error.line <= lines_ && !reason.empty());
      MUST(error.line > 0 || reason.substr(0, 9) == "the file ");
      return false;
    }
    MUST(trajectory_.count >= 1 && trajectory_.count <= kCapacity);
    for (int i = 0; i < trajectory_.count; ++i)
      MUST(std::isfinite(trajectory_.at(i).time_s) && trajectory_.at(i).point.finite());
    for (const Interpolation how :
         {Interpolation::kByFields, Interpolation::kLinear, Interpolation::kCubic,
          Interpolation::kQuintic, Interpolation::kMonotone})
      judge(how);
    return true;
  }

  void judge(Interpolation how) {
    trajectory_.interpolation = how;
    trajectory_.exact = true;
    const AdmissionSettings<Space> settings{{}, 1e-3, 0.1};
    if (!admit(trajectory_, settings).ok()) return;
    const typename Space::Placement placement =
        Space::anywhere(trajectory_.header, settings.limits);
    for (int i = 1; i < trajectory_.count; ++i) {
      const typename Space::Segment segment = trajectory_.segment(i, placement);
      for (int k = 0; k <= kSamples; ++k) {
        const auto point = segment.at(segment.duration() * (static_cast<double>(k) / kSamples));
        MUST(point.finite() && within(point, settings.limits));
      }
    }
  }

  Waypoint<Space>* waypoints_;
  MemoryFile file_;
  int lines_ = 0;
  Trajectory<Space> trajectory_;
};

}  // namespace tactus::fuzz
