# Every parser under libFuzzer: docs/ur10_emulator.md. The Makefile includes this file and defines B, O and obj.
FUZZ_BUILD := BOARD=ur10_emulator $(SANITIZED)
FUZZ       := $(patsubst tests/fuzz/%.cpp,%,$(wildcard tests/fuzz/fuzz_*.cpp))
# The whole kernel, both ends of the UR's protocols, and emulated drives. A tape replaces the sockets, and a light arm replaces MuJoCo's.
FUZZED     := $(filter-out hal/ur/ur_%.cpp,$(wildcard hal/ur/*.cpp)) hal/ur/ur_state.cpp \
              $(filter-out sim_plant/ur/server/%,$(wildcard sim_plant/ur/*/*.cpp)) $(wildcard gateway/*.cpp) $(KERNEL) \
              $(wildcard sim_plant/drives/*.cpp) \
              tests/fuzz/wire.cpp tests/fuzz/light_arm.cpp sim_plant/arm/$(robot)_mjcf.cpp

.PHONY: fuzz fuzz-short fuzz-built
fuzz: fuzz-built                              ## fuzz every parser for SECONDS each (default 600)
	$(Q)nice scripts/fuzz --seconds $(or $(SECONDS),600) $(FUZZ)
fuzz-short: fuzz-built                        ## fuzz every parser briefly and reproducibly
	$(Q)scripts/fuzz $(FUZZ)
fuzz-built: wcet-setup
	$(Q)$(MAKE) --no-print-directory -j2 $(FUZZ_BUILD) fuzz-targets

ifneq ($(findstring fuzzer-no-link$(comma),$(SANITIZE)),)
.PHONY: fuzz-targets
CXXFLAGS += -fsanitize-ignorelist=tests/fuzz/eigen.ignore \
            -fsanitize-coverage-ignorelist=tests/fuzz/eigen.uncovered
fuzz-targets: $(addprefix $(B)/,$(FUZZ))
$(O)/libfuzzed.a: $(call obj,$(FUZZED))
$(addprefix $(B)/,$(FUZZ)): $(B)/%: $(O)/tests/fuzz/%.o $(O)/libfuzzed.a
	$(call say,LD    $@)
	$(Q)$(CXX) $(subst fuzzer-no-link,fuzzer,$(SANITIZER)) -o $@ $^
endif
