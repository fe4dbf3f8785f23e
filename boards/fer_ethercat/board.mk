# A Franka FER as seven CiA 402 drives on an EtherCAT segment, on Linux.
ROBOT  := Fer
SRCS   += boards/fer_ethercat/board.cpp
PARTS  := $(wildcard hal/cia402/*.cpp hal/ethercat/*.cpp program/scan_segment/*.cpp)

# The pipelines that `make run` runs, with an emulated segment at the other end of a virtual cable.
RUNS   += fer_jrg_pdgc_ethercat
PACKAGES := ethercat
RUNNER := scripts/beside_segment

# All other tests are those of fer_segment.
TESTS    := $(filter tests/program/test_sections.cpp,$(TESTS))
SCRIPTED := tests/hal/ethercat/over_veth
