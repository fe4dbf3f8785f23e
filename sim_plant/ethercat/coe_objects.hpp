// CoeObjects: the object dictionary of a drive on EtherCAT: that of sim_plant/drives without the
// objects that only CAN has, and with sync managers, PDO assignment and PDO mapping as CoE has them
// (ETG.1000.6).
#pragma once

#include "sim_plant/drives/object_access.hpp"

namespace tactus::segment {

inline constexpr int kAssignable = 4;             ///< PDOs of a sync manager
inline constexpr std::size_t kMostPdoBytes = 64;  ///< of all PDOs of a sync manager

/// An entry of the process data; without a row it is padding.
struct MappedObject {
  const drives::Row* row = nullptr;
  drives::Slot slot = drives::kNoSlot;
  std::size_t bytes = 0;
};

/// The process data of a direction, byte for byte.
struct ProcessData {
  std::array<MappedObject, kMostPdoBytes> entries{};
  std::size_t count = 0, bytes = 0;
};

/// Type and access of an object, as the rows of the dictionary have them.
struct ObjectEntry {
  drives::Type type = drives::Type::kU8;
  std::uint8_t access = 0;
  bool only_preop = false;  ///< what of it is written is written in PREOP
};

class CoeObjects {
 public:
  explicit CoeObjects(drives::Dictionary& dictionary) : dictionary_(dictionary) {}

  /// The defaults of assignment and mapping, after the dictionary has been reset. [any]
  void reset();

  can::SdoAbort read(std::uint16_t index, std::uint8_t sub, drives::ObjectBytes& bytes) const;
  /// `preop`: the state in which PDOs may be changed. `powered`: operation enabled, or a stop.
  /// [any]
  can::SdoAbort write(std::uint16_t index, std::uint8_t sub, const std::uint8_t* data,
                      std::size_t size, bool preop, bool powered);
  /// False for an object that is not there at all. [any]
  bool has(std::uint16_t index) const;

  /// The next index of the list of objects after one, 0: the first; 0: there is none. [any]
  int next(int index) const;
  /// The highest sub-index of an object; -1: it does not have the object. [any]
  int last_sub(std::uint16_t index) const;
  /// Finds type and access; false: it does not have the sub-index. [any]
  bool entry(std::uint16_t index, std::uint8_t sub, ObjectEntry& found) const;

  /// Lists what is assigned to the outputs, or the inputs. [any]
  ProcessData process_data(bool outputs) const;

 private:
  struct Assignment {
    std::uint8_t count = 1;
    std::array<std::uint16_t, kAssignable> pdos{};
  };

  can::SdoAbort write_assignment(bool outputs, std::uint8_t sub, const std::uint8_t* data,
                                 std::size_t size);
  can::SdoAbort write_mapping(std::uint16_t index, std::uint8_t sub, const std::uint8_t* data,
                              std::size_t size);
  std::size_t pdo_bytes(std::uint16_t index) const;
  const Assignment& assignment(bool outputs) const { return assigned_[outputs ? 0 : 1]; }

  drives::Dictionary& dictionary_;
  std::array<Assignment, 2> assigned_;
};

}  // namespace tactus::segment
