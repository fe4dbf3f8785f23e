// Io: the values that clients and scripts write (registers, digital and analogue outputs, the speed
// slider), and the claims of connections on RTDE's inputs.
#pragma once

#include <array>

#include "sim_plant/ur/wire/rtde_fields.hpp"

namespace tactus::ur {

struct Io {
  Registers input, output;
  std::uint64_t digital_inputs = 0, digital_outputs = 0;  ///< 0-7 standard, 8-15 conf., 16-17 tool
  std::uint32_t analog_types = 0;  ///< bits 0 and 1: inputs, 2 and 3: outputs; 1 is voltage
  std::array<double, 2> analog_inputs{}, analog_outputs{};  ///< A or V
  std::int32_t tool_voltage = 0;
  double speed_fraction = 1.0;                          ///< the slider
  std::array<std::int64_t, kInputVariables> written{};  ///< cycle of the last write, for watchdogs

  void set_digital(int bit, bool on) {
    const std::uint64_t mask = std::uint64_t{1} << bit;
    digital_outputs = on ? digital_outputs | mask : digital_outputs & ~mask;
  }
  /// Sets output `i`, 0 or 1, to a ratio of its range: 4 to 20 mA, or 0 to 10 V.
  void set_analog(int i, double ratio);
};

/// The values of one input package; masks take effect at its end.
class InputPackage {
 public:
  /// Reads one field. False for NaN and infinity.
  bool read(const InputField& field, ByteReader& reader);
  /// Applies the package, as of `cycle`.
  void apply(Io& io, std::int64_t cycle) const;

 private:
  struct Write {
    InputField field;
    std::uint32_t number = 0;
    double value = 0.0;
  };
  std::array<Write, 256> writes_;
  std::size_t count_ = 0;
  std::array<std::uint8_t, 13> bytes_{};  // masks and values by Input
  std::uint32_t slider_mask_ = 0;
  double slider_ = 1.0;
  std::array<double, 2> analog_{};
};

/// The owner of each claimed input. A claim ends with the connection.
class Claims {
 public:
  bool free_for(const InputField& field, int owner) const {
    const int holder = owner_[field.variable()];
    return holder == kNoOwner || holder == owner;
  }
  void claim(const InputField& field, int owner) { owner_[field.variable()] = owner; }
  void release(int owner) {
    for (int& holder : owner_)
      if (holder == owner) holder = kNoOwner;
  }
  Claims() { owner_.fill(kNoOwner); }

 private:
  static constexpr int kNoOwner = -1;
  std::array<int, kInputVariables> owner_;
};

}  // namespace tactus::ur
