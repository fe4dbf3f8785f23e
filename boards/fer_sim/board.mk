# A simulated Franka FER in virtual time, on the host.
ROBOT  := FER
SRCS   += boards/fer_sim/board.cpp
LDLIBS += -lmujoco

# What `make run` runs: pipeline, or pipeline:trajectory.
RUNS   += fer_jrg_pdgc fer_jrg_pdgc:fer_five_waypoints fer_trg_cpc fer_trg_ac_cpc_pid

# Memory in bytes that `make certificate` holds the kernel to: static and stack on a Cortex-M7, an exception included,
# and stack on the host.
STATIC_BUDGET     := 262144
STACK_BUDGET      := 24576
HOST_STACK_BUDGET := 32768

# All tests but those of the UR's wire.
TESTS  := $(filter-out ur_%,$(TESTS))
