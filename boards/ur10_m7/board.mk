# A Cortex-M7 without an operating system for a UR10 whose joints it commands; as fer_m7.
ROBOT  := Ur10
SRCS   += boards/ur10_m7/board.cpp
PARTS  := $(SIM) $(PIL)
LDLIBS += -lmujoco

# All simulated pipelines of the robot.
RUNS   += ur10_jrg_pdgc ur10_jrg_pid ur10_jrg_pid:ur10_five_waypoints_quintic
RUNS   += ur10_trg_cpc ur10_trg_cpc:ur10_square_at_rest ur10_trg_cpc_125 ur10_trg_ac_cpc ur10_trg_ac_cpc_pid
PACKAGES := m7

TESTS  := tests/hal/serial/test_board_references.cpp

# The pipeline that the image has when it is switched on.
PIPELINE ?= ur10_jrg_pdgc

# Limits in bytes that `make certificate` checks of the image: static memory without stacks, and flash.
RAM_BUDGET   := 458752
IMAGE_BUDGET := 294912
