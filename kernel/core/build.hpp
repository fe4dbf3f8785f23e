// The robot and the switches that this is compiled for, in the name of its namespace:
// tactus::Executive is tactus_Fer_128_1_1::Executive to the linker. What is compiled for another
// robot or with other switches has another layout; a program that mixes them does not link, and one
// program may hold several robots, each in sources of its own. The build includes this file before
// all others (-include).
#ifndef TACTUS_BUILD
#define TACTUS_BUILD

#ifndef TACTUS_ROBOT
#error "name the robot: -DTACTUS_ROBOT=Fer, which a board.mk says by ROBOT := Fer"
#endif

// Most targets of a chunk. 0: no streams of chunks and velocities and no digital outputs, neither
// their code nor their memory.
#ifndef TACTUS_CHUNK_TARGETS
#define TACTUS_CHUNK_TARGETS 128
#endif
// 1: parameters may change, and a sensor be tared, while a pipeline runs, as clients of a server
// ask.
#ifndef TACTUS_TUNING
#define TACTUS_TUNING 1
#endif
// 1: convex bodies beside boxes and capsules. 0: a board on which memory is short.
#ifndef TACTUS_CONVEX
#define TACTUS_CONVEX 1
#endif

#define TACTUS_JOINED(robot, targets, tuning, convex) \
  tactus_##robot##_##targets##_##tuning##_##convex
#define TACTUS_NAMED(robot, targets, tuning, convex) TACTUS_JOINED(robot, targets, tuning, convex)
#define tactus TACTUS_NAMED(TACTUS_ROBOT, TACTUS_CHUNK_TARGETS, TACTUS_TUNING, TACTUS_CONVEX)

#endif
