# Every parser under libFuzzer: docs/robots/ur10_emulator.md. The Makefile includes this file and defines B, O and obj.
FUZZERS    := $(wildcard tests/fuzz/fuzz_*.cpp tests/fuzz/*/fuzz_*.cpp)
FUZZ       := $(basename $(notdir $(FUZZERS)))
# The parsers of CAN and EtherCAT are built for fer_can, all others for ur10_emulator.
FUZZ_CAN   := $(filter fuzz_can_% fuzz_ethercat_%,$(FUZZ))
FUZZ_HERE  := $(if $(filter fer_can,$(BOARD)),$(FUZZ_CAN),$(filter-out $(FUZZ_CAN),$(FUZZ)))
# The whole kernel, and both ends of the UR's protocols. A tape replaces the sockets, and a light arm
# replaces MuJoCo's.
FUZZED     := $(filter-out hal/ur/ur_%.cpp,$(wildcard hal/ur/*.cpp)) hal/ur/ur_state.cpp \
              $(filter-out sim_plant/ur/server/%,$(wildcard sim_plant/ur/*/*.cpp)) $(GATEWAY) $(KERNEL) \
              $(wildcard hal/serial/*.cpp) hal/cia402/object_lines.cpp hal/os/cycle_clock.cpp hal/os/ordinary_thread.cpp tests/fuzz/ur/wire.cpp tests/fuzz/light_arm.cpp sim_plant/arm/$(robot)_mjcf.cpp
ifeq ($(BOARD),fer_can)
FUZZED     := $(wildcard hal/can/*.cpp hal/ethercat/*.cpp hal/cia402/*.cpp sim_plant/drives/*.cpp sim_plant/ethercat/*.cpp) $(KERNEL) tests/wcet/can/can_cycle.cpp \
              tests/fuzz/light_arm.cpp sim_plant/arm/$(robot)_mjcf.cpp
endif

.PHONY: fuzz fuzz-short fuzz-built
fuzz: fuzz-built                              ## fuzz every parser for SECONDS each (default 600)
	$(Q)nice scripts/fuzz --seconds $(or $(SECONDS),600) $(FUZZ)
fuzz-short: fuzz-built                        ## fuzz every parser briefly and reproducibly
	$(Q)scripts/fuzz $(FUZZ)
fuzz-built: BOARDS := ur10_emulator fer_can
fuzz-built: wcet-setup
	$(Q)$(call build,fuzz-targets,SANITIZE=fuzzer-no-link$(comma)$(SANITIZERS) CXX=clang++ WARNINGS=)

ifneq ($(findstring fuzzer-no-link$(comma),$(SANITIZE)),)
.PHONY: fuzz-targets
CXXFLAGS += -fsanitize-coverage-ignorelist=tests/fuzz/eigen.uncovered
fuzz-targets: $(addprefix $(B)/,$(FUZZ_HERE))
fuzzer = $(filter %/$(1).o,$(call obj,$(FUZZERS)))
$(eval $(call archive,$(O)/libfuzzed.a,$(call objects,$(FUZZED)) $(if $(filter fer_can,$(BOARD)),,$(O)/gateway/tactus.pb.o)))
$(addprefix $(B)/,$(FUZZ_HERE)): $(B)/%: $$(call fuzzer,$$*) $(O)/libfuzzed.a
	$(call say,LD    $@)
	$(Q)$(call timed,link) $(CXX) $(subst fuzzer-no-link,fuzzer,$(LINK)) -o $@ $^ $(LIBS)
endif
