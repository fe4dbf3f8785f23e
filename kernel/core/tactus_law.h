// tactus_law: a control law behind a C interface. The law is compiled elsewhere, with this header
// and nothing else of Tactus, by any compiler that makes C objects, and is linked into a board:
//
//   make BOARD=fer_sim LAWS="NAME=law.o"
//
// The object defines the constant NAME: `const tactus_law NAME = {...};`, in C++ behind extern "C".
// Pipeline files have the law as a block with `type = NAME`.
//
// Rules. The board checks those marked with *, and refuses the law or stops the arm.
//   - * Description. It is constant. Names are words of letters, digits and _, at most 31
//     characters; an output differs from every other output, an input or parameter from every
//     other input and parameter, and from "type".
//   - Memory. What a law remembers is in `state` alone: the pipeline may have two blocks of it. It
//     takes no heap, and its stack is small.
//   - Calls. One thread calls, in the order start, step, step, ...; brake and resume as described
//     there. No call blocks, locks, reads a clock, asks the operating system, throws, or loops
//     without a bound.
//   - * A step takes no more than `bound_us`. The sum of these over the blocks of a file fits the
//     budget of the control chain; a cycle that takes longer than its period is an overrun.
//   - Time is `dt_s`, the nominal period, the same in all calls.
//   - Inputs are finite. * Outputs are finite after start, step and resume, if these return
//     TACTUS_OK; all outputs are written.
//   - * A status is one of those below.
//   - After start the outputs command what the robot holds, so that it does not move; they do not
//     step from one period to the next. The guard behind the law limits a command that does: to
//     the limits of torque, torque rate, velocity and position.
#ifndef TACTUS_LAW_H
#define TACTUS_LAW_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  TACTUS_LAW_ABI = 1,
  TACTUS_LAW_INPUTS = 16,  // the most that a law has
  TACTUS_LAW_OUTPUTS = 8,
  TACTUS_LAW_PARAMETERS = 16
};

// The quantity of a port: an array of doubles in SI units. Pose, twist, acceleration and wrench are
// those of the tool tip in the base frame; a wrench is exerted on the tool.
enum {
  TACTUS_JOINT_POSITION = 1,      // one number per joint, rad; m and N of a prismatic joint
  TACTUS_JOINT_VELOCITY = 2,      // rad/s
  TACTUS_JOINT_ACCELERATION = 3,  // rad/s^2
  TACTUS_JOINT_EFFORT = 4,        // N m
  TACTUS_POSE = 5,                // x y z, m; unit quaternion x y z w
  TACTUS_TWIST = 6,               // velocity, m/s; angular velocity, rad/s
  TACTUS_TASK_ACCELERATION = 7,   // m/s^2; rad/s^2
  TACTUS_WRENCH = 8,              // force, N; moment, N m
  TACTUS_WRENCH_RATE = 9,         // N/s; N m/s
  TACTUS_SENSOR_WRENCH = 10,      // as a force/torque sensor at the flange gives it, in its axes
  TACTUS_JACOBIAN = 11,           // 6 numbers for each joint, as of a twist, joint after joint
  TACTUS_SCALAR = 12              // one number
};

// What start, step and resume return. All but TACTUS_OK end the motion.
enum {
  TACTUS_OK = 0,
  TACTUS_UNSTABLE_GAIN = 12,       // start: parameters that make the law unstable
  TACTUS_STATE_NOT_FINITE = 64,    // what was measured
  TACTUS_REFERENCE_FAULT = 65,     // what is desired is not valid
  TACTUS_COMMAND_NOT_FINITE = 66,  // what the law computes
  TACTUS_FOLLOWING_ERROR = 76      // the arm does not follow
};

typedef struct tactus_law_port {
  const char* name;
  uint32_t quantity;
  uint32_t optional;  // 1: an input that may stay unwired; it then reads zero, a pose the identity
} tactus_law_port;

typedef struct tactus_law_parameter {
  const char *name, *unit;  // unit "1": none; printable ASCII without |
  double lower, upper;      // the values allowed, both ends included; infinite: no bound
  double initial;           // NaN: the pipeline file must give the value
  uint32_t per_joint;       // 1: one number per joint; 0: one number
} tactus_law_parameter;

// Parameters, inputs and outputs in the order of the law's lists; inputs[2][0] is the first number
// of the third input.
typedef struct tactus_law_data {
  uint32_t joints;  // of the board's robot
  const double* const* parameters;
  const double* const* inputs;
  double* const* outputs;
} tactus_law_data;

typedef struct tactus_law {
  uint32_t abi;            // TACTUS_LAW_ABI
  uint32_t bound_us;       // longest time that a step takes on the board's processor
  const char* name;        // NAME
  size_t state_size;       // bytes of the state, which the board has; not set before start
  size_t state_alignment;  // a power of two, at most that of max_align_t; 0: there is no state
  const tactus_law_parameter* parameters;
  const tactus_law_port *inputs, *outputs;
  uint32_t parameter_count, input_count, output_count;
  // Sets state and outputs for an arm that is at rest, before every motion.
  int32_t (*start)(void* state, const tactus_law_data* data, double dt_s);
  // Sets the outputs, in every cycle.
  int32_t (*step)(void* state, const tactus_law_data* data, double dt_s);
  // Begins to end the motion that the law makes by itself, within limits, until the next start or
  // resume: along its path, or at once. Called before every step while the arm brakes or is held,
  // and without steps while the drives are not enabled. Null: the law only follows its inputs.
  void (*brake)(void* state, uint32_t at_once);
  // Called in place of start for an arm that was braked and rests: the outputs continue from where
  // they are. Null: start does that.
  int32_t (*resume)(void* state, const tactus_law_data* data, double dt_s);
} tactus_law;

#ifdef __cplusplus
}
#endif
#endif
