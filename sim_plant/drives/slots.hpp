// The places of the objects that several parts of a drive use (CiA 402).
#pragma once

#include "sim_plant/drives/dictionary.hpp"

namespace tactus::drives {

inline constexpr Slot kControlword = slot_of(0x6040), kMode = slot_of(0x6060),
                      kDisplay = slot_of(0x6061), kMaxTorque = slot_of(0x6072),
                      kRatedTorque = slot_of(0x6076), kMaxSpeed = slot_of(0x6080),
                      kVelocityUnit = slot_of(0x60A9), kVelocityOffset = slot_of(0x60B1);

}  // namespace tactus::drives
