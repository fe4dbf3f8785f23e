// Laws behind the C interface as blocks: what they say of themselves, what passes to them and back,
// and what the block makes of a law that breaks the rules of tactus_law.h.
#include "kernel/control/c_law.hpp"

#include <cstring>
#include <limits>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What the calls of a law leave in its state.
struct Calls {
  int starts = 0, steps = 0, brakes = 0, resumes = 0;
  std::uint32_t at_once = 0;
  double dt_s = 0.0;
};

double written = 0.0;            // last number of the last output
std::int32_t returned = 0;       // by every call
std::uint32_t brakes_unstarted;  // of a state that start has not set

std::int32_t answer(const tactus_law_data* data) {
  data->outputs[0][0] = data->parameters[0][0] * data->inputs[0][0];
  for (std::uint32_t i = 0; i < data->joints; ++i)
    data->outputs[1][i] = data->parameters[1][i] * data->inputs[1][i];
  if (written != 0.0) data->outputs[1][data->joints - 1] = written;
  return returned;
}

constexpr tactus_law_parameter kParameters[] = {{"gain", "1", 0.0, 10.0, 2.0, 0},
                                                {"gains", "1", 0.0, 10.0, kNan, 1}};
constexpr tactus_law_port kInputs[] = {{"s", TACTUS_SCALAR, 0}, {"q", TACTUS_JOINT_POSITION, 1}};
constexpr tactus_law_port kOutputs[] = {{"s", TACTUS_SCALAR, 0}, {"q_c", TACTUS_JOINT_POSITION, 0}};

constexpr tactus_law law_called(const char* name, bool resumes) {
  tactus_law law{};
  law.abi = TACTUS_LAW_ABI;
  law.bound_us = 1;
  law.name = name;
  law.state_size = sizeof(Calls);
  law.state_alignment = alignof(Calls);
  law.parameters = kParameters;
  law.inputs = kInputs;
  law.outputs = kOutputs;
  law.parameter_count = law.input_count = law.output_count = 2;
  law.start = [](void* state, const tactus_law_data* data, double dt_s) {
    *static_cast<Calls*>(state) = {1, 0, 0, 0, 0, dt_s};
    return answer(data);
  };
  law.step = [](void* state, const tactus_law_data* data, double dt_s) {
    ++static_cast<Calls*>(state)->steps;
    static_cast<Calls*>(state)->dt_s = dt_s;
    return answer(data);
  };
  law.brake = [](void* state, std::uint32_t at_once) {
    Calls& calls = *static_cast<Calls*>(state);
    if (calls.starts != 1) ++brakes_unstarted;
    ++calls.brakes;
    calls.at_once = at_once;
  };
  if (resumes)
    law.resume = [](void* state, const tactus_law_data* data, double) {
      ++static_cast<Calls*>(state)->resumes;
      return answer(data);
    };
  return law;
}
constexpr tactus_law kLaw = law_called("law", true), kRestarts = law_called("law", false);
constexpr char kWord[] = "law";

/// A block with its state behind it, in memory that nobody has set, as the loader places it.
template <const tactus_law& kIts>
struct Placed {
  using Law = CLaw<kIts, kWord>;
  alignas(Law) std::byte bytes[sizeof(Law) + sizeof(Calls)];
  Law* block;
  double s = 3.0;
  JointVector q = JointVector::LinSpaced(1.0, kDof);

  Placed() {
    std::memset(bytes, 0x55, sizeof bytes);
    block = new (bytes) Law();
    block->describe(*this);
    written = 0.0;
    returned = TACTUS_OK;
    brakes_unstarted = 0;
  }
  const Calls& calls() const { return *reinterpret_cast<const Calls*>(bytes + sizeof(Law)); }

  // As a visitor: wires the inputs, sets the parameter that is required, finds the outputs.
  const double* s_c = nullptr;
  const JointVector* q_c = nullptr;
  void param(const char* key, double& value, const Range& range, const char*) {
    assert_string_equal(key, "gain");
    assert_true(value == 2.0 && range.contains(10.0) && !range.contains(10.1));
  }
  void param(const char*, JointVector& value, const Range&, const char*) {
    assert_true(std::isnan(value[0]) && std::isnan(value[kDof - 1]));
    value.setConstant(5.0);
  }
  template <Quantity Q>
  void in(const char*, In<Q>& port) {
    if constexpr (Q == Quantity::kScalar) port.source = &s;
  }
  template <Quantity Q>
  void optional(const char*, In<Q>& port) {
    if constexpr (Q == Quantity::kJointPosition) port.source = &q;
  }
  template <Quantity Q>
  void out(const char*, Out<Q>& port) {
    if constexpr (Q == Quantity::kScalar) s_c = &port.value;
    if constexpr (Q == Quantity::kJointPosition) q_c = &port.value;
  }
};
using Bench = Placed<kLaw>;

// Proves KER-8.

void parameters_inputs_and_outputs_are_those_of_the_ports(void**) {
  Bench bench;
  ASSERT_OK(bench.block->start(1e-3));
  assert_true(*bench.s_c == 6.0 && *bench.q_c == 5.0 * bench.q);
  bench.s = 4.0;
  ASSERT_OK(bench.block->step(2e-3));
  assert_true(*bench.s_c == 8.0 && bench.calls().steps == 1 && bench.calls().dt_s == 2e-3);
}

void two_blocks_of_a_law_have_a_state_each(void**) {
  Bench one, other;
  ASSERT_OK(one.block->start(1e-3));
  ASSERT_OK(other.block->start(1e-3));
  ASSERT_OK(one.block->step(1e-3));
  assert_true(one.calls().steps == 1 && other.calls().steps == 0);
}

/// While the drives are armed, blocks are braked before they start.
void a_brake_before_the_first_start_never_reaches_the_law(void**) {
  Bench bench;
  bench.block->brake(Status::kArming, BrakeWay::kAtOnce);
  assert_int_equal(brakes_unstarted, 0);
  ASSERT_OK(bench.block->start(1e-3));
  bench.block->brake(Status::kHalted, BrakeWay::kOnPath);
  assert_true(bench.calls().brakes == 1 && bench.calls().at_once == 0);
  bench.block->brake(Status::kCollision, BrakeWay::kAtOnce);
  assert_true(bench.calls().brakes == 2 && bench.calls().at_once == 1);
}

void a_law_without_resume_starts_anew(void**) {
  Bench resumes;
  ASSERT_OK(resumes.block->start(1e-3));
  ASSERT_OK(resumes.block->step(1e-3));
  ASSERT_OK(resumes.block->resume());
  assert_true(resumes.calls().resumes == 1 && resumes.calls().steps == 1);
  Placed<kRestarts> restarts;
  ASSERT_OK(restarts.block->start(1e-3));
  ASSERT_OK(restarts.block->step(1e-3));
  ASSERT_OK(restarts.block->resume());
  assert_true(restarts.calls().steps == 0 && restarts.calls().dt_s == 1e-3);
}

// Each quantity, by the numbers of tactus_law.h, has the type that the header describes.
void every_quantity_has_as_many_numbers_as_the_header_says(void**) {
  const std::size_t joints = kDof;
  const std::size_t numbers[] = {joints, joints, joints, joints, 7, 6, 6, 6, 6, 6, 6 * joints, 1};
  const char* const names[] = {"joint position",    "joint velocity", "joint acceleration",
                               "joint effort",      "pose",           "twist",
                               "task acceleration", "wrench",         "wrench rate",
                               "sensor wrench",     "jacobian",       "scalar"};
  for (std::uint32_t i = TACTUS_JOINT_POSITION; i <= TACTUS_SCALAR; ++i) {
    with_law_quantity(i, [&](auto q) {
      assert_string_equal(info(q.value).name, names[i - 1]);
      assert_int_equal(sizeof(ValueOf<q.value>), numbers[i - 1] * sizeof(double));
    });
  }
  Pose pose;
  pose.p = {1.0, 2.0, 3.0};
  pose.r = Eigen::Quaterniond(7.0, 4.0, 5.0, 6.0);
  double seen[7];
  std::memcpy(seen, &pose, sizeof seen);
  for (int i = 0; i < 7; ++i) assert_true(seen[i] == i + 1);
}

// Proves KER-9.

void an_output_that_is_not_finite_is_a_fault_in_every_call(void**) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    Bench bench;
    written = bad;
    ASSERT_STATUS(bench.block->start(1e-3), Status::kCommandNotFinite);
    ASSERT_STATUS(bench.block->step(1e-3), Status::kCommandNotFinite);
    ASSERT_STATUS(bench.block->resume(), Status::kCommandNotFinite);
  }
}

void a_status_that_no_law_may_return_is_a_fault(void**) {
  Bench bench;
  ASSERT_OK(bench.block->start(1e-3));
  for (const std::int32_t known :
       {TACTUS_UNSTABLE_GAIN, TACTUS_STATE_NOT_FINITE, TACTUS_REFERENCE_FAULT,
        TACTUS_COMMAND_NOT_FINITE, TACTUS_FOLLOWING_ERROR}) {
    returned = known;
    assert_int_equal(static_cast<int>(bench.block->step(1e-3)), known);
  }
  for (const std::int32_t unknown : {1, -1, 7, 256, 1000, INT32_MIN, INT32_MAX}) {
    returned = unknown;
    ASSERT_STATUS(bench.block->step(1e-3), Status::kBadValue);
  }
}

/// A description, changed by `change`, is refused with `status` and words.
void refused(void (*change)(tactus_law&), Status status, const char* words) {
  tactus_law law = kLaw;
  change(law);
  Message why;
  ASSERT_STATUS(judge_law(law, kWord, why), status);
  if (std::strstr(why.c_str(), words) == nullptr) print_error("%s\n", why.c_str());
  assert_non_null(std::strstr(why.c_str(), words));
}

void a_description_that_is_wrong_is_refused_with_the_remedy(void**) {
  static constexpr tactus_law_port kTwins[] = {{"q", TACTUS_SCALAR, 0}, {"q", TACTUS_SCALAR, 0}};
  static constexpr tactus_law_port kGain[] = {{"gain", TACTUS_SCALAR, 0}, {"q", TACTUS_SCALAR, 0}};
  static constexpr tactus_law_port kType[] = {{"q", TACTUS_SCALAR, 0}, {"type", TACTUS_SCALAR, 0}};
  static constexpr tactus_law_port kNoName[] = {{"q", TACTUS_SCALAR, 0}, {}};
  static constexpr tactus_law_port kComma[] = {{"q,", TACTUS_SCALAR, 0}, {"p", TACTUS_SCALAR, 0}};
  static constexpr tactus_law_port kWhat[] = {{"q", TACTUS_SCALAR, 0}, {"p", 13, 0}};
  static constexpr tactus_law_port kNone[] = {{"q", 0, 0}, {"p", TACTUS_SCALAR, 0}};
  static constexpr tactus_law_parameter kNoUnit[] = {{"a", nullptr, 0, 1, 0, 0},
                                                     {"b", "1", 0, 1, 0, 0}};
  static constexpr tactus_law_parameter kBar[] = {{"a", "1 | 2", 0, 1, 0, 0},
                                                  {"b", "1", 0, 1, 0, 0}};
  using Law = tactus_law;
  constexpr Status kBad = Status::kBadValue, kTwice = Status::kDuplicate;
  refused([](Law& law) { law.abi = 7; }, kBad, "version 7 of tactus_law.h, the board version 1;");
  refused([](Law& law) { law.input_count = 17; }, Status::kTooLarge, "16 inputs or 8 outputs");
  refused([](Law& law) { law.output_count = UINT32_MAX; }, Status::kTooLarge, "leave some out");
  refused([](Law& law) { law.parameter_count = 17; }, Status::kTooLarge, "16 parameters");
  refused([](Law& law) { law.inputs = nullptr; }, kBad, "of which it has no list; give the list");
  refused([](Law& law) { law.name = "other"; }, kBad, "'other' by its object, and law by LAWS");
  refused([](Law& law) { law.name = nullptr; }, kBad, "give both the same name");
  refused([](Law& law) { law.step = nullptr; }, kBad, "no start or no step; give it both");
  refused([](Law& law) { law.start = nullptr; }, kBad, "no start or no step; give it both");
  refused([](Law& law) { law.bound_us = 0; }, kBad, "no bound of a step; give bound_us");
  refused([](Law& law) { law.state_alignment = 3; }, kBad, "a power of two, at most 16");
  refused([](Law& law) { law.state_alignment = 64; }, kBad, "state_alignment is 64");
  refused([](Law& law) { law.inputs = kTwins; }, kTwice, "key 4 of the law has the name 'q'");
  refused([](Law& law) { law.inputs = kGain; }, kTwice, "'gain', which is taken; rename it");
  refused([](Law& law) { law.inputs = kType; }, kTwice, "'type', which is taken");
  refused([](Law& law) { law.outputs = kTwins; }, kTwice, "output 2 of the law has the name 'q'");
  refused([](Law& law) { law.inputs = kNoName; }, kBad, "key 4 of the law has no name of 1 to 31");
  refused([](Law& law) { law.outputs = kComma; }, kBad, "output 1 of the law has no name");
  refused([](Law& law) { law.inputs = kWhat; }, Status::kWrongQuantity, "'p' of the law has quan");
  refused([](Law& law) { law.outputs = kNone; }, Status::kWrongQuantity, "1 to 12");
  refused([](Law& law) { law.parameters = kNoUnit; }, kBad, "'a' of the law has no unit of 1 to");
  refused([](Law& law) { law.parameters = kBar; }, kBad, "'a' of the law has no unit of 1 to");
}

/// `tactus ports` describes a block that no loader has judged.
void a_law_that_is_refused_describes_nothing(void**) {
  static constexpr tactus_law kOld = [] {
    tactus_law law = kLaw;
    law.abi = 2;
    law.input_count = UINT32_MAX;
    return law;
  }();
  const Placed<kOld> old;
  assert_true(old.s_c == nullptr && old.q_c == nullptr);
}

void a_size_or_a_bound_beyond_all_numbers_stays_one(void**) {
  static constexpr tactus_law kHuge = [] {
    tactus_law law = kLaw;
    law.state_size = SIZE_MAX;
    law.bound_us = UINT32_MAX;
    return law;
  }();
  using Law = CLaw<kHuge, kWord>;
  assert_true(Law::size() > (std::size_t{1} << 30) && Law::bound_us() >= 100000);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(parameters_inputs_and_outputs_are_those_of_the_ports),
      cmocka_unit_test(two_blocks_of_a_law_have_a_state_each),
      cmocka_unit_test(a_brake_before_the_first_start_never_reaches_the_law),
      cmocka_unit_test(a_law_without_resume_starts_anew),
      cmocka_unit_test(every_quantity_has_as_many_numbers_as_the_header_says),
      cmocka_unit_test(an_output_that_is_not_finite_is_a_fault_in_every_call),
      cmocka_unit_test(a_status_that_no_law_may_return_is_a_fault),
      cmocka_unit_test(a_description_that_is_wrong_is_refused_with_the_remedy),
      cmocka_unit_test(a_law_that_is_refused_describes_nothing),
      cmocka_unit_test(a_size_or_a_bound_beyond_all_numbers_stays_one),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
