// What a replay writes: one row of doubles per cycle, without a header. The columns are time in s,
// position, velocity and acceleration of every axis, and 1 if the generator says that it starves.
// The axes of the tip are its place in m and the rotation vector from where the benchmark begins.
#pragma once

#include <cstdio>

#include "kernel/math/so3.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

class Recording {
 public:
  explicit Recording(const char* path) : file_(std::fopen(path, "wb")) {}
  ~Recording() {
    if (file_ != nullptr) std::fclose(file_);
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  bool open() const { return file_ != nullptr; }
  void add(double time_s, const JointSpace::Point& point, const JointSpace::Point&, bool starving) {
    write(time_s);
    for (const JointVector* row : {&point.q, &point.dq, &point.ddq}) write(row->data(), kDof);
    write(starving ? 1.0 : 0.0);
  }
  void add(double time_s, const TaskSpace::Point& point, const TaskSpace::Point& home,
           bool starving) {
    const Vector3 phi = log_so3(home.x.r.conjugate() * point.x.r);
    write(time_s);
    write(point.x.p.data(), 3);
    write(phi.data(), 3);
    write(point.v.data(), 6);
    write(point.a.data(), 6);
    write(starving ? 1.0 : 0.0);
  }

 private:
  void write(double number) { write(&number, 1); }
  void write(const double* numbers, int count) {
    std::fwrite(numbers, sizeof(double), static_cast<std::size_t>(count), file_);
  }

  std::FILE* file_;
};

}  // namespace tactus
