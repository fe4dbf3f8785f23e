// The PDOs that an emulated drive has after it is switched on: all that CST needs, with a byte of
// padding to an even length.
#pragma once

#include <array>
#include <cstdint>

#include "hal/cia402/protocol.hpp"

namespace tactus::segment {

inline constexpr std::uint32_t kPadding8 = 0x00000008;

inline constexpr std::array<std::uint32_t, 5> kDefaultOutputs = {
    cia402::kControlword.mapping(), cia402::kTargetTorque.mapping(),
    cia402::kTorqueOffset.mapping(), cia402::kModeOfOperation.mapping(), kPadding8};

inline constexpr std::array<std::uint32_t, 7> kDefaultInputs = {cia402::kStatusword.mapping(),
                                                                cia402::kPositionActual.mapping(),
                                                                cia402::kVelocityActual.mapping(),
                                                                cia402::kTorqueActual.mapping(),
                                                                cia402::kErrorCode.mapping(),
                                                                cia402::kModeDisplay.mapping(),
                                                                kPadding8};

}  // namespace tactus::segment
