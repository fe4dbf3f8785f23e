# The image of a board without an operating system: docs/bare_metal.md. The Makefile includes this file. boards/$(ARCH)/
# has what belongs to the core and its machine.
BARE_SRCS := $(filter-out boards/bare_metal/provoke_%.cpp,$(wildcard boards/bare_metal/*.cpp boards/$(ARCH)/*.cpp)) \
             $(wildcard hal/serial/*.cpp) $(addprefix gateway/reference_,client.cpp frames.cpp server.cpp) \
             sim_plant/arm/$(robot)_mjcf.cpp
IMAGE_LD  := boards/$(ARCH)/memory.ld boards/bare_metal/image.ld

.PHONY: image image-certificate
ifneq ($(BARE),)
$(O)/boards/bare_metal/startup.o: private CXXFLAGS += -fno-tree-loop-distribute-patterns -fno-builtin
image: $(B)/image.elf $(B)/image-faults.elf   ## build the image of a board without an operating system: BOARD=fer_m7
$(B)/image.elf: $(O)/boards/bare_metal/provoke_nothing.o
$(B)/image-faults.elf: $(O)/tests/bare_metal/provoke_faults.o
$(B)/image.elf $(B)/image-faults.elf: $(call obj,$(BARE_SRCS)) $(CCD) $(KERNEL_LIB) $(IMAGE_LD)
	$(call say,LD    $@)
	$(Q)$(CXX) $(FLAGS_$(ARCH)) -nostartfiles -nostdlib -Wl,--gc-sections $(IMAGE_LD:%=-T %) -o $@ \
	  -Wl,--whole-archive $(KERNEL_LIB) -Wl,--no-whole-archive $(filter %.o,$^) -lm -lgcc
	$(Q)$(CROSS_$(ARCH))size $@
$(O)/boards/bare_metal/embedded_text.o: private CXXFLAGS += -DPIPELINE_FILE='"pipelines/$(PIPELINE).ini"'
$(O)/boards/bare_metal/embedded_text.o: pipelines/$(PIPELINE).ini
# The stacks of cycles, of background work and of a fault, as the linker script has them.
image-certificate: $(B)/image.elf $(call obj,$(BARE_SRCS) boards/bare_metal/provoke_nothing.cpp)             ## check RAM, flash and stacks of that image: BOARD=fer_m7 ARCH=m7
	$(Q)scripts/certificate $(BOARD) --objects $(filter %.o,$^) $(KERNEL_OBJECTS) --image $< \
	  --tools $(CROSS_$(ARCH)) --rules boards/bare_metal/stack.txt --exception $(EXCEPTION) --static-budget $(RAM_BUDGET) \
	  --flash-budget $(IMAGE_BUDGET) --roots 'on_timer=16384,void program(=24576,keep_fault=8192' > $(B)/certificate.txt
	@grep -E '^(memory|RAM|flash|stack)' $(B)/certificate.txt
endif
ifeq ($(ARCH),host)
ifneq ($(CORE),)
all $(if $(TEST_SOURCES)$(SCRIPTED),tests): image
image:
	$(Q)$(MAKE) --no-print-directory ARCH=$(CORE) SANITIZE= CXX=$(CROSS_$(CORE))g++ image
endif
endif
