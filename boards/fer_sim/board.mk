# A simulated Franka FER in virtual time, on the host.
ROBOT  := Fer
SRCS   += boards/fer_sim/board.cpp
PARTS  := $(SIM)
LDLIBS += -lmujoco

# The runs of `make run`: pipeline, or pipeline:trajectory.
RUNS   += fer_jrg_pdgc fer_jrg_pdgc:fer_five_waypoints fer_trg_cpc fer_trg_cpc_vase fer_trg_ac_cpc_pid

# The kinds of block on a Cortex-M7, where memory is short: those of the longest pipeline.
KINDS_m7 := RobotModel, Frame, BoxObstacle, TaskReferenceGenerator, WrenchFrontEnd, Admittance, CartesianPose, Pid

# Limits in bytes that `make certificate` checks: static memory, flash and stack on a Cortex-M7, with one exception, and
# stack on the host.
STATIC_BUDGET     := 98816
FLASH_BUDGET      := 206848
STACK_BUDGET      := 12288
HOST_STACK_BUDGET := 32768

# All tests except those of wires and of the Cortex-M7, and those of the Python client that ur10_sim and lift6_sim run.
OTHERS := $(addprefix tests/,ur/% hal/can/% hal/ethercat/% hal/cia402/% hal/serial/% sim_plant/drives/% vm/% \
            trace/test_same_bits.cpp gateway/python/test_python_client.cpp gateway/python/test_python_turns.cpp)
TESTS  := $(filter-out $(OTHERS),$(TESTS))

# The core on which `make wcet` judges the bound of a cycle with its rows, with code and data in tightly coupled memory:
# its clock, and the longest time that such a cycle may take.
CORE_MHZ      := 600
CORE_LIMIT_US := 2700
