// A law that was compiled elsewhere, behind the C interface of kernel/core/tactus_law.h, as a
// block. `make LAWS=` makes a kind of it (docs/library.md).
#pragma once

#include <array>
#include <cstddef>
#include <new>

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/law_check.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/port.hpp"

namespace tactus {

/// The law with the symbol `kLaw`, which LAWS calls `kWord`. Its state is in the bytes behind it.
template <const tactus_law& kLaw, const char* kWord>
class alignas(std::max_align_t) CLaw {
 public:
  static constexpr const char* kType = kWord;

  /// Judges what the law says of itself: see judge_law(). [init]
  [[gnu::cold]] static Status judge_description(Message& why) {
    return judge_law(kLaw, kWord, why);
  }
  /// Bytes of a block and of its state.
  static std::size_t size() { return sizeof(CLaw) + std::min(kLaw.state_size, kMostState); }
  static int bound_us() { return static_cast<int>(std::min(kLaw.bound_us, kMostBound_us)); }

  /// A law whose description is refused has no parameters and ports.
  CLaw() {
    Message why;
    if (judge_description(why) != Status::kOk) return;
    for (; parameter_count_ < kLaw.parameter_count; ++parameter_count_) {
      parameters_[parameter_count_].setConstant(kLaw.parameters[parameter_count_].initial);
      values_[parameter_count_] = parameters_[parameter_count_].data();
    }
    for (; input_count_ < kLaw.input_count; ++input_count_) {
      each(kLaw.inputs[input_count_],
           [this](auto q) { new (inputs_[input_count_].bytes) In<q.value>(); });
    }
    for (; output_count_ < kLaw.output_count; ++output_count_) {
      each(kLaw.outputs[output_count_], [this](auto q) {
        auto& port = *new (outputs_[output_count_].bytes) Out<q.value>();
        written_[output_count_] = static_cast<double*>(static_cast<void*>(&port.value));
      });
    }
  }
  CLaw(const CLaw&) = delete;
  CLaw& operator=(const CLaw&) = delete;

  template <class Visitor>
  void describe(Visitor& visit) {
    for (std::uint32_t i = 0; i < parameter_count_; ++i) {
      const tactus_law_parameter& its = kLaw.parameters[i];
      const Range range = {its.lower, its.upper};
      if (its.per_joint != 0)
        visit.param(its.name, parameters_[i], range, its.unit);
      else
        visit.param(its.name, parameters_[i][0], range, its.unit);
    }
    for (std::uint32_t i = 0; i < input_count_; ++i) {
      const tactus_law_port& its = kLaw.inputs[i];
      each(its, [&](auto q) {
        if (its.optional != 0)
          visit.optional(its.name, input<q.value>(i));
        else
          visit.in(its.name, input<q.value>(i));
      });
    }
    for (std::uint32_t i = 0; i < output_count_; ++i) {
      each(kLaw.outputs[i], [&](auto q) { visit.out(kLaw.outputs[i].name, output<q.value>(i)); });
    }
  }

  /// Returns what step() does. [init]
  [[gnu::cold]] Status start(double dt_s) {
    period_s_ = dt_s;
    for (std::uint32_t i = 0; i < input_count_; ++i) {
      each(kLaw.inputs[i], [&](auto q) {
        const void* source = input<q.value>(i).source;
        read_[i] = static_cast<const double*>(source);
      });
    }
    const Status status = judge(kLaw.start(state(), &data_, dt_s));
    started_ = status == Status::kOk;
    return status;
  }
  /// Continues, or starts a law without resume. [init]
  [[gnu::cold]] Status resume() {
    if (kLaw.resume == nullptr) return start(period_s_);
    return judge(kLaw.resume(state(), &data_, period_s_));
  }

  /// Returns what the law does; kCommandNotFinite if an output is not finite; kBadValue if what it
  /// returns is no status that a law may return. [cyclic]
  Status step(double dt_s) { return judge(kLaw.step(state(), &data_, dt_s)); }
  /// The drives may be armed before the first start(). [cyclic]
  void brake(Status /*why*/, BrakeWay way) {
    if (started_ && kLaw.brake != nullptr) kLaw.brake(state(), way == BrakeWay::kAtOnce ? 1 : 0);
  }

 private:
  static constexpr std::size_t kMostState = 1U << 30;
  static constexpr std::uint32_t kMostBound_us = 1000000;

  template <class Port>
  struct alignas(Port) Place {
    std::byte bytes[sizeof(Port)];
  };

  template <class Act>
  static void each(const tactus_law_port& port, Act&& act) {
    with_law_quantity(port.quantity, act);
  }
  template <Quantity Q>
  In<Q>& input(std::uint32_t i) {
    return *std::launder(reinterpret_cast<In<Q>*>(inputs_[i].bytes));
  }
  template <Quantity Q>
  Out<Q>& output(std::uint32_t i) {
    return *std::launder(reinterpret_cast<Out<Q>*>(outputs_[i].bytes));
  }
  void* state() { return reinterpret_cast<std::byte*>(this) + sizeof(CLaw); }

  Status judge(std::int32_t returned) const {
    switch (returned) {
      case TACTUS_OK: return finite() ? Status::kOk : Status::kCommandNotFinite;
      case TACTUS_UNSTABLE_GAIN: return Status::kUnstableGain;
      case TACTUS_STATE_NOT_FINITE: return Status::kStateNotFinite;
      case TACTUS_REFERENCE_FAULT: return Status::kReferenceFault;
      case TACTUS_COMMAND_NOT_FINITE: return Status::kCommandNotFinite;
      case TACTUS_FOLLOWING_ERROR: return Status::kFollowingError;
      default: return Status::kBadValue;
    }
  }
  bool finite() const {
    bool all = true;
    LoopBound<TACTUS_LAW_OUTPUTS> outputs;
    for (std::uint32_t i = 0; i < output_count_; ++i) {
      outputs.tick();
      each(kLaw.outputs[i], [&](auto q) {
        constexpr int kCount = sizeof(ValueOf<q.value>) / sizeof(double);
        for (int k = 0; k < kCount; ++k) all = all && written_[i][k] - written_[i][k] == 0.0;
      });
    }
    return all;
  }

  std::uint32_t parameter_count_ = 0, input_count_ = 0, output_count_ = 0;
  std::array<JointVector, TACTUS_LAW_PARAMETERS> parameters_;
  std::array<Place<In<Quantity::kScalar>>, TACTUS_LAW_INPUTS> inputs_;
  std::array<Place<Out<Quantity::kJacobian>>, TACTUS_LAW_OUTPUTS> outputs_;
  std::array<const double*, TACTUS_LAW_PARAMETERS> values_{};  // of the parameters
  std::array<const double*, TACTUS_LAW_INPUTS> read_{};
  std::array<double*, TACTUS_LAW_OUTPUTS> written_{};
  tactus_law_data data_ = {kDof, values_.data(), read_.data(), written_.data()};
  double period_s_ = 0.0;
  bool started_ = false;
};

}  // namespace tactus
