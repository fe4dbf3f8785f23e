// Kinds: the list of all kinds of block. A board may build fewer, to save code: KINDS_m7 in its
// board.mk. Everything that depends on the kind of a block finds its type here.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

#include "kernel/control/admittance.hpp"
#include "kernel/control/cartesian_pose.hpp"
#include "kernel/control/pd_gravity.hpp"
#include "kernel/control/pid.hpp"
#include "kernel/control/wrench_front_end.hpp"
#include "kernel/guard/obstacle.hpp"
#include "kernel/model/robot_model.hpp"
#include "kernel/reference/blocks/frame.hpp"
#include "kernel/reference/blocks/joint_reference_generator.hpp"
#include "kernel/reference/blocks/task_reference_generator.hpp"

#ifdef TACTUS_LAWS
#include TACTUS_LAWS  // the kinds that the build makes of LAWS, TACTUS_LAW_KINDS
#else
#define TACTUS_LAW_KINDS
#endif

namespace tactus {

/// True for a law that was compiled elsewhere: what it says of itself is judged at load.
template <class Kind, class = void>
inline constexpr bool kIsForeign = false;
template <class Kind>
inline constexpr bool kIsForeign<Kind, std::void_t<decltype(&Kind::judge_description)>> = true;

template <class... Each>
struct KindList {
  static constexpr std::size_t kCount = sizeof...(Each);
  /// The word of each kind in "type = ...".
  static constexpr std::array<const char*, kCount> kTypes = {Each::kType...};
  static constexpr bool kHasForeign = (... || kIsForeign<Each>);

  static constexpr bool words_differ() {
    for (std::size_t i = 0; i < kCount; ++i) {
      for (std::size_t k = 0; k < i; ++k)
        if (std::string_view(kTypes[i]) == kTypes[k]) return false;
    }
    return true;
  }
};

#ifdef TACTUS_KINDS
using Kinds = KindList<TACTUS_KINDS TACTUS_LAW_KINDS>;
#else
/// A new controller is one line here and an #include above. kType is its word in "type = ...".
using Kinds = KindList<RobotModel,               //
                       Frame,                    //
                       BoxObstacle,              //
#if TACTUS_CONVEX
                       SphereObstacle,           //
                       CapsuleObstacle,          //
                       CylinderObstacle,         //
                       ConvexObstacle,           //
#endif
                       JointReferenceGenerator,  //
                       TaskReferenceGenerator,   //
                       PdGravity,                //
                       Pid,                      //
                       WrenchFrontEnd,           //
                       Admittance,               //
                       CartesianPose TACTUS_LAW_KINDS>;
#endif

static_assert(Kinds::words_differ(),
              "two kinds have the same word in `type =`: rename one, or a law of LAWS");

/// True for a torque law: a kind with an input q_d and an output tau.
template <class Kind, class = void>
inline constexpr bool kIsTorqueLaw = false;
template <class Kind>
inline constexpr bool kIsTorqueLaw<Kind, std::void_t<decltype(std::declval<Kind>().q_d.source),
                                                     decltype(std::declval<Kind>().tau.value)>> =
    true;

/// Stands for a type in an argument.
template <class T>
struct TypeOf {
  using Type = T;
};

template <class First, class... Others, class Act>
auto with_kind(KindList<First, Others...>, std::size_t kind, Act&& act) {
  if constexpr (sizeof...(Others) == 0) {
    return act(TypeOf<First>());
  } else {
    if (kind == 0) return act(TypeOf<First>());
    return with_kind(KindList<Others...>(), kind - 1, act);
  }
}

/// Returns act(TypeOf<Kind>()) for the kind of that number, less than Kinds::kCount. [any]
template <class Act>
auto with_kind(std::size_t kind, Act&& act) {
  return with_kind(Kinds(), kind, act);
}

}  // namespace tactus
