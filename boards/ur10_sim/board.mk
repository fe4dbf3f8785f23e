# A simulated Universal Robots UR10 (CB3) in virtual time, on the host.
ROBOT  := Ur10
SRCS   += boards/ur10_sim/board.cpp
PARTS  := $(SIM)
LDLIBS += -lmujoco

# The runs of `make run`: pipeline, or pipeline:trajectory.
RUNS   += ur10_jrg_pdgc ur10_jrg_pid ur10_jrg_pid:ur10_five_waypoints_quintic
RUNS   += ur10_trg_cpc ur10_trg_cpc:ur10_square_at_rest ur10_trg_cpc_125 ur10_trg_ac_cpc ur10_trg_ac_cpc_pid

# The clients are for all robots; they are tested against this board.
TESTS  := $(ANY_ROBOT) tests/bench/policies/test_policies.cpp $(wildcard tests/gateway/ctl/test_*.cpp) tests/gateway/python/test_python_client.cpp

# The kinds of block on a Cortex-M7, where memory is short: those of the longest pipeline.
KINDS_m7 := RobotModel, Frame, BoxObstacle, TaskReferenceGenerator, WrenchFrontEnd, Admittance, CartesianPose, Pid

# Limits in bytes that `make certificate` checks: static memory, flash and stack on a Cortex-M7, with one exception, and
# stack on the host.
STATIC_BUDGET     := 98816
FLASH_BUDGET      := 200704
STACK_BUDGET      := 12288
HOST_STACK_BUDGET := 32768

# The core on which `make wcet` judges the bound of a cycle with its rows, with code and data in tightly coupled memory:
# its clock, and the longest time that such a cycle may take.
CORE_MHZ      := 600
CORE_LIMIT_US := 2700
