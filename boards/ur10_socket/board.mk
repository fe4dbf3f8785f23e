# A Universal Robots UR10 behind its own TCP ports, on Linux.
ROBOT  := Ur10
SRCS   += boards/ur10_socket/board.cpp
PARTS  := $(wildcard hal/net/*.cpp hal/ur/*.cpp)

# The pipelines that `make run` runs, each with an emulated controller of its own.
RUNS   += ur10_trg_cpc_real ur10_trg_ac_cpc_real
RUNNER := scripts/beside_emulator

# All other tests need a controller: they are those of ur10_emulator.
SCRIPTED := tests/ur/served
TESTS  := $(addprefix tests/program/,pages/test_mistakes.cpp test_sections.cpp test_virtual_time.cpp)
