# A Universal Robots UR10 behind its own ports, on Linux.
ROBOT  := UR10
SRCS   += boards/ur10_socket/board.cpp
PARTS  := $(wildcard hal/ur/*.cpp)

# What `make run` runs, each beside an emulated controller of its own.
RUNS   += ur10_trg_cpc_real ur10_trg_ac_cpc_real
RUNNER := scripts/beside_emulator

# Its tests need a controller: they are those of ur10_emulator.
TESTS  :=
