#include "program/results/run_recording.hpp"

#include <pb_encode.h>

#include <cmath>

#include "gateway/server/codec.hpp"
#include "gateway/version.hpp"
#include "kernel/load/ini.hpp"
#include "program/results/timing_report.hpp"

// The schema of tactus.proto, as protoc writes it; the assembler copies it to its place.
asm(".pushsection .rodata\n.global proto_schema\nproto_schema:\n"
    ".incbin \"build/generated/gateway/tactus.schema\"\n"
    ".global proto_schema_end\nproto_schema_end:\n.byte 0\n.popsection\n");
extern "C" const char proto_schema[], proto_schema_end[];

namespace tactus {
namespace {

constexpr int kMostComponents = 8;
constexpr int kTimeField = 1, kFirstField = 2;
static_assert(kDof <= kMostComponents && kFirstField + kMostComponents <= 16);  // tags of one byte

// Wire types of protobuf.
constexpr int kVarint = 0, kEightBytes = 1, kSized = 2;

char tag(int field, int wire_type) {
  return static_cast<char>(field << 3 | wire_type);
}

void append(std::string& to, int field, std::string_view bytes) {
  to += tag(field, kSized);
  std::size_t size = bytes.size();
  for (; size >= 128; size >>= 7) to += static_cast<char>(size | 128);
  to += static_cast<char>(size);
  to += bytes;
}

void append(std::string& to, int field, double value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  to += tag(field, kEightBytes);
  to.append(raw, sizeof value);
}

/// Appends a field of doubles to a DescriptorProto.
void append_double(std::string& message, std::string_view name, int number) {
  constexpr int kName = 1, kNumber = 3, kLabel = 4, kType = 5, kField = 2;
  constexpr char kOptional = 1, kDouble = 1;
  std::string field;
  append(field, kName, name);
  for (const auto& [what, value] : {std::pair{kNumber, static_cast<char>(number)},
                                    std::pair{kLabel, kOptional}, std::pair{kType, kDouble}}) {
    field += tag(what, kVarint);
    field += value;
  }
  append(message, kField, field);
}

/// "JointPosition"
std::string message_name(const QuantityInfo& quantity) {
  std::string name;
  bool begins = true;
  for (const char* c = quantity.name; *c != '\0'; ++c) {
    if (*c != ' ') name += begins ? static_cast<char>(*c - 'a' + 'A') : *c;
    begins = *c == ' ';
  }
  return name;
}

/// Returns the FileDescriptorSet of a message with the time and the components of a quantity.
std::string schema_of(const QuantityInfo& quantity) {
  constexpr int kMessageName = 1, kFileName = 1, kPackage = 2, kMessageType = 4, kSyntax = 12,
                kFile = 1;
  const std::string name = message_name(quantity);
  std::string message, file, files;
  append(message, kMessageName, name);
  append_double(message, "time_s", kTimeField);
  std::string_view words = quantity.components;
  for (int i = 0; i < quantity.recorded; ++i) {
    const std::string_view word = take_word(words);
    append_double(message, word.empty() ? "joint" + std::to_string(i + 1) : std::string(word),
                  kFirstField + i);
  }
  append(file, kFileName, "tactus/" + name + ".proto");
  append(file, kPackage, "tactus");
  append(file, kMessageType, message);
  append(file, kSyntax, "proto3");
  append(files, kFile, file);
  return files;
}

std::int64_t ns_of(double time_s) {
  return std::llround(time_s * 1e9);
}

}  // namespace

bool RunRecording::open(const char* path, const Session& session) {
  session_ = &session;
  if (!file_.open(path)) return false;
  writer_.begin(file_.stream(), std::string("tactus ") + kVersion);
  const std::string_view schema(proto_schema,
                                static_cast<std::size_t>(proto_schema_end - proto_schema));
  event_channel_ = writer_.add_channel(writer_.add_schema("tactus.Event", schema), "/event");
  std::array<McapWriter::Id, kQuantities.size()> schemas{};
  const Recording& recording = session.pipeline.recording;
  for (std::size_t i = 0; i < static_cast<std::size_t>(recording.signal_count); ++i) {
    const PortEntry& port = *recording.signals[i];
    const QuantityInfo& quantity = info(port.quantity);
    McapWriter::Id& id = schemas[static_cast<std::size_t>(port.quantity)];
    if (id == 0) id = writer_.add_schema("tactus." + message_name(quantity), schema_of(quantity));
    channels_[i] = writer_.add_channel(id, port.block.c_str() + std::string(".") + port.port,
                                       quantity.name, quantity.unit);
  }
  return true;
}

void RunRecording::watch(const MotionState& motion) {
  const char* const phase = name(motion.phase);
  if (phase == phase_) return;
  phase_ = phase;
  static_cast<void>(notes_.post({motion.time_s, "phase", phase, Status::kOk}));
}

void RunRecording::watch(const Report& report) {
  if (report.outcome == Outcome::kReleased) return;  // of a store, not of the motion
  static_cast<void>(
      notes_.post({report.time_s, "report", name(report.outcome), report.verdict.status}));
}

void RunRecording::write_row(const double* row) {
  const Recording& recording = session_->pipeline.recording;
  const double time_s = *row++;
  std::string message;
  for (std::size_t i = 0; i < static_cast<std::size_t>(recording.signal_count); ++i) {
    message.clear();
    append(message, kTimeField, time_s);
    for (int n = 0; n < info(recording.signals[i]->quantity).recorded; ++n)
      append(message, kFirstField + n, *row++);
    writer_.write(channels_[i], ns_of(time_s), message);
  }
}

void RunRecording::write_event(double time_s, const char* name, Status status,
                               std::string_view text) {
  tactus_Event event = tactus_Event_init_zero;
  event.server_ns = ns_of(time_s);
  set_text(event.name, name);
  event.status = static_cast<std::uint32_t>(status);
  set_text(event.text, text);
  std::array<std::uint8_t, tactus_Event_size> bytes;
  pb_ostream_t stream = pb_ostream_from_buffer(bytes.data(), bytes.size());
  static_cast<void>(pb_encode(&stream, tactus_Event_fields, &event));  // the size fits
  writer_.write(event_channel_, event.server_ns,
                {reinterpret_cast<const char*>(bytes.data()), stream.bytes_written});
}

void RunRecording::write_events() {
  const EventLog& ladder = session_->executive.events();
  ladder_events_ = std::max(ladder_events_, ladder.lost());
  for (Event event; ladder.read(ladder_events_, event); ++ladder_events_)
    write_event(event.commanded * session_->pipeline.robot.period_s(), "rung", event.status,
                describe(event, session_->hal));
  for (Note note; notes_.take(note);) write_event(note.time_s, note.name, note.status, note.text);
}

bool RunRecording::close(const RunResult& result) {
  write_events();
  Reason text(result.name);
  if (!result.why.empty()) text << ": " << result.why;
  write_event(result.simulated_s, "result", result.fault, text);
  writer_.end();
  return file_.close();
}

}  // namespace tactus
