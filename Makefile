# Tactus. `make help` lists the targets; BOARD=... chooses the board, V=1 shows the commands.
MAKEFLAGS += --no-builtin-rules
.DEFAULT_GOAL := all
BOARD ?= fer_sim
Q     := $(if $(V),,@)
comma := ,
ARCH  ?= host
JOBS  ?= $(shell nproc)
HOW   := $(if $(filter-out host,$(ARCH)),-$(ARCH))$(if $(SANITIZE),-$(subst $(comma),-,$(SANITIZE)))$(VARIANT:%=-%)$(LIBCCD:%=-convex)$(if $(filter command,$(origin UNITS)),$(if $(UNITS),,-single))
B     := build/$(BOARD)$(HOW)$(if $(LAWS),-laws)

# Of the files named after a robot, only those of the board's robot are compiled.
ROBOTS   := $(patsubst kernel/robots/%_capsules.hpp,%,$(wildcard kernel/robots/*_capsules.hpp))
of_robot  = $(filter-out $(foreach other,$(filter-out $(robot),$(ROBOTS)),%/$(other)_mjcf.cpp %_$(other).cpp),$(wildcard $(1)))

# A board.mk sets: robot, sources, libraries, runs and their runner, the name and own parts of its program, and its
# tests, if not all.
BOARDS := $(patsubst boards/%/board.mk,%,$(wildcard boards/*/board.mk))
# The name of a board without an operating system ends with its core: fer_m7. The core has a folder of its own.
CORES       := $(patsubst boards/%/memory.ld,%,$(wildcard boards/*/memory.ld))
BARE_BOARDS := $(filter $(addprefix %_,$(CORES)),$(BOARDS))
CORE        := $(filter $(CORES),$(lastword $(subst _, ,$(BOARD))))
BARE        := $(filter $(CORES),$(ARCH))
$(if $(strip $(BOARDS)),,$(error BOARDS is empty: name boards of boards/*/board.mk))
SRCS   :=
LDLIBS :=
RUNS   :=
NAME   := tactus
RUNNER  = $(B)/$(NAME)
PARTS  :=
SCRIPTED :=
ARM     = $(call of_robot,sim_plant/arm/*.cpp)
SIM     = $(ARM) $(wildcard program/sim/*.cpp)
PIL     = $(wildcard program/pil/*.cpp hal/serial/*.cpp)
TESTS  := $(filter-out tests/gateway/ctl/%,$(wildcard tests/*/test_*.cpp tests/*/*/test_*.cpp))
include tests/any_robot.mk
robot   = $(shell echo $(ROBOT) | tr A-Z a-z)
include boards/$(BOARD)/board.mk
# Each board has its programs; boards with the same robot share objects.
robot := $(robot)
O     := build/$(robot)$(HOW)
# The kinds of block that the board has, if not all.
KINDS := $(KINDS_$(ARCH))$(if $(and $(KINDS_$(ARCH)),$(LIBCCD)),$(comma) SphereObstacle$(comma) CapsuleObstacle$(comma) CylinderObstacle$(comma) ConvexObstacle)

# Laws that were compiled elsewhere, NAME=OBJECT (docs/library.md).
$(foreach law,$(LAWS),$(if $(filter 2,$(words $(subst =, ,$(law)))),,$(error LAWS: '$(law)' is not NAME=OBJECT)))
LAW_NAMES   := $(foreach law,$(LAWS),$(firstword $(subst =, ,$(law))))
$(foreach law,$(LAW_NAMES),$(if $(shell echo '$(law)' | grep -xE '[A-Za-z_][A-Za-z0-9_]*'),,$(error LAWS: '$(law)' is no name of C)))
LAW_OBJECTS := $(foreach law,$(LAWS),$(lastword $(subst =, ,$(law))))

# All our sources are compiled alike, except the seams to libraries that need exceptions; they include no Eigen header.
# CLI11 takes three times as long to optimise as to compile, for what runs once.
OPTION    := -O0
OPTIONS   := $(addsuffix /options.cpp,program/session sim_plant/ur/server sim_plant/drives/server sim_plant/ethercat/server)
SEAMS     := $(OPTIONS) $(wildcard tests/oracles/kdl*.cpp) tests/bench/kdl_peer.cpp
# GCC 12 sees reads beyond a string_view where its header is precompiled, and none without.
WARNINGS  := -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Werror -Wno-stringop-overread
OPTIMISED ?= $(if $(SANITIZE),-O1,-O3)
NUMERICS  := $(OPTIMISED) -ffp-contract=off -fno-math-errno -DEIGEN_DONT_VECTORIZE
SANITIZER := $(if $(SANITIZE),-fsanitize=$(SANITIZE) -fno-sanitize-recover=all)
UNJUDGED  := $(if $(findstring undefined,$(SANITIZE)),-fsanitize-ignorelist=tests/support/eigen.ignore)
# Fuzzers have objects of their own: counting branches for them would make every sanitized test half as fast.
SANITIZERS := address,undefined,float-cast-overflow
SANITIZED  := SANITIZE=$(SANITIZERS) CXX=clang++ WARNINGS=
# A robot's objects include its tables and no other's, so that a new robot compiles nothing anew.
OF_ROBOT  := -DTACTUS_ROBOT=$(ROBOT) -DTACTUS_ROBOT_TABLES='"kernel/robots/$(robot)_capsules.hpp"' -include kernel/core/build.hpp
# clang has no libquadmath of its own.
QUADMATH  := $(if $(findstring clang,$(CXX)),-idirafter $(shell gcc -print-file-name=include))
# Back traces, profiles and bounds need line tables. To track variables too (DEBUG=-g) takes twice as long to compile,
# with sanitizers three times.
DEBUG     ?= -g1
# GCC's own collector of garbage would take a twentieth of the time, to save a tenth of the memory.
FREELY    := $(if $(findstring clang,$(CXX)),,--param ggc-min-heapsize=1000000)
SEAMFLAGS := -std=c++17 $(DEBUG) $(FREELY) $(NUMERICS) $(WARNINGS) $(SANITIZER) -MMD -MP -I. -Ibuild/generated -isystem /usr/include/eigen3 \
             $(QUADMATH) $(if $(SANITIZE),-DTACTUS_SANITIZED $(UNJUDGED)) $(OF_ROBOT)
CXXFLAGS  := $(SEAMFLAGS) -fno-exceptions -fno-rtti -DEIGEN_NO_MALLOC $(if $(SANITIZE),,-DNDEBUG)

# The kernel is built for these machines: host, arm64, and bare cores, for which it is linked without a C library; programs
# for the first two.
CROSS_arm64 := aarch64-linux-gnu-
CROSS_m7    := arm-none-eabi-
CROSS_m55   := arm-none-eabi-
# Where flash is short, less is inlined and unrolled than -O3 would: a seventh smaller, a twelfth more instructions.
INLINING := --param max-inline-insns-single=70 --param max-inline-insns-auto=15 --param early-inlining-insns=6 \
            --param inline-min-speedup=30 --param max-completely-peeled-insns=16
# Streams of chunks, parameters that change at run time, and convex bodies take memory that they do not have. Convex bodies
# ask libccd, of which there is no package for them: with LIBCCD=FOLDER, that of its source, they have them.
CCD_FLAGS  := $(if $(LIBCCD),-DCCD_DOUBLE -DCCD_STATIC_DEFINE -isystem $(LIBCCD)/src -isystem $(O))
BARE_FLAGS := -DTACTUS_CHUNK_TARGETS=0 -DTACTUS_TUNING=0 $(or $(CCD_FLAGS),-DTACTUS_CONVEX=0) -mthumb -mfloat-abi=hard -fno-threadsafe-statics -fno-unwind-tables \
              -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections -fno-ipa-icf -Wno-psabi $(INLINING)
FLAGS_m7   := -mcpu=cortex-m7 -mfpu=fpv5-d16 $(BARE_FLAGS)
# Its vectors have no double precision, so they gain nothing.
FLAGS_m55  := -mcpu=cortex-m55+nomve $(BARE_FLAGS)
CXX      := $(CROSS_$(ARCH))g++
# A compiler of the command line may be one for another machine.
ifneq ($(and $(CROSS_$(ARCH)),$(filter command line,$(origin CXX))),)
$(if $(findstring $(firstword $(subst -, ,$(CROSS_$(ARCH)))),$(shell $(CXX) -dumpmachine)),,$(error CXX=$(CXX) does not compile for ARCH=$(ARCH); name a $(CROSS_$(ARCH))g++))
endif
# A program without libraries of its own needs the C library and no other.
LINK     := $(if $(filter host,$(ARCH)),-fuse-ld=lld) $(SANITIZER)
LDFLAGS  := $(if $(LDLIBS)$(SANITIZE),,-static-libstdc++ -static-libgcc)
# What kernel and gateway need; the kernel asks libccd where the arm's surroundings are no boxes.
LIBS     = $(GATEWAY_LIBS) -Wl,--as-needed -lccd
AR       := $(CROSS_$(ARCH))ar
NM       := $(CROSS_$(ARCH))nm
CXXFLAGS += $(FLAGS_$(ARCH)) $(VARIANT_FLAGS) $(if $(SANITIZE)$(findstring clang,$(CXX)),,-fstack-usage -fcallgraph-info=su)

# `make run` runs the pipelines of every board that is this computer; with BOARD=... those of that board.
RUN_BOARDS  := $(if $(filter command,$(origin BOARD)),$(BOARD),$(filter-out $(BARE_BOARDS),$(BOARDS)))
# `make run ONLY="fer_trg_cpc ur10_trg_cpc"` runs these, and ALWAYS=1 also what has not changed.
RUN_OPTIONS := $(if $(strip $(ONLY)),--only '$(ONLY)') $(if $(ALWAYS),--always)
# Those of a board with its processor in the loop always, because its image is no file that a run is known by.
RUN_OPTIONS += $(if $(filter $(BARE_BOARDS),$(RUN_BOARDS)),--always --out out/$(RUN_BOARDS))

# What runs at load and what a client runs, outside the cycle.
NOT_CYCLIC := $(wildcard kernel/load/*.cpp kernel/reference/motion/admission*.cpp) kernel/core/text.cpp \
              kernel/core/status.cpp kernel/model/mounting.cpp kernel/pipeline/schedule.cpp kernel/reference/motion/monotone.cpp \
              gateway/reference_client.cpp tests/bare_metal/board.cpp
KERNEL   := $(filter-out $(if $(BARE),$(if $(LIBCCD),,kernel/guard/convex%)),$(wildcard kernel/*/*.cpp kernel/reference/*/*.cpp))
# What sees the kinds of block. A board that has not all of them, or laws compiled elsewhere, shares the rest with other boards.
OF_KINDS := $(addprefix kernel/,load/loader.cpp load/parameter_book.cpp pipeline/pipeline.cpp pipeline/pipeline_tuning.cpp)
GATEWAY  := $(wildcard gateway/*.cpp $(addsuffix /*.cpp,$(addprefix gateway/,trajectory trajectory/smoothing page server sockets)))
PROGRAM  := $(wildcard $(addsuffix /*.cpp,program program/host program/session program/results program/reach hal/os)) $(GATEWAY) $(PARTS)
ORACLES  := $(call of_robot,tests/oracles/*.cpp)
# The tests of threads take the kernel and the frames of references, no more.
ifeq ($(SANITIZE),thread)
PROGRAM := $(wildcard gateway/reference_*.cpp)
ORACLES :=
endif
# The drives on CAN at both ends, without sockets and arm: for benches and bounds.
CAN_BENCH := $(wildcard hal/cia402/*.cpp) $(addprefix hal/can/,bus_load.cpp can_master.cpp can_plan.cpp \
               node_setup.cpp pdo_layout.cpp sdo_client.cpp startup.cpp) tests/wcet/can/can_cycle.cpp \
               $(filter-out %/drive_arm.cpp %/driven_arm.cpp,$(wildcard sim_plant/drives/*.cpp))
CAN_LINK  := $(addprefix hal/can/,can_socket.cpp link_health.cpp)
PCH       = $(O)/precompiled.hpp
obj       = $(patsubst %.cpp,$(O)/%.o,$(1))
say       = @mkdir -p $(@D) && echo "  $(1)"
# Writes what a command prints into the target if it differs, so that only a change makes what depends on it anew.
kept      = @mkdir -p $(@D) && $(1) | cmp -s - $@ || $(1) > $@
# Runs a command and adds a row to build/times.csv: what, name or target, seconds of wall, user and system.
TIME     := $(wildcard /usr/bin/time)
timed     = $(TIME:%=% -q -a -o build/times.csv -f '$(1),$(or $(2),$@),%e,%U,%S')
# The same for every board of BOARDS: one after the other what they print; robots side by side what they build, because
# boards of one robot share objects.
each      = set -e; for board in $(BOARDS); do $(MAKE) --no-print-directory BOARD=$$board $(1); done
build     = mkdir -p build && $(call timed,step,build $(1)) $(MAKE) --no-print-directory -j$(JOBS) $(2) robots GOALS="$(1)" BOARDS="$(BOARDS)"

include gateway/gateway.mk
include scripts/units.mk

.PHONY: docs all run test test-long check bench setup format clean help report-check film
all: $(if $(filter arm64,$(ARCH)),setup-arm64) trajectories $(B)/$(NAME)   ## build the program of BOARD, ARCH=arm64: for a board

run: BOARDS := $(RUN_BOARDS)
run: setup                                    ## run what has changed; ONLY="run ..." these only, ALWAYS=1 all; out/report.html
	$(Q)set -e; for packages in $(call packages_of,$(if $(ONLY),$(filter $(BARE_BOARDS),$(RUN_BOARDS)),$(RUN_BOARDS))); do \
	  scripts/setup $$packages; done
	$(Q)$(call build,all)
	$(Q)set -e; runs=$$($(call each,list-runs)); scripts/run_all $(RUN_OPTIONS) $$runs
test: setup                                   ## build and run all tests of every board; ONLY="control guard" those of tests/control and tests/guard
	$(Q)scripts/setup test
	$(Q)$(call build,tests)
	$(Q)set -e; tests=$$($(call each,list-tests)); scripts/run_tests --table $$tests
test-long: setup                              ## run the long random tests at full count
	$(Q)$(MAKE) --no-print-directory -j$(JOBS) $(LONG)
	$(Q)TACTUS_TRIALS=100000 scripts/run_tests $(LONG)
check: test                                   ## run all tests and checks that a change must pass
	$(Q)scripts/check
report-check: $(B)/$(NAME)                     ## draw a report of two runs of fer_sim and look at it in Chromium
	$(Q)scripts/setup report
	$(Q)set -e; for run in fer_trg_cpc fer_trg_ac_cpc_pid; do \
	  $< run pipelines/$$run.ini --no-figure --out build/report/$$run >/dev/null; done
	$(Q)scripts/report build/report
	$(Q)scripts/report_check build/report
film:                                         ## make docs/images/ from the report of make run, in Chromium
	$(Q)scripts/setup report
	$(Q)scripts/film out docs/images fer_jrg_pdgc:1-13 ur10_trg_ac_cpc_pid:2-30 fer_trg_ac_cpc_pid:3-20
docs: $(B)/$(NAME)                            ## write the generated documents
	$(Q)$(B)/$(NAME) ports > docs/ports.md
bench: $(B)/bench                             ## measure the time per call, and that of Orocos KDL, in one run
	$(Q)$(B)/bench
setup:                                        ## install missing Debian packages
	$(Q)scripts/setup
setup-%:
	$(Q)scripts/setup $*
format:                                       ## clang-format every source
	$(Q)clang-format -i $$(git ls-files -co --exclude-standard '*.[ch]pp' '*.[ch]')
compile_commands.json:                        ## for editors: every source by itself
	$(Q)bear -- $(MAKE) -B UNITS= all tests
clean:                                        ## remove everything that make has built
	$(Q)rm -rf build out compile_commands.json
help:                                         ## list the targets
	$(Q)grep -hE '^[a-z_.-]+:.*##' $(MAKEFILE_LIST:%.d=) | sed -E 's/:.*## */\t/' | expand -t 24

.PHONY: trajectories list-runs kernel robots shared always
# What the runs of a board need of scripts/setup; a run that is named with ONLY asks for it itself.
packages_of = $(sort $(shell sed -n 's/^PACKAGES *:= *//p' $(patsubst %,boards/%/board.mk,$(1)) /dev/null))
robot_of = $(shell sed -n 's/^ROBOT *:= *//p' boards/$(1)/board.mk)
robots: $(sort $(foreach board,$(BOARDS),$(addprefix robot-,$(call robot_of,$(board)))))
robot-%: shared
	$(Q)set -e; for board in $(foreach board,$(BOARDS),$(if $(filter $*,$(call robot_of,$(board))),$(board))); do \
	  $(MAKE) --no-print-directory BOARD=$$board $(GOALS); done
list-runs:
	@echo -- $(RUNNER) $(RUNS)
kernel: $(KERNEL_LIB) $(if $(filter m7,$(ARCH)),$(B)/board.elf)
	$(Q)scripts/no_heap $< $(NM)
trajectories: build/trajectories/fer_excitation.csv
build/trajectories/fer_excitation.csv: scripts/excitation
	@mkdir -p $(@D)
	$(Q)scripts/excitation --out $@

# Where flash is short it is compiled for size.
SMALL    := -Os
IN_SMALL := $(call kernel_objects,$(if $(BARE),$(NOT_CYCLIC)))
$(IN_SMALL) $(O)/small.hpp.gch: private CXXFLAGS += $(SMALL)
$(IN_SMALL): private PCH := $(O)/small.hpp
$(IN_SMALL): | $(O)/small.hpp.gch
$(call obj,$(SEAMS)): private CXXFLAGS := $(SEAMFLAGS)
$(call obj,$(OPTIONS)): private CXXFLAGS := $(SEAMFLAGS) $(OPTION)
$(call obj,$(SEAMS)): private PCH :=
$(eval $(call archive,$(KERNEL_LIB),$(KERNEL_OBJECTS)))
$(eval $(call archive,$(B)/libprogram.a,$(call objects,$(PROGRAM)) $(O)/gateway/tactus.pb.o))
WHOLE_KERNEL = -Wl,--whole-archive $(KERNEL_LIB) -Wl,--no-whole-archive $(filter-out %/libkernel.a,$^)
build/%.a:
	$(call say,AR    $@)
	$(Q)rm -f $@ && $(AR) rcs $@ $(filter %.o,$^)
build/%.members: always
	$(call kept,echo $(MEMBERS))
$(B)/linked: always
	$(call kept,echo $(call quote,$(CXX) $(LINK) $(LDFLAGS) $(SRCS) $(LDLIBS) $(TESTLIBS) $(LIBS)))
$(B)/$(NAME): $(call obj,$(SRCS)) $(B)/libprogram.a $(KERNEL_LIB) $(B)/linked
	$(call say,LD    $@)
	$(Q)$(call timed,link) $(CXX) $(LINK) $(LDFLAGS) -o $@ $(filter %.o %.a,$^) $(LDLIBS) $(LIBS)
$(B)/bench: $(call obj,$(wildcard tests/bench/*.cpp) $(CAN_BENCH) $(CAN_LINK)) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(LINK) -o $@ $^ -lbenchmark -lorocos-kdl -lpthread $(LIBS)

include program/install.mk
include program/library/library.mk
include gateway/ctl/ctl.mk
include program/package/package.mk
include tests/tests.mk
include tests/fuzz/fuzz.mk
include tests/wcet/wcet.mk
include tests/bare_metal/bare_metal.mk
include scripts/wcet/bound.mk
include tests/trace/trace.mk
include tests/bench/policies/policies.mk
include tests/wcet/can/can.mk
include boards/bare_metal/image.mk
include gateway/python/python.mk

# What boards of several robots take.
SHARED = $(MESSAGES).h $(if $(filter all tests,$(GOALS)),trajectories $(TACTUSCTL)) $(if $(filter tests,$(GOALS)),python $(WHEELS) build/libfcl_oracle.so)
shared: $(SHARED)

.PRECIOUS: $(O)/%.o $(O)/units/%.cpp
.DELETE_ON_ERROR:
-include $(shell find $(O) $(B) -type f -name '*.d' 2>/dev/null)
