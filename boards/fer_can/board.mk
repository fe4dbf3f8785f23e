# A Franka FER as seven CiA 402 drives on CAN, on Linux.
ROBOT  := Fer
SRCS   += boards/fer_can/board.cpp
PARTS  := $(wildcard hal/cia402/*.cpp hal/can/*.cpp)

TESTS  := $(filter tests/can/% tests/cia402/% tests/vm/%,$(TESTS))
