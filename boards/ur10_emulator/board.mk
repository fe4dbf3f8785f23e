# An emulated Universal Robots UR10 controller (CB3) behind its TCP ports, on the host.
ROBOT  := UR10
SRCS   += boards/ur10_emulator/main.cpp
LDLIBS += -lmujoco

# What the tests link as well.
PARTS  := $(wildcard sim_plant/ur/*.cpp) boards/ur10_emulator/options.cpp boards/ur10_emulator/server.cpp

TESTS  := $(filter ur_%,$(TESTS))
