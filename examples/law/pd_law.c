// PD with gravity compensation as a law behind Tactus's C interface:
//
//   tau = Kp (q_d - q) - Kd dq + g
//
// It follows its inputs only, so that it has no state, and nothing to do when it brakes.
#include <math.h>
#include <tactus_law.h>

enum { KP, KD };
enum { Q_D, Q, DQ, G };

static int32_t step(void* state, const tactus_law_data* data, double dt_s) {
  const double *kp = data->parameters[KP], *kd = data->parameters[KD];
  const double *q_d = data->inputs[Q_D], *q = data->inputs[Q];
  const double *dq = data->inputs[DQ], *g = data->inputs[G];
  double* tau = data->outputs[0];
  (void)state;
  (void)dt_s;
  for (uint32_t i = 0; i < data->joints; ++i)
    tau[i] = kp[i] * (q_d[i] - q[i]) - kd[i] * dq[i] + g[i];
  return TACTUS_OK;
}

static const tactus_law_parameter kParameters[] = {
    {"kp", "N m/rad", 0.0, INFINITY, NAN, 1},
    {"kd", "N m s/rad", 0.0, INFINITY, NAN, 1},
};
static const tactus_law_port kInputs[] = {
    {"q_d", TACTUS_JOINT_POSITION, 0},
    {"q", TACTUS_JOINT_POSITION, 0},
    {"dq", TACTUS_JOINT_VELOCITY, 0},
    {"g", TACTUS_JOINT_EFFORT, 1},
};
static const tactus_law_port kOutputs[] = {{"tau", TACTUS_JOINT_EFFORT, 0}};

const tactus_law pd_law = {
    .abi = TACTUS_LAW_ABI,
    .bound_us = 5,
    .name = "pd_law",
    .parameters = kParameters,
    .parameter_count = 2,
    .inputs = kInputs,
    .input_count = 4,
    .outputs = kOutputs,
    .output_count = 1,
    .start = step,  // at rest on the reference the torque is gravity
    .step = step,
};
