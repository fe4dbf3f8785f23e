// judge_law: what a law behind the C interface says of itself, judged before anything relies on it.
// Also the type of a port's value for the quantity that the law gives.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "kernel/core/load_error.hpp"
#include "kernel/core/quantity.hpp"
#include "kernel/core/tactus_law.h"

namespace tactus {

/// Returns act(std::integral_constant<Quantity, Q>()) for a quantity of tactus_law.h that
/// judge_law() has accepted. [any]
template <class Act>
auto with_law_quantity(std::uint32_t quantity, Act&& act) {
  const auto call = [&act](auto known) {
    static_assert(sizeof(ValueOf<known.value>) % sizeof(double) == 0, "an array of doubles");
    return act(known);
  };
  using Q = Quantity;
  switch (quantity) {
    case TACTUS_JOINT_POSITION: return call(std::integral_constant<Q, Q::kJointPosition>());
    case TACTUS_JOINT_VELOCITY: return call(std::integral_constant<Q, Q::kJointVelocity>());
    case TACTUS_JOINT_ACCELERATION: return call(std::integral_constant<Q, Q::kJointAcceleration>());
    case TACTUS_JOINT_EFFORT: return call(std::integral_constant<Q, Q::kJointEffort>());
    case TACTUS_POSE: return call(std::integral_constant<Q, Q::kPose>());
    case TACTUS_TWIST: return call(std::integral_constant<Q, Q::kTwist>());
    case TACTUS_TASK_ACCELERATION: return call(std::integral_constant<Q, Q::kTaskAcceleration>());
    case TACTUS_WRENCH: return call(std::integral_constant<Q, Q::kWrench>());
    case TACTUS_WRENCH_RATE: return call(std::integral_constant<Q, Q::kWrenchRate>());
    case TACTUS_SENSOR_WRENCH: return call(std::integral_constant<Q, Q::kSensorWrench>());
    case TACTUS_JACOBIAN: return call(std::integral_constant<Q, Q::kJacobian>());
    default: return call(std::integral_constant<Q, Q::kScalar>());
  }
}

namespace detail {

/// True for a name that a key of a pipeline file may have.
inline bool is_key(const char* name) {
  const std::string_view key(name != nullptr ? name : "");
  return !key.empty() && key.size() <= kMaxNameLength &&
         std::all_of(key.begin(), key.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_';
         });
}

/// True for a unit that fits into a cell of the table of `tactus ports`.
inline bool is_unit(const char* unit) {
  const std::string_view text(unit != nullptr ? unit : "");
  return !text.empty() && text.size() <= kMaxNameLength &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return c >= ' ' && c <= '~' && c != '|'; });
}

/// Judges `count` names, each of them name_of(i).
template <class NameOf>
Status judge_names(const char* what, std::uint32_t count, NameOf name_of, Message& why) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_key(name_of(i))) {
      why << what << " " << std::size_t{i} + 1 << " of the law has no name of 1 to "
          << kMaxNameLength << " letters, digits and _; give it one";
      return Status::kBadValue;
    }
    bool again = std::string_view(name_of(i)) == "type";
    for (std::uint32_t k = 0; k < i; ++k)
      again = again || std::string_view(name_of(i)) == name_of(k);
    if (!again) continue;
    why << what << " " << std::size_t{i} + 1 << " of the law has the name '" << name_of(i)
        << "', which is taken; rename it";
    return Status::kDuplicate;
  }
  return Status::kOk;
}

inline Status judge_quantities(const tactus_law_port* ports, std::uint32_t count, Message& why) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (ports[i].quantity >= TACTUS_JOINT_POSITION && ports[i].quantity <= TACTUS_SCALAR) continue;
    why << "port '" << ports[i].name << "' of the law has quantity "
        << std::size_t{ports[i].quantity} << "; it must be one of tactus_law.h, 1 to "
        << TACTUS_SCALAR;
    return Status::kWrongQuantity;
  }
  return Status::kOk;
}

inline Status judge_ports(const tactus_law& law, Message& why) {
  const auto key = [&law](std::uint32_t i) {
    return i < law.parameter_count ? law.parameters[i].name
                                   : law.inputs[i - law.parameter_count].name;
  };
  TRY(judge_names("key", law.parameter_count + law.input_count, key, why));
  TRY(judge_names(
      "output", law.output_count, [&law](std::uint32_t i) { return law.outputs[i].name; }, why));
  for (std::uint32_t i = 0; i < law.parameter_count; ++i) {
    if (is_unit(law.parameters[i].unit)) continue;
    why << "parameter '" << law.parameters[i].name << "' of the law has no unit of 1 to "
        << kMaxNameLength << " printable characters without |; give it one, or 1";
    return Status::kBadValue;
  }
  TRY(judge_quantities(law.inputs, law.input_count, why));
  return judge_quantities(law.outputs, law.output_count, why);
}

}  // namespace detail

/// Judges the law that LAWS calls `word`. Refused: `why` has the reason and the remedy. Bounds and
/// initial values of parameters are judged where the file is read. [init]
[[gnu::cold]] inline Status judge_law(const tactus_law& law, std::string_view word, Message& why) {
  constexpr std::size_t kAligned = alignof(std::max_align_t);
  const std::size_t alignment = law.state_alignment;
  Status status = Status::kBadValue;
  if (law.abi != TACTUS_LAW_ABI) {
    why << "the law has version " << std::size_t{law.abi} << " of tactus_law.h, the board version "
        << TACTUS_LAW_ABI << "; compile the law with the header of the board";
  } else if (law.parameter_count > TACTUS_LAW_PARAMETERS || law.input_count > TACTUS_LAW_INPUTS ||
             law.output_count > TACTUS_LAW_OUTPUTS) {
    why << "the law has more than " << TACTUS_LAW_PARAMETERS << " parameters, " << TACTUS_LAW_INPUTS
        << " inputs or " << TACTUS_LAW_OUTPUTS << " outputs; leave some out";
    status = Status::kTooLarge;
  } else if ((law.parameters == nullptr && law.parameter_count > 0) ||
             (law.inputs == nullptr && law.input_count > 0) ||
             (law.outputs == nullptr && law.output_count > 0)) {
    why << "the law counts parameters or ports of which it has no list; give the list";
  } else if (law.name == nullptr || law.name != word) {
    why << "the law is called '" << (law.name != nullptr ? law.name : "") << "' by its object, and "
        << word << " by LAWS; give both the same name";
  } else if (law.start == nullptr || law.step == nullptr) {
    why << "the law has no start or no step; give it both";
  } else if (law.bound_us == 0) {
    why << "the law states no bound of a step; give bound_us";
  } else if (alignment > kAligned || (alignment & (alignment - 1)) != 0) {
    why << "the law's state_alignment is " << alignment << "; it must be a power of two, at most "
        << kAligned;
  } else {
    status = detail::judge_ports(law, why);
  }
  return status;
}

}  // namespace tactus
