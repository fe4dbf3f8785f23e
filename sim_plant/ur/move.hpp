// Move: a move as a command of a script has it.
#pragma once

#include "sim_plant/ur/kinematics.hpp"

namespace tactus::ur {

struct Move {
  enum class Kind : std::uint8_t {
    kJ,  ///< movej: the joints keep their proportions
    kL,  ///< movel: a line of the tool
    kP,  ///< movep: a line, with blends in which the tool keeps its speed
    kC,  ///< movec: a circle
  };
  Kind kind = Kind::kJ;
  Joints q = Joints::Zero();  ///< of movej
  Frame via, target;          ///< of the others; of `via` the place
  bool fixed = false;         ///< movec: the tool keeps its attitude to the circle
  /// Not positive: the default of the script manual. `t`, of a move from rest to rest, comes first.
  double a = 0.0, v = 0.0, t = 0.0;
  double r = 0.0;  ///< blend radius, m
};

}  // namespace tactus::ur
