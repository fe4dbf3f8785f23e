// Laws that break a rule of tactus_law.h each. All send gravity as torque, or the desired position,
// so that the arm holds; what they do wrong begins in the 20th cycle.
#include <math.h>
#include <tactus_law.h>

static int32_t start(void* state, const tactus_law_data* data, double dt_s) {
  *(uint32_t*)state = 0;
  (void)dt_s;
  for (uint32_t port = 0; port < 2; ++port)
    for (uint32_t i = 0; i < data->joints; ++i) data->outputs[port][i] = data->inputs[port][i];
  return TACTUS_OK;
}

static int32_t step(void* state, const tactus_law_data* data, double dt_s) {
  const uint32_t cycles = *(uint32_t*)state + 1;
  const int32_t status = start(state, data, dt_s);
  *(uint32_t*)state = cycles;
  return status;
}

static int32_t nan_step(void* state, const tactus_law_data* data, double dt_s) {
  const int32_t status = step(state, data, dt_s);
  if (*(uint32_t*)state >= 20) data->outputs[0][0] = data->outputs[1][0] = NAN;
  return status;
}

static int32_t status_step(void* state, const tactus_law_data* data, double dt_s) {
  const int32_t status = step(state, data, dt_s);
  return *(uint32_t*)state >= 20 ? 1000 : status;
}

static int32_t jump_step(void* state, const tactus_law_data* data, double dt_s) {
  const int32_t status = step(state, data, dt_s);
  if (*(uint32_t*)state == 20) data->outputs[0][6] += 1e6;
  return status;
}

static const tactus_law_parameter kGain = {"gain", "1/s", 0.0, 10.0, 1.0, 0};
static const tactus_law_port kInputs[] = {{"g", TACTUS_JOINT_EFFORT, 0},
                                          {"q_d", TACTUS_JOINT_POSITION, 0}};
static const tactus_law_port kOutputs[] = {{"tau", TACTUS_JOINT_EFFORT, 0},
                                           {"q_c", TACTUS_JOINT_POSITION, 0}};
static const tactus_law_port kTwins[] = {{"tau", TACTUS_JOINT_EFFORT, 0},
                                         {"tau", TACTUS_JOINT_EFFORT, 0}};
static const tactus_law_port kUnknown[] = {{"tau", TACTUS_JOINT_EFFORT, 0}, {"q_c", 99, 0}};

#define LAW(law, version, bound, bytes, ports, its_step) \
  const tactus_law law = {.abi = version,                \
                          .bound_us = bound,             \
                          .name = #law,                  \
                          .state_size = bytes,           \
                          .state_alignment = 4,          \
                          .parameters = &kGain,          \
                          .inputs = kInputs,             \
                          .outputs = ports,              \
                          .parameter_count = 1,          \
                          .input_count = 2,              \
                          .output_count = 2,             \
                          .start = start,                \
                          .step = its_step};

LAW(good_law, TACTUS_LAW_ABI, 300, 4, kOutputs, step)
LAW(nan_law, TACTUS_LAW_ABI, 300, 4, kOutputs, nan_step)
LAW(status_law, TACTUS_LAW_ABI, 300, 4, kOutputs, status_step)
LAW(jump_law, TACTUS_LAW_ABI, 300, 4, kOutputs, jump_step)
LAW(other_version, 7, 300, 4, kOutputs, step)
LAW(twin_outputs, TACTUS_LAW_ABI, 300, 4, kTwins, step)
LAW(unknown_quantity, TACTUS_LAW_ABI, 300, 4, kUnknown, step)
LAW(large_state, TACTUS_LAW_ABI, 300, SIZE_MAX, kOutputs, step)
LAW(slow_law, TACTUS_LAW_ABI, 501, 4, kOutputs, step)
