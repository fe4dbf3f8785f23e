// The PDOs of a drive at run time (CiA 301, 7.2.2): their parameters as the dictionary has them,
// and the data between a frame and the dictionary.
#pragma once

#include <array>

#include "hal/can/protocol_frame.hpp"
#include "sim_plant/drives/object_access.hpp"

namespace tactus::drives {

inline constexpr std::uint8_t kLastSynchronous = 240;
inline constexpr std::uint8_t kRemoteSynchronous = 252, kRemoteEvent = 253;

/// Parameters of a PDO; `load` reads them again after every write to them.
struct PdoSettings {
  bool valid = false, remote = false;  ///< `remote`: answers an RTR
  std::uint16_t id = 0;
  std::uint8_t type = 255, start = 0;
  std::int64_t inhibit_ns = 0, event_ns = 0;
  std::size_t bytes = 0;
  int count = 0;
  std::array<MappedEntry, kMappable> entries{};

  /// `communication` and `mapping`: indices of its records. [any]
  void load(const Dictionary& dictionary, std::uint16_t communication, std::uint16_t mapping);
  bool synchronous() const { return type <= kLastSynchronous; }
};

struct Rpdo {
  PdoSettings settings;
  bool fresh = false;  ///< received since the last SYNC
  std::array<std::uint8_t, can::kMaxData> received{};
  std::int64_t deadline_ns = 0;  ///< of the next one; 0: not watched
};

struct Tpdo {
  PdoSettings settings;
  bool sent_once = false;
  bool counting = false;  ///< its SYNC start value has come
  int syncs = 0;
  std::array<std::uint8_t, can::kMaxData> last{};
  std::int64_t next_event_ns = 0, earliest_ns = 0;
};

/// Returns the data of a TPDO. [any]
std::array<std::uint8_t, can::kMaxData> pack(const Dictionary& dictionary, const PdoSettings& pdo);

}  // namespace tactus::drives
