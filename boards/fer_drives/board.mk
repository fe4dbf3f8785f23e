# Emulated CiA 402 drives of a Franka FER on CAN buses, with a simulated arm, on the host.
ROBOT  := Fer
NAME   := fer_drives
SRCS   += sim_plant/drives/server/main.cpp
LDLIBS += -lmujoco

# Sources that the tests link in addition.
PARTS  := $(filter-out $(SRCS),$(ARM) $(wildcard sim_plant/drives/*.cpp sim_plant/drives/server/*.cpp \
            hal/cia402/*.cpp hal/can/*.cpp))

TESTS  := $(filter tests/sim_plant/drives/%,$(TESTS))
