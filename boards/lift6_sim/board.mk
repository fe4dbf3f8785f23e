# A simulated Lift6 in virtual time, on the host.
ROBOT  := Lift6
SRCS   += boards/lift6_sim/board.cpp
PARTS  := $(SIM)
LDLIBS += -lmujoco

# What `make run` runs: pipeline, or pipeline:trajectory.
RUNS   += lift6_jrg_pdgc

TESTS  := $(ANY_ROBOT) tests/gateway/python/test_python_turns.cpp
