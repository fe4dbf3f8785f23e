#include "kernel/model/mounting.hpp"

#include "kernel/math/so3.hpp"

namespace tactus {

Vector3 gravity_in_base(const Vector3& mounting) {
  const Vector3 roll(-mounting[0], 0.0, 0.0), pitch(0.0, -mounting[1], 0.0);
  return exp_so3(roll) * (exp_so3(pitch) * Vector3(0.0, 0.0, -kGravity_m_s2));
}

}  // namespace tactus
