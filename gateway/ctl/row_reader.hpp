// RowReader: the rows of a CSV file for a robot that is known only when the program runs. Columns,
// units and refusals are those of gateway/trajectory/trajectory_reader.hpp. Where times are not
// needed, the column of the time may be left out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gateway/trajectory/line_reader.hpp"

namespace tactus::ctl {

/// Quantities that the columns of a file give.
struct RowForm {
  bool times = false, poses = false;
  bool velocities = false, accelerations = false, efforts = false;
  int joints = 0;                 ///< of the robot
  std::uint32_t held_joints = 0;  ///< bit i: joint i is left out

  int position() const { return poses ? 7 : joints; }    ///< numbers of a position
  int derivative() const { return poses ? 6 : joints; }  ///< of a velocity, acceleration, effort
  int numbers() const {
    return position() + derivative() * (int{velocities} + int{accelerations} + int{efforts});
  }
};

struct JointName {
  std::string name;
  bool prismatic = false;

  const char* unit() const { return prismatic ? "m" : "rad"; }  ///< of a position
};

/// SI units; the numbers are the position, then the groups that are given, in the order velocity,
/// acceleration, effort. Joints that are left out are zero.
struct Row {
  double time_s = 0.0;
  std::vector<double> numbers;
};

enum class RowResult : std::uint8_t {
  kRow,
  kEnd,      ///< there are no more rows
  kRefused,  ///< error() has the reason
  kNotYet,   ///< a pipe had no whole row within the time to wait
};

class RowReader {
 public:
  /// Columns of which a file may leave some out.
  struct Allow {
    bool no_times = false, partial = false;
  };

  /// Opens a file and reads its header; "-" is standard input. Waits for the header of a pipe.
  /// False: refused.
  bool open(const std::string& path, const std::vector<JointName>& joints, const Allow& allow);
  /// Takes the next row. Waits for a pipe at most `wait_ms`; negative: until it has a row.
  RowResult next(Row& row, int wait_ms = -1);
  /// Returns to the first row; only of a regular file. False: refused.
  bool rewind();

  const RowForm& form() const { return form_; }
  bool regular() const { return lines_->regular(); }
  int line() const { return lines_->line(); }
  /// Place and reason of a refusal: "path:line:column: header: reason".
  const std::string& error() const { return error_; }

 private:
  struct Column {
    std::string header;
    int group = 0, index = 0;
    std::size_t place = 0;  // in the numbers of a row
    double scale = 1.0;
  };

  RowResult next_line(std::string_view& line, int wait_ms);
  bool read_header(std::string_view line);
  bool add(std::string_view header);
  bool find(const std::string& si, Column& column) const;
  bool complete();
  bool some_or_all(int group, std::uint32_t found);
  bool read_row(std::string_view line, Row& row);
  bool refuse(int line, int column, std::string_view header, std::string_view reason);

  std::unique_ptr<LineReader> lines_ = std::make_unique<LineReader>();
  std::string path_, error_;
  std::vector<JointName> joints_;
  std::vector<Column> columns_;
  Allow allow_;
  RowForm form_;
  char separator_ = ',';
};

}  // namespace tactus::ctl
