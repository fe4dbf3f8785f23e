# The image of a board with a Cortex-M7 and nothing else: docs/memory.md. The Makefile includes this file after wcet.mk.
# Its pipeline is the longest of the robot; of a robot without, any, for which only linking matters.
BARE_PIPELINE := $(firstword $(WCET_PIPELINES:%=pipelines/%.ini) $(wildcard pipelines/$(robot)_*.ini))
BARE_BOARD    := $(call obj,tests/bare_metal/board.cpp gateway/reference_client.cpp sim_plant/arm/$(robot)_mjcf.cpp $(BARE_START))

ifeq ($(ARCH),m7)
$(B)/board.elf: $(BARE_BOARD) $(CCD) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(FLAGS_m7) -nostartfiles -nostdlib -Wl,--gc-sections $(MEASURE_LD:%=-T %) -o $@ $(WHOLE_KERNEL) -lm -lgcc
	$(Q)$(CROSS_m7)size $@
$(O)/tests/bare_metal/board.o: private CXXFLAGS += -DPIPELINE_FILE='"$(BARE_PIPELINE)"'
$(O)/tests/bare_metal/board.o: $(BARE_PIPELINE)
endif
