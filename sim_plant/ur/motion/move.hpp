// Move: the parameters of a move command of a script.
#pragma once

#include "sim_plant/ur/motion/kinematics.hpp"

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
  Frame via, target;          ///< of the others; only the position of `via` counts
  bool fixed = false;         ///< movec: the tool keeps its orientation relative to the circle
  /// Not positive: the default of the script manual. `t`, from rest to rest, has precedence.
  double a = 0.0, v = 0.0, t = 0.0;
  double r = 0.0;  ///< blend radius, m
};

}  // namespace tactus::ur
