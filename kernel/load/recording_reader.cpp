#include "kernel/load/recording_reader.hpp"

namespace tactus {
namespace {

struct RecorderPlace {
  const Ini& ini;
  LoadError& error;

  Status refuse(Status status, const char* key, std::string_view reason) const {
    const IniSection* section = ini.find("recorder");
    const IniEntry* entry = section ? ini.find(*section, key) : nullptr;
    return error.refuse(status,
                        entry     ? entry->line
                        : section ? section->line
                                  : 0,
                        "recorder", key, reason);
  }
};

Status find_output(const PortTable& ports, std::string_view name, const char* key,
                   const RecorderPlace& place, const PortEntry*& port) {
  port = ports.find(name);
  if (port == nullptr)
    return place.refuse(Status::kUnknownPort, key,
                        Message("unknown output '")
                            << name << "'; expected one of [robot] or of a block");
  if (!port->offered)
    return place.refuse(Status::kNotOffered, key,
                        Message("") << name << ": the robot has no such sensor");
  if (info(port->quantity).recorded == 0)
    return place.refuse(Status::kWrongQuantity, key,
                        Message("") << name << " is a " << info(port->quantity).name
                                    << ", which cannot be recorded");
  return Status::kOk;
}

Status add_signal(Recording& recording, const PortEntry* port, const RecorderPlace& place) {
  if (recording.signal_count == kMaxSignals)
    return place.refuse(Status::kTooLarge, "signals",
                        Message("more than ") << kMaxSignals << " outputs to record");
  for (int i = 0; i < recording.signal_count; ++i) {
    if (recording.signals[static_cast<std::size_t>(i)] == port)
      return place.refuse(Status::kDuplicate, "signals",
                          Message("") << port->block << "." << port->port << " is named twice");
  }
  recording.signals[static_cast<std::size_t>(recording.signal_count++)] = port;
  return Status::kOk;
}

Status read_signals(std::string_view list, const PortTable& ports, Recording& recording,
                    const RecorderPlace& place) {
  for (std::string_view word = take_word(list); !word.empty(); word = take_word(list)) {
    const PortEntry* port = nullptr;
    TRY(find_output(ports, word, "signals", place, port));
    TRY(add_signal(recording, port, place));
  }
  return Status::kOk;
}

/// Digital outputs are among them only if the pipeline puts them out.
Status read_all_signals(const Pipeline& pipeline, Recording& recording,
                        const RecorderPlace& place) {
  const PortTable& ports = pipeline.ports;
  for (int i = 0; i < ports.count(); ++i) {
    const bool unused =
        ports[i].quantity == Quantity::kDigitalOutputs && !pipeline.robot.commands_outputs();
    if (ports[i].offered && info(ports[i].quantity).recorded > 0 && !unused)
      TRY(add_signal(recording, &ports[i], place));
  }
  return Status::kOk;
}

Status check_pair(const Tracking& pair, const RecorderPlace& place) {
  const PortEntry &reference = *pair.reference, &measured = *pair.measured;
  Message reason;
  reason << reference.block << "." << reference.port;
  if (pair.reference == pair.measured)
    return place.refuse(Status::kBadValue, "tracking", reason << " is compared with itself");
  if (reference.quantity != measured.quantity)
    return place.refuse(Status::kWrongQuantity, "tracking",
                        reason << " is a " << info(reference.quantity).name << ", but "
                               << measured.block << "." << measured.port << " is a "
                               << info(measured.quantity).name);
  return Status::kOk;
}

Status read_tracking(std::string_view list, const PortTable& ports, Recording& recording,
                     const RecorderPlace& place) {
  for (std::string_view word = take_word(list); !word.empty(); word = take_word(list)) {
    Tracking pair;
    TRY(find_output(ports, word, "tracking", place, pair.reference));
    const std::string_view measured = take_word(list);
    if (measured.empty())
      return place.refuse(Status::kBadValue, "tracking",
                          Message("") << word << " is not followed by a measured output");
    TRY(find_output(ports, measured, "tracking", place, pair.measured));
    TRY(check_pair(pair, place));
    if (recording.tracking_count == kMaxTracking)
      return place.refuse(Status::kTooLarge, "tracking",
                          Message("more than ") << kMaxTracking << " pairs");
    recording.tracking[static_cast<std::size_t>(recording.tracking_count++)] = pair;
  }
  return Status::kOk;
}

}  // namespace

Status read_recording(const Ini& ini, Pipeline& pipeline, LoadError& error) {
  const RecorderPlace place{ini, error};
  const RecorderSection& section = pipeline.recorder;
  Recording& recording = pipeline.recording;
  if (section.signals.empty()) {
    TRY(read_all_signals(pipeline, recording, place));
  } else {
    TRY(read_signals(section.signals, pipeline.ports, recording, place));
  }
  return read_tracking(section.tracking, pipeline.ports, recording, place);
}

}  // namespace tactus
