# The image of a board with a Cortex-M7 and nothing else: docs/bare_metal.md. The Makefile includes this file.
BARE_SRCS := $(filter-out boards/m7/provoke_%.cpp,$(wildcard boards/m7/*.cpp)) \
             $(wildcard hal/serial/*.cpp) $(addprefix gateway/reference_,client.cpp frames.cpp server.cpp) \
             sim_plant/arm/$(robot)_mjcf.cpp

.PHONY: image image-certificate
ifeq ($(ARCH),m7)
image: $(B)/image.elf $(B)/image-faults.elf   ## build the image of a board with a Cortex-M7: BOARD=fer_m7 ARCH=m7
$(B)/image.elf: $(O)/boards/m7/provoke_nothing.o
$(B)/image-faults.elf: $(O)/tests/bare_metal/provoke_faults.o
$(B)/image.elf $(B)/image-faults.elf: $(call obj,$(BARE_SRCS)) $(O)/libkernel.a boards/m7/mps2-an500.ld
	$(call say,LD    $@)
	$(Q)$(CXX) $(FLAGS_m7) -nostartfiles -nostdlib -Wl,--gc-sections -T boards/m7/mps2-an500.ld -o $@ \
	  -Wl,--whole-archive $(O)/libkernel.a -Wl,--no-whole-archive $(filter %.o,$^) -lm -lgcc
	$(Q)$(CROSS_m7)size $@
$(O)/boards/m7/embedded_text.o: private CXXFLAGS += -DPIPELINE_FILE='"pipelines/$(PIPELINE).ini"'
$(O)/boards/m7/embedded_text.o: pipelines/$(PIPELINE).ini
# The stacks of cycles, of background work and of a fault, as the linker script has them.
image-certificate: $(B)/image.elf             ## check RAM, flash and stacks of that image: BOARD=fer_m7 ARCH=m7
	$(Q)scripts/certificate $(BOARD) --callgraph $(addprefix $(O)/,boards gateway hal kernel sim_plant) --image $< \
	  --tools $(CROSS_m7) --rules boards/m7/stack.txt --exception $(EXCEPTION) --static-budget $(RAM_BUDGET) \
	  --flash-budget $(IMAGE_BUDGET) --roots 'on_timer=16384,void program(=24576,keep_fault=8192' > $(B)/certificate.txt
	@grep -E '^(memory|RAM|flash|stack)' $(B)/certificate.txt
endif
ifeq ($(ARCH),host)
ifneq ($(filter $(BOARD),$(BARE_BOARDS)),)
all tests: image
image:
	$(Q)$(MAKE) --no-print-directory ARCH=m7 SANITIZE= CXX=$(CROSS_m7)g++ image
endif
endif
