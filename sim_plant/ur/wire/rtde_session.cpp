#include "sim_plant/ur/wire/rtde_session.hpp"

namespace tactus::ur {
namespace {

constexpr std::size_t kLongestReply = 24 * 1024;  // fits a packet with all the fields there are
constexpr double kRounding = 1e-9;

/// A packet under construction; its length is written last.
struct PacketWriter : ByteWriter {
  PacketWriter(RtdeType type, std::uint8_t* data, std::size_t capacity)
      : ByteWriter(data, capacity) {
    u16(0);
    u8(static_cast<std::uint8_t>(type));
  }
  void send(Outbox& out) {
    set_u16(0, size());
    if (ok()) out.put(data(), size());
  }
};

void add_type(FieldType type, bool first, ByteWriter& writer) {
  if (!first) writer.u8(',');
  writer.text(name(type));
}

}  // namespace

void RtdeSession::open(int owner) {
  frames_.clear();
  owner_ = owner;
  version_ = 1;
  running_ = false;
  answers_ = {};
  output_count_ = input_count_ = recipe_count_ = 0;
}

bool RtdeSession::receive(const std::uint8_t* data, std::size_t size, const RtdeContext& context,
                          Outbox& out) {
  while (size > 0) {
    const std::size_t taken = frames_.take(data, size);
    data += taken;
    size -= taken;
    Packet packet;
    NextPacket next;
    while ((next = frames_.next(packet)) == NextPacket::kPacket)
      if (!handle(packet, context, out)) return false;
    if (next == NextPacket::kBroken) {
      say(RtdeLevel::kError, "A packet shorter than its own header: connection closed", out);
      return false;
    }
  }
  return true;
}

bool RtdeSession::handle(const Packet& packet, const RtdeContext& context, Outbox& out) {
  ByteReader in(packet.data + kRtdeHeader, packet.size - kRtdeHeader);
  const auto type = static_cast<RtdeType>(packet.data[2]);
  switch (type) {
    case RtdeType::kRequestProtocolVersion: {
      const int asked = in.u16();
      const bool accepted = in.done() && (asked == 1 || asked == 2);
      if (accepted) version_ = asked;
      reply(type, accepted ? 1 : 0, out);
      return true;
    }
    case RtdeType::kGetUrcontrolVersion: {
      std::array<std::uint8_t, 19> bytes;
      PacketWriter writer(type, bytes.data(), bytes.size());
      const Version& version = context.version;
      for (const std::uint32_t part : {version.major, version.minor, version.bugfix, version.build})
        writer.u32(part);
      writer.send(out);
      return true;
    }
    case RtdeType::kTextMessage: return true;  // a real robot writes it into its log
    case RtdeType::kDataPackage: take_data(in, context, out); return true;
    case RtdeType::kSetupOutputs: setup_outputs(in, context, out); return true;
    case RtdeType::kSetupInputs: setup_inputs(in, context, out); return true;
    case RtdeType::kStart:
      reply(type, output_count_ > 0 ? 1 : 0, out);
      running_ = output_count_ > 0;
      due_ = 0.0;
      return true;
    case RtdeType::kPause:
      reply(type, 1, out);
      running_ = false;
      return true;
  }
  say(RtdeLevel::kError, "Unknown type of packet", out);
  return true;
}

void RtdeSession::setup_outputs(ByteReader& in, const RtdeContext& context, Outbox& out) {
  std::array<std::uint8_t, kLongestReply> bytes;
  PacketWriter writer(RtdeType::kSetupOutputs, bytes.data(), bytes.size());
  const double fastest_hz = 1.0 / context.version.cycle_s();
  const double rate_hz = version_ == 1 ? fastest_hz : in.f64();
  std::string_view names = in.rest(), one;
  bool good =
      in.ok() && !running_ && !names.empty() && rate_hz >= kRtdeSlowest_Hz && rate_hz <= fastest_hz;
  if (version_ == 2) writer.u8(good ? 1 : 0);
  std::size_t count = 0;
  while (good && next_name(names, one)) {
    const OutputField field = find_output(one, context.version);
    add_type(field.type, count == 0, writer);
    if (count == kMaxOutputs || !writer.ok()) break;
    outputs_[count++] = field;
  }
  for (std::size_t i = 0; i < count; ++i) good = good && outputs_[i].type < FieldType::kNotFound;
  const bool too_long = !names.empty() || !writer.ok();
  if (!running_) output_count_ = good && !too_long ? count : 0;
  if (output_count_ > 0 && !running_) rate_ = rate_hz / fastest_hz;
  if (too_long && !running_ && rate_hz >= kRtdeSlowest_Hz && rate_hz <= fastest_hz)
    return say(RtdeLevel::kError, "The recipe has more fields than are possible", out);
  writer.send(out);
}

bool RtdeSession::find_inputs(std::string_view names, const RtdeContext& context,
                              ByteWriter& types) {
  std::string_view one;
  bool good = !names.empty();
  const std::size_t first = input_count_;
  while (next_name(names, one) && input_count_ < kMaxInputs) {
    InputField field = find_input(one, context.version);
    if (field.type != FieldType::kNotFound && !context.claims.free_for(field, owner_))
      field.type = FieldType::kInUse;
    add_type(field.type, input_count_ == first, types);
    good = good && field.type < FieldType::kNotFound;
    inputs_[input_count_++] = field;
  }
  return good && names.empty() && types.ok() && recipe_count_ < kMaxInputRecipes;
}

void RtdeSession::setup_inputs(ByteReader& in, const RtdeContext& context, Outbox& out) {
  std::array<std::uint8_t, kLongestReply> bytes;
  PacketWriter writer(RtdeType::kSetupInputs, bytes.data(), bytes.size());
  const std::size_t first = input_count_, id_at = writer.size();
  writer.u8(0);
  if (!find_inputs(in.rest(), context, writer)) {
    input_count_ = first;
    writer.send(out);
    return;
  }
  for (std::size_t i = first; i < input_count_; ++i) context.claims.claim(inputs_[i], owner_);
  recipes_[recipe_count_++] = {static_cast<std::uint16_t>(first),
                               static_cast<std::uint16_t>(input_count_ - first)};
  bytes[id_at] = static_cast<std::uint8_t>(recipe_count_);
  writer.send(out);
}

void RtdeSession::take_data(ByteReader& in, const RtdeContext& context, Outbox& out) {
  const std::size_t id = in.u8();
  if (!in.ok() || id == 0 || id > recipe_count_)
    return say(RtdeLevel::kError, "Data package with an unknown recipe", out);
  const Recipe& recipe = recipes_[id - 1];
  InputPackage package;
  bool finite = true;
  for (std::size_t i = 0; i < recipe.count; ++i)
    finite = package.read(inputs_[recipe.first + i], in) && finite;
  if (!in.done())
    return say(RtdeLevel::kError, "Data package with another size than its recipe", out);
  if (!finite) return say(RtdeLevel::kError, "Data package with a value that is not finite", out);
  package.apply(context.io, context.cycle);
  answers_.answer();
}

void RtdeSession::tick(const Image& image, Outbox& out) {
  if (!running_) return;
  due_ += rate_;
  if (due_ < 1.0 - kRounding) return;
  due_ -= 1.0;
  std::array<std::uint8_t, kLongestReply> bytes;
  PacketWriter writer(RtdeType::kDataPackage, bytes.data(), bytes.size());
  if (version_ == 2) writer.u8(1);
  for (std::size_t i = 0; i < output_count_; ++i) outputs_[i].write(image, writer);
  writer.send(out);
  answers_.packet();
}

void RtdeSession::reply(RtdeType type, std::uint8_t value, Outbox& out) {
  std::array<std::uint8_t, 4> bytes;
  PacketWriter writer(type, bytes.data(), bytes.size());
  writer.u8(value);
  writer.send(out);
}

void RtdeSession::say(RtdeLevel level, std::string_view text, Outbox& out) {
  std::array<std::uint8_t, 300> bytes;
  PacketWriter writer(RtdeType::kTextMessage, bytes.data(), bytes.size());
  if (version_ == 1) {
    writer.u8(static_cast<std::uint8_t>(level));
    writer.text(text);
  } else {
    writer.short_text(text);
    writer.short_text("RTDE");
    writer.u8(static_cast<std::uint8_t>(level));
  }
  writer.send(out);
}

}  // namespace tactus::ur
