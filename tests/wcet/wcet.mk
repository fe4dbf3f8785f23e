# The worst case, measured and counted: docs/timing.md. The Makefile includes this file and defines B, O, robot, ARCH.
# The longest pipeline of every robot that has it.
WCET_ALL       := $(patsubst pipelines/%.ini,%,$(wildcard pipelines/*_trg_ac_cpc_pid.ini))
# The kernel runs on the boards that have a memory budget.
WCET_PIPELINES := $(if $(STATIC_BUDGET),$(filter $(robot)_%,$(WCET_ALL)))
WCET_SEARCH    := SANITIZE=fuzzer-no-link CXX=clang++ WARNINGS=
PLAYER         := tests/wcet/player.cpp tests/wcet/player_requests.cpp gateway/reference_client.cpp \
                  sim_plant/arm/$(robot)_mjcf.cpp
# What an image for measurements on a bare core is linked with.
BARE_START     := $(addprefix boards/bare_metal/,startup.cpp semihosting.cpp memory.cpp) boards/$(ARCH)/start.cpp \
                  $(addprefix tests/wcet/m7/,console.cpp handlers.cpp)
MEASURE_LD     := boards/$(ARCH)/memory.ld tests/wcet/m7/measure.ld

.PHONY: wcet wcet-boards wcet-count wcet-search wcet-setup wcet-built
wcet: wcet-built                              ## measure, count and bound the worst case of every stage; build/wcet
	$(Q)$(call each,-j$(JOBS) $(WCET_SEARCH) wcet-searches)
	$(Q)$(call each,-j$(JOBS) wcet-bound) > /dev/null
	$(Q)scripts/wcet/measure $(WCET_ALL)
	$(Q)scripts/wcet/count $(WCET_ALL) > /dev/null
	$(Q)nice scripts/wcet/search $(WCET_ALL)
	$(Q)scripts/wcet/table $(WCET_ALL)
	$(Q)$(MAKE) --no-print-directory wcet-boards
wcet-boards:                                  ## count the instructions of every period of boards without an operating system
	$(Q)$(MAKE) --no-print-directory BOARD=fer_sim build/wcet/count_plugin.so
	$(Q)set -e; for board in $(BARE_BOARDS); do $(MAKE) --no-print-directory BOARD=$$board all; \
	  scripts/wcet/board $$board $$($(MAKE) --no-print-directory BOARD=$$board list-runs | sed 's/^-- [^ ]*//'); done
wcet-count: wcet-built                        ## count the instructions of every stage
	$(Q)scripts/wcet/count $(WCET_ALL)
wcet-search: wcet-built                       ## search SECONDS for cycles longer than the known worst, and keep them
	$(Q)$(call each,-j$(JOBS) $(WCET_SEARCH) wcet-searches)
	$(Q)nice scripts/wcet/search --keep --seconds $(or $(SECONDS),600) $(WCET_ALL)
wcet-built: wcet-setup
	$(Q)$(call each,-j$(JOBS) wcet-host)
	$(Q)$(call each,-j$(JOBS) ARCH=m7 wcet-images)
wcet-setup:
	$(Q)scripts/setup wcet

ifeq ($(ARCH),m7)
.PHONY: wcet-images
wcet-images: $(WCET_PIPELINES:%=$(B)/wcet-%.elf) ;
$(WCET_PIPELINES:%=$(B)/wcet-%.elf): $(B)/wcet-%.elf: $(O)/tests/wcet/m7/main-%.o $(call obj,$(BARE_START) $(PLAYER)) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(FLAGS_m7) -nostartfiles -nostdlib -Wl,--gc-sections $(MEASURE_LD:%=-T %) -o $@ $(WHOLE_KERNEL) -lm -lgcc
$(O)/tests/wcet/m7/main-%.o: tests/wcet/m7/main.cpp pipelines/%.ini $(O)/flags
	$(call say,CXX   $<)
	$(Q)$(CXX) $(CXXFLAGS) -DPIPELINE_FILE='"pipelines/$*.ini"' -c $< -o $@
endif
ifeq ($(ARCH),host)
.PHONY: wcet-host
wcet-host: $(if $(WCET_PIPELINES),$(B)/wcet-replay build/wcet/count_plugin.so) $(WCET_PIPELINES:%=build/wcet/%/run.tape) ;
$(B)/wcet-record: $(O)/tests/wcet/record.o $(B)/libprogram.a $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(LINK) -o $@ $^ -lmujoco $(LIBS)
build/wcet/%/run.tape: pipelines/%.ini
	@mkdir -p $(@D)
	$(Q)$(B)/wcet-record $< $@
$(WCET_PIPELINES:%=build/wcet/%/run.tape): $(B)/wcet-record
$(O)/tests/wcet/replay.o: private CXXFLAGS := $(filter-out -DEIGEN_NO_MALLOC,$(SEAMFLAGS)) -DNDEBUG
$(B)/wcet-replay: $(O)/tests/wcet/replay.o $(call obj,$(PLAYER)) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(SANITIZER) -o $@ $^ $(LIBS)
build/wcet/count_plugin.so: tests/wcet/count_plugin.c
	$(call say,LD    $@)
	$(Q)gcc -O2 -Wall -Wextra -Werror -shared -fPIC -o $@ $<
# What test_wcet runs.
.PHONY: tested-images
tests: $(if $(filter %/tests/scripts/test_wcet,$(TESTS)),tested-images)
tested-images: build/wcet/count_plugin.so
	$(Q)$(MAKE) --no-print-directory ARCH=m7 wcet-images
endif
# Built by make SANITIZE=fuzzer-no-link CXX=clang++ WARNINGS= wcet-searches. The search target itself is compiled without
# coverage, so that libFuzzer does not count it.
ifeq ($(SANITIZE),fuzzer-no-link)
.PHONY: wcet-searches
wcet-searches: $(WCET_PIPELINES:%=$(B)/wcet-search-%) ;
$(WCET_PIPELINES:%=$(B)/wcet-search-%): $(B)/wcet-search-%: $(O)/tests/wcet/search-%.o $(call obj,$(PLAYER)) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) -fsanitize=fuzzer -o $@ $^ $(LIBS)
$(O)/tests/wcet/search-%.o: tests/wcet/search.cpp pipelines/%.ini $(O)/flags
	$(call say,CXX   $<)
	$(Q)$(CXX) $(filter-out -fsanitize=%,$(CXXFLAGS)) -DPIPELINE_FILE='"pipelines/$*.ini"' -c $< -o $@
endif
