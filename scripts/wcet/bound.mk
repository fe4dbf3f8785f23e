# The static bound and the memory certificate: docs/timing.md, docs/memory.md. The Makefile includes this file.
# An exception stacks 26 words of the FPU and the core, and one more to align them. [Arm, DDI 0403, B1.5.6 and B1.5.7]
EXCEPTION := 108

.PHONY: wcet-bound wcet-refute certificate certificate-host certificate-m7
wcet-bound:                                   ## bound the cycle of the longest pipeline of BOARD, without running it
	$(Q)$(MAKE) --no-print-directory ARCH=m7 wcet-images $(WCET_PIPELINES:%=build/wcet/%/bounds.json)
build/wcet/%/bounds.json: build/$(BOARD)-m7/wcet-%.elf $(wildcard scripts/wcet/*.* scripts/wcet/bound/*.*) scripts/wcet_bound
	@mkdir -p $(@D)
	$(Q)scripts/wcet_bound $< pipelines/$*.ini --out $@ --claims $(@D)/claims.json > $(@:.json=.txt)
	@cat $(@:.json=.txt)

wcet-refute: wcet-bound build/wcet/count_plugin.so   ## try to refute the bounds of BOARD with the tapes made by hand
	$(Q)$(if $(WCET_PIPELINES),scripts/wcet/refute $(WCET_PIPELINES))

certificate:                                  ## check static bytes, worst-case stack and heap calls of BOARD
	$(Q)$(if $(STATIC_BUDGET),$(MAKE) --no-print-directory certificate-host)
	$(Q)$(if $(STATIC_BUDGET),$(MAKE) --no-print-directory ARCH=m7 certificate-m7)
	$(Q)$(if $(RAM_BUDGET),$(MAKE) --no-print-directory ARCH=$(CORE) image-certificate)
certificate-m7: $(KERNEL_LIB) $(B)/board.elf
	$(Q)scripts/certificate $(BOARD)-m7 --objects $(KERNEL_OBJECTS) --image $(B)/board.elf --tools $(CROSS_m7) \
	  --static-budget $(STATIC_BUDGET) --flash-budget $(FLASH_BUDGET) --stack-budget $(STACK_BUDGET) --exception $(EXCEPTION) > $(B)/certificate.txt
	@grep -E '^(memory|RAM|flash|stack)' $(B)/certificate.txt
	$(Q)qemu-system-arm -M mps2-an500 -nographic -monitor none -serial none -semihosting-config enable=on,target=native \
	  -kernel $(B)/board.elf
certificate-host: $(KERNEL_LIB) $(B)/stack_painter
	$(Q)scripts/certificate $(BOARD) --objects $(KERNEL_OBJECTS) --stack-budget $(HOST_STACK_BUDGET) \
	  --painted $(B)/stack_painter > $(B)/certificate.txt
	@grep -E '^(memory|stack|painted)' $(B)/certificate.txt
$(B)/stack_painter: $(call obj,tests/wcet/stack_painter.cpp $(PLAYER)) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(LINK) -o $@ $^ $(LIBS)
$(O)/tests/wcet/stack_painter.o: private CXXFLAGS += -DPIPELINE_FILE='"pipelines/$(firstword $(WCET_PIPELINES)).ini"'
$(O)/tests/wcet/stack_painter.o: $(WCET_PIPELINES:%=pipelines/%.ini)
