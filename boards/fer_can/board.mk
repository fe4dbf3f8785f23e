# A Franka FER as seven CiA 402 drives on CAN, on Linux.
ROBOT  := Fer
SRCS   += boards/fer_can/board.cpp
PARTS  := $(wildcard hal/cia402/*.cpp hal/can/*.cpp program/scan/*.cpp)

# The pipelines that `make run` runs, with emulated drives on buses of a virtual machine.
RUNS   += fer_jrg_pdgc_real
PACKAGES := vm
RUNNER := scripts/beside_drives

TESTS  := $(filter tests/hal/can/% tests/hal/cia402/% tests/vm/% tests/program/test_sections.cpp,$(TESTS))
