# A Cortex-M55 without an operating system for a Franka FER; as fer_m7.
ROBOT  := Fer
SRCS   += boards/fer_m55/board.cpp
PARTS  := $(SIM) $(PIL)
LDLIBS += -lmujoco

# All simulated pipelines of the robot.
RUNS   += fer_jrg_pdgc fer_jrg_pdgc:fer_five_waypoints fer_trg_cpc fer_trg_ac_cpc_pid
PACKAGES := m7

TESTS  := tests/hal/serial/test_board_faults.cpp

# The pipeline that the image has when it is switched on.
PIPELINE ?= fer_jrg_pdgc

# Limits in bytes that `make certificate` checks of the image: static memory without stacks, and flash.
RAM_BUDGET   := 458752
IMAGE_BUDGET := 294912
