# Emulated CiA 402 drives of a Franka FER on an EtherCAT segment, with a simulated arm, on the host.
ROBOT  := Fer
NAME   := fer_segment
SRCS   += sim_plant/ethercat/server/main.cpp
LDLIBS += -lmujoco

# Sources that the tests link in addition.
PARTS  := $(filter-out $(SRCS),$(ARM) $(wildcard sim_plant/drives/*.cpp sim_plant/ethercat/*.cpp sim_plant/ethercat/server/*.cpp sim_plant/drives/server/fault_text.cpp \
            hal/cia402/*.cpp hal/ethercat/*.cpp))

TESTS  := $(filter tests/hal/ethercat/%,$(TESTS))
