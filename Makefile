# Tactus. `make help` lists the targets; BOARD=... chooses the board, V=1 shows the commands.
BOARD ?= fer_sim
Q     := $(if $(V),,@)
comma := ,
ARCH  ?= host
HOW   := $(if $(filter-out host,$(ARCH)),-$(ARCH))$(if $(SANITIZE),-$(subst $(comma),-,$(SANITIZE)))
B     := build/$(BOARD)$(HOW)

# What a board.mk says: robot, sources, libraries, runs and who runs them, and its tests if they are not all.
BOARDS := $(patsubst boards/%/board.mk,%,$(wildcard boards/*/board.mk))
SRCS   :=
LDLIBS :=
RUNS   :=
RUNNER  = $(B)/tactus
PARTS  :=
TESTS  := $(patsubst tests/test_%.cpp,%,$(wildcard tests/test_*.cpp))
include boards/$(BOARD)/board.mk
# Programs are a board's; objects are a robot's, whatever board links them.
robot := $(shell echo $(ROBOT) | tr A-Z a-z)
O     := build/$(robot)$(HOW)

# Everything of ours is compiled alike; the seams to libraries that need exceptions include no Eigen header of ours.
SEAMS     := boards/program/options.cpp boards/ur10_emulator/options.cpp $(wildcard tests/oracles/kdl*.cpp) tests/bench/kdl_peer.cpp
WARNINGS  := -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Werror
OPTIMISED ?= $(if $(SANITIZE),-O1,-O3)
NUMERICS  := $(OPTIMISED) -ffp-contract=off -fno-math-errno -DEIGEN_DONT_VECTORIZE
SANITIZER := $(if $(SANITIZE),-fsanitize=$(SANITIZE) -fno-sanitize-recover=all)
# Line tables are what back traces, profiles and bounds need; tracking variables too (DEBUG=-g) takes twice as long to
# compile, sanitized three times.
DEBUG     ?= -g1
SEAMFLAGS := -std=c++17 $(DEBUG) $(NUMERICS) $(WARNINGS) $(SANITIZER) -MMD -MP -I. -isystem /usr/include/eigen3 \
             -DTACTUS_ROBOT_$(ROBOT)
CXXFLAGS  := $(SEAMFLAGS) -fno-exceptions -fno-rtti -DEIGEN_NO_MALLOC $(if $(SANITIZE),,-DNDEBUG)

# The machines the kernel is built for: host, arm64, m7 (bare metal, linked with no C library).
CROSS_arm64 := aarch64-linux-gnu-
CROSS_m7    := arm-none-eabi-
FLAGS_m7    := -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16 -fno-threadsafe-statics \
               -fno-unwind-tables -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections
CXX      := $(CROSS_$(ARCH))g++
AR       := $(CROSS_$(ARCH))ar
NM       := $(CROSS_$(ARCH))nm
CXXFLAGS += $(FLAGS_$(ARCH)) $(if $(SANITIZE),,-fstack-usage -fcallgraph-info=su)

# Where Debian has no binary of libccd, its source.
CCD      := $(if $(filter-out host,$(ARCH)),build/libccd)
CCD_SRCS := $(if $(CCD),$(patsubst %,$(CCD)/src/%.c,ccd mpr polytope support vec3))
CXXFLAGS += $(CCD:%=-isystem %/src)

KERNEL   := $(wildcard kernel/*.cpp kernel/*/*.cpp)
PROGRAM  := $(wildcard boards/program/*.cpp gateway/*.cpp sim_plant/*.cpp hal/os/*.cpp) $(PARTS)
ORACLES  := $(wildcard tests/oracles/*.cpp)
TESTS    := $(TESTS:%=$(B)/tests/test_%)
LONG     := $(addprefix $(B)/tests/,test_motion test_admission_oracle test_every_motion)
TESTLIBS := -Wl,--as-needed -lccd -lcmocka -lmujoco -lorocos-kdl -lquadmath -Lbuild -lfcl_oracle -Wl,-rpath,'$$ORIGIN/../..'
obj       = $(patsubst %.cpp,$(O)/%.o,$(1))
say       = @mkdir -p $(@D) && echo "  $(1)"
each      = set -e; for board in $(BOARDS); do $(MAKE) --no-print-directory BOARD=$$board $(1); done

.PHONY: docs all run test test-long check bench setup format clean help
all: $(B)/tactus                              ## build the program of BOARD

run: setup                                    ## run every pipeline of every board; out/report.html
	$(Q)$(call each,-j2 all trajectories)
	$(Q)scripts/run_all $$($(call each,list-runs))
test: setup                                   ## build and run all tests of every board
	$(Q)$(call each,-j2 all trajectories run-tests)
test-long: setup                              ## the long random tests at full count
	$(Q)$(MAKE) --no-print-directory -j2 $(LONG)
	$(Q)TACTUS_TRIALS=100000 scripts/run_tests $(LONG)
check: test                                   ## what must hold before a change lands, tests included
	$(Q)scripts/check
docs: $(B)/tactus                             ## write the documents that are generated
	$(Q)$(B)/tactus ports > docs/ports.md
bench: $(B)/bench                             ## time per call beside Orocos KDL, in one run
	$(Q)$(B)/bench
setup:                                        ## install the Debian packages that are missing
	$(Q)scripts/setup
format:                                       ## clang-format every source
	$(Q)clang-format -i $$(git ls-files '*.hpp' '*.cpp')
compile_commands.json:                        ## for editors and clang-tidy
	$(Q)bear -- $(MAKE) -B all $(TESTS)
clean:                                        ## remove everything that was built
	$(Q)rm -rf build out compile_commands.json
help:                                         ## this list
	$(Q)grep -hE '^[a-z_.-]+:.*##' $(MAKEFILE_LIST:%.d=) | sed -E 's/:.*## */\t/' | expand -t 24

.PHONY: trajectories list-runs run-tests run-thread-tests kernel each-board
each-board:
	$(Q)$(call each,$(TARGETS))
list-runs:
	@echo -- $(RUNNER) $(RUNS)
kernel: $(O)/libkernel.a $(if $(filter m7,$(ARCH)),$(B)/link.elf)
	$(Q)scripts/no_heap $< $(NM)
$(B)/link.elf: $(call obj,tests/bare_metal/link.cpp tests/bare_metal/memory.cpp) $(O)/libkernel.a $(O)/libccd.a
	$(call say,LD    $@)
	$(Q)$(CXX) $(FLAGS_m7) -nostartfiles -nostdlib -Wl,--gc-sections -Wl,--entry=main -o $@ $^ -lm -lgcc
	$(Q)$(CROSS_m7)size $@
trajectories: build/trajectories/fer_excitation.csv
build/trajectories/fer_excitation.csv: scripts/excitation
	@mkdir -p $(@D)
	$(Q)scripts/excitation --out $@
run-thread-tests: $(addprefix $(B)/tests/,test_mailbox test_recorder test_reference_threads test_histogram test_ladder)
	$(Q)scripts/run_tests $^
run-tests: $(B)/tactus $(TESTS)
	$(Q)scripts/run_tests $(TESTS)

$(call obj,$(SEAMS)): CXXFLAGS := $(SEAMFLAGS)
$(O)/libkernel.a: $(call obj,$(KERNEL))
$(B)/libprogram.a: $(call obj,$(PROGRAM))
$(O)/libccd.a: $(CCD_SRCS:%.c=$(O)/%.o)
$(O)/liboracles.a: $(call obj,$(ORACLES))
build/%.a:
	$(call say,AR    $@)
	$(Q)rm -f $@ && $(AR) rcs $@ $^
$(B)/tactus: $(call obj,$(SRCS)) $(B)/libprogram.a $(O)/libkernel.a
	$(call say,LD    $@)
	$(Q)$(CXX) $(SANITIZER) -o $@ $^ $(LDLIBS) -lccd
# Debian's FCL is compiled with vectorised Eigen: who calls it too, and hidden from all that is not.
build/libfcl_oracle.so: tests/oracles/fcl/fcl.cpp tests/oracles/fcl/fcl.hpp
	$(call say,LD    $@)
	$(Q)$(CXX) -std=c++17 -O1 -fPIC -shared -fvisibility=hidden $(WARNINGS) -I. -isystem /usr/include/eigen3 -o $@ $< -lfcl
$(TESTS): | build/libfcl_oracle.so
$(TESTS): $(B)/%: $(O)/%.o $(O)/liboracles.a $(B)/libprogram.a $(O)/libkernel.a
	$(call say,LD    $@)
	$(Q)$(CXX) $(SANITIZER) -o $@ $^ $(TESTLIBS)
$(B)/bench: $(call obj,$(wildcard tests/bench/*.cpp)) $(O)/libkernel.a
	$(call say,LD    $@)
	$(Q)$(CXX) -o $@ $^ -lbenchmark -lorocos-kdl -lccd -lpthread
$(O)/%.o: %.cpp Makefile
	$(call say,CXX   $<)
	$(Q)$(CXX) $(CXXFLAGS) -c $< -o $@

$(CCD_SRCS:%.c=$(O)/%.o): $(O)/%.o: %.c
	$(call say,CC    $<)
	$(Q)$(CXX:g++=gcc) $(FLAGS_$(ARCH):-fno-threadsafe-statics=) $(NUMERICS) $(DEBUG) -w -DNDEBUG -I$(CCD)/src -c $< -o $@
$(CCD_SRCS) &:
	$(Q)scripts/libccd $(CCD)
$(call obj,$(KERNEL) tests/bare_metal/link.cpp): | $(CCD_SRCS)

include tests/fuzz/fuzz.mk
include tests/wcet/wcet.mk
include scripts/wcet/bound.mk

.PRECIOUS: $(O)/%.o
.DELETE_ON_ERROR:
-include $(shell find $(O) -name '*.d' 2>/dev/null)
