# A simulated Franka FER in virtual time, on the host.
ROBOT  := FER
SRCS   += boards/fer_sim/board.cpp
LDLIBS += -lmujoco

# What `make run` runs: pipeline, or pipeline:trajectory.
RUNS   += fer_jrg_pdgc fer_jrg_pdgc:fer_five_waypoints fer_trg_cpc fer_trg_ac_cpc_pid

# All tests but those of the UR's wire.
TESTS  := $(filter-out ur_%,$(TESTS))
