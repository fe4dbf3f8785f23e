# A Franka FER as seven CANopen drives on SocketCAN.
ROBOT  := Fer

PARTS  := $(wildcard hal/can/*.cpp hal/net/*.cpp)
TESTS  := $(filter tests/can/%,$(TESTS))
