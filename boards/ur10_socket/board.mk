# A Universal Robots UR10 behind its own ports, on Linux.
ROBOT  := UR10
SRCS   += boards/ur10_socket/board.cpp
PARTS  := $(wildcard hal/ur/*.cpp)

# Its tests need a controller: they are those of ur10_emulator.
TESTS  :=
