# Tactus. `make help` lists the targets; BOARD=... chooses the board, V=1 shows the commands.
BOARD ?= fer_sim
Q     := $(if $(V),,@)
comma := ,
B     := build/$(BOARD)$(if $(SANITIZE),-$(subst $(comma),-,$(SANITIZE)))

SRCS   :=
LDLIBS :=
RUNS   :=
include boards/$(BOARD)/board.mk

# Everything of ours is compiled alike; the seams to libraries that need exceptions include no Eigen header of ours.
SEAMS     := boards/program/options.cpp tests/oracles/kdl.cpp tests/bench/kdl_peer.cpp
WARNINGS  := -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Werror
NUMERICS  := -O3 -ffp-contract=off -fno-math-errno -DEIGEN_DONT_VECTORIZE
SANITIZER := $(if $(SANITIZE),-fsanitize=$(SANITIZE) -fno-sanitize-recover=all)
SEAMFLAGS := -std=c++17 -g $(NUMERICS) $(WARNINGS) $(SANITIZER) -MMD -MP -I. -isystem /usr/include/eigen3 \
             -DTACTUS_ROBOT_$(ROBOT)
CXXFLAGS  := $(SEAMFLAGS) -fno-exceptions -fno-rtti -DEIGEN_NO_MALLOC $(if $(SANITIZE),,-DNDEBUG)

KERNEL   := $(wildcard kernel/*.cpp kernel/*/*.cpp)
PROGRAM  := $(wildcard boards/program/*.cpp gateway/*.cpp sim_plant/*.cpp)
ORACLES  := $(wildcard tests/oracles/*.cpp)
TESTS    := $(patsubst %.cpp,$(B)/%,$(wildcard tests/test_*.cpp))
TESTLIBS := -Wl,--as-needed -lcmocka -lmujoco -lorocos-kdl -lquadmath
obj       = $(patsubst %.cpp,$(B)/%.o,$(1))

.PHONY: all run test check bench setup format clean help
all: $(B)/tactus                              ## build the program of BOARD

run: setup                                    ## run every pipeline; results in out/
	$(Q)$(MAKE) --no-print-directory all trajectories
	$(Q)scripts/run_all $(B)/tactus $(RUNS)
test: setup                                   ## build and run all tests
	$(Q)$(MAKE) --no-print-directory -j2 all trajectories run-tests
check: setup                                  ## what must hold before a change lands, tests included
	$(Q)scripts/check
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
	$(Q)grep -hE '^[a-z_.]+:.*##' Makefile | sed -E 's/:.*## */\t/' | expand -t 24

.PHONY: trajectories run-tests
trajectories: build/trajectories/fer_excitation.csv
build/trajectories/fer_excitation.csv: scripts/excitation
	@mkdir -p $(@D)
	$(Q)scripts/excitation --out $@
run-tests: $(TESTS)
	$(Q)scripts/run_tests $^

$(call obj,$(SEAMS)): CXXFLAGS := $(SEAMFLAGS)
$(B)/libkernel.a: $(call obj,$(KERNEL))
$(B)/libprogram.a: $(call obj,$(PROGRAM))
$(B)/liboracles.a: $(call obj,$(ORACLES))
$(B)/%.a:
	@echo "  AR    $@"
	$(Q)rm -f $@ && $(AR) rcs $@ $^
$(B)/tactus: $(call obj,$(SRCS)) $(B)/libprogram.a $(B)/libkernel.a
	@echo "  LD    $@"
	$(Q)$(CXX) $(SANITIZER) -o $@ $^ $(LDLIBS)
$(TESTS): %: %.o $(B)/liboracles.a $(B)/libprogram.a $(B)/libkernel.a
	@echo "  LD    $@"
	$(Q)$(CXX) $(SANITIZER) -o $@ $^ $(TESTLIBS)
$(B)/bench: $(call obj,$(wildcard tests/bench/*.cpp)) $(B)/libkernel.a
	@echo "  LD    $@"
	$(Q)$(CXX) -o $@ $^ -lbenchmark -lorocos-kdl -lpthread
$(B)/%.o: %.cpp Makefile boards/$(BOARD)/board.mk
	@mkdir -p $(@D)
	@echo "  CXX   $<"
	$(Q)$(CXX) $(CXXFLAGS) -c $< -o $@

.PRECIOUS: $(B)/%.o
.DELETE_ON_ERROR:
-include $(shell find $(B) -name '*.d' 2>/dev/null)
