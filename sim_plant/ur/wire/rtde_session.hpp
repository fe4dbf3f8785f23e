// A session of RTDE, and whether its client keeps up.
#pragma once

#include <algorithm>

#include "sim_plant/ur/wire/io.hpp"
#include "sim_plant/ur/wire/outbox.hpp"

namespace tactus::ur {

/// Answers: counts whether a client has answered every packet with a set-point, so that the next
/// cycle may begin without waiting for the wall clock.
///
/// If a client is ahead, because it did not wait for a late packet, its set-points count for later
/// packets. A packet that it leaves unanswered is not waited for later.
class Answers {
 public:
  /// Counts a packet sent to the client. [cyclic]
  void packet() {
    if (owed_ > 0) in_a_row_ = 0;
    owed_ = std::min(owed_, 0) + 1;
  }
  /// Counts a set-point of the client. [any]
  void answer() {
    owed_ = std::max(owed_ - 1, -kMostAhead);
    in_a_row_ = std::min(in_a_row_ + 1, kSteady);
  }
  bool missing() const { return owed_ > 0; }
  /// True if the client has answered kSteady packets in a row, so that waiting for it makes sense.
  bool steady() const { return in_a_row_ == kSteady; }

 private:
  static constexpr int kMostAhead = 8, kSteady = 25;
  int owed_ = 0;      // packets without an answer; negative: answers ahead
  int in_a_row_ = 0;  // answers since the last packet without one
};

/// The parts of the controller that a session needs.
struct RtdeContext {
  const Version& version;
  Io& io;
  Claims& claims;
  std::int64_t cycle;  ///< number of the present cycle
};

/// RtdeSession: one client of port 30004. Protocol version 1 until the client asks for 2.
class RtdeSession {
 public:
  /// Begins the session of a client; `owner` is its number among the claims.
  void open(int owner);
  /// Ends the session and releases its claims.
  void close(Claims& claims) { claims.release(owner_); }

  /// Takes bytes from the client, in pieces of any size. False: the stream cannot be read any
  /// further.
  bool receive(const std::uint8_t* data, std::size_t size, const RtdeContext& context, Outbox& out);
  /// Runs one cycle of the controller: sends a sample, if it is due.
  void tick(const Image& image, Outbox& out);

  bool running() const { return running_; }
  /// True if the client gets packets and writes inputs, and so may close a loop.
  bool closes_loop() const { return running_ && recipe_count_ > 0; }
  const Answers& answers() const { return answers_; }
  /// The client's number among the claims.
  int owner() const { return owner_; }

 private:
  static constexpr std::size_t kMaxOutputs = 1024;
  static constexpr std::size_t kMaxInputRecipes = 255, kMaxInputs = 8192;
  struct Recipe {
    std::uint16_t first = 0, count = 0;
  };

  bool handle(const Packet& packet, const RtdeContext& context, Outbox& out);
  void setup_outputs(ByteReader& in, const RtdeContext& context, Outbox& out);
  void setup_inputs(ByteReader& in, const RtdeContext& context, Outbox& out);
  bool find_inputs(std::string_view names, const RtdeContext& context, ByteWriter& types);
  void take_data(ByteReader& in, const RtdeContext& context, Outbox& out);
  void reply(RtdeType type, std::uint8_t value, Outbox& out);
  void say(RtdeLevel level, std::string_view text, Outbox& out);

  RtdeFrames frames_;
  int owner_ = -1;
  int version_ = 1;
  bool running_ = false;
  std::array<OutputField, kMaxOutputs> outputs_;
  std::size_t output_count_ = 0;
  double rate_ = 1.0, due_ = 0.0;  // samples per cycle, and the fraction due of the next one
  std::array<InputField, kMaxInputs> inputs_;
  std::size_t input_count_ = 0;
  std::array<Recipe, kMaxInputRecipes> recipes_;
  std::size_t recipe_count_ = 0;
  Answers answers_;
};

}  // namespace tactus::ur
