# An emulated Universal Robots UR10 controller (CB3) behind its TCP ports, on the host.
ROBOT  := Ur10
NAME   := ur10_emulator
SRCS   += sim_plant/ur/server/main.cpp
LDLIBS += -lmujoco

# Sources that the tests link in addition.
PARTS  := $(filter-out $(SRCS),$(ARM) $(wildcard sim_plant/ur/*/*.cpp hal/net/*.cpp hal/ur/*.cpp))

TESTS  := $(filter tests/ur/%,$(TESTS))
