# A simulated Kinova Gen3 of seven joints in virtual time, on the host.
ROBOT  := Gen3
SRCS   += boards/gen3_sim/board.cpp
PARTS  := $(SIM)
LDLIBS += -lmujoco

# What `make run` runs: pipeline, or pipeline:trajectory.
RUNS   += gen3_jrg_pdgc

TESTS  := $(ANY_ROBOT) tests/gateway/python/test_python_turns.cpp
