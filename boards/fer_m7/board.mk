# A Cortex-M7 without an operating system for a Franka FER: its image by ARCH=m7; for the host the program that has the
# plant and runs the image in an emulator.
ROBOT  := Fer
SRCS   += boards/fer_m7/board.cpp
PARTS  := $(SIM) $(PIL)
LDLIBS += -lmujoco

# All simulated pipelines of the robot.
RUNS   += fer_jrg_pdgc fer_jrg_pdgc:fer_five_waypoints fer_trg_cpc fer_trg_ac_cpc_pid
PACKAGES := m7

TESTS  := $(filter tests/hal/serial/%,$(TESTS)) $(if $(SANITIZE),,tests/trace/test_same_bits.cpp)
# Beside those of one board: runs of all boards with a Cortex-M7 against this computer's.
SCRIPTED := tests/hal/serial/pipelines

# The pipeline that the image has when it is switched on.
PIPELINE ?= fer_jrg_pdgc

# Limits in bytes that `make certificate` checks of the image: static memory without stacks, and flash.
RAM_BUDGET   := 458752
IMAGE_BUDGET := 294912
