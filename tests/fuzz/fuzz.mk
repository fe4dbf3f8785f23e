# Every parser under libFuzzer: docs/ur10_emulator.md. Included by the Makefile; B, O and obj are its.
FUZZ_BUILD := BOARD=ur10_emulator SANITIZE=fuzzer-no-link,address,undefined,float-cast-overflow CXX=clang++ WARNINGS= \
              OPTIMISED=-O2
FUZZ       := $(patsubst tests/fuzz/%.cpp,%,$(wildcard tests/fuzz/fuzz_*.cpp))
# The whole kernel, and both sides of the UR's wire. A tape stands in the place of the sockets, and a light arm in that of MuJoCo's.
FUZZED     := $(filter-out hal/ur/socket.cpp hal/ur/ur_%.cpp,$(wildcard hal/ur/*.cpp)) hal/ur/ur_state.cpp \
              $(wildcard sim_plant/ur/*.cpp gateway/*.cpp) $(KERNEL) \
              tests/fuzz/wire.cpp tests/fuzz/light_arm.cpp

.PHONY: fuzz fuzz-short fuzz-built
fuzz: fuzz-built                              ## every parser fuzzed for SECONDS each (default 600)
	$(Q)nice scripts/fuzz --seconds $(or $(SECONDS),600) $(FUZZ)
fuzz-short: fuzz-built                        ## the same, briefly and repeatably
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
	$(Q)$(CXX) $(subst fuzzer-no-link,fuzzer,$(SANITIZER)) -o $@ $^ -lccd
endif
