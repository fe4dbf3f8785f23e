# The static bound and the memory certificate: docs/timing.md, docs/memory.md. Included by the Makefile.
DOF_FER   := 7
DOF_UR10  := 6
# An exception stacks 26 words of the FPU and the core, and one more to align them. [Arm, DDI 0403, B1.5.6 and B1.5.7]
EXCEPTION := 108

.PHONY: wcet-bound certificate certificate-host certificate-m7
wcet-bound:                                   ## the static bound of the cycle of BOARD, of its longest pipeline
	$(Q)$(MAKE) --no-print-directory ARCH=m7 wcet-images $(WCET_PIPELINES:%=build/wcet/%/bounds.json)
build/wcet/%/bounds.json: build/$(BOARD)-m7/wcet-%.elf $(wildcard scripts/wcet/*) scripts/wcet_bound
	@mkdir -p $(@D)
	$(Q)scripts/wcet_bound $< pipelines/$*.ini --dof $(DOF_$(ROBOT)) --out $@ > $(@:.json=.txt)
	@cat $(@:.json=.txt)

certificate:                                  ## memory of BOARD: static bytes, worst-case stack, no heap, all within budget
	$(Q)$(if $(STATIC_BUDGET),$(MAKE) --no-print-directory certificate-host)
	$(Q)$(if $(STATIC_BUDGET),$(MAKE) --no-print-directory ARCH=m7 certificate-m7)
certificate-m7: $(O)/libkernel.a $(B)/link.elf
	$(Q)scripts/certificate $(BOARD)-m7 --callgraph $(O)/kernel --image $(B)/link.elf --tools $(CROSS_m7) \
	  --static-budget $(STATIC_BUDGET) --stack-budget $(STACK_BUDGET) --exception $(EXCEPTION) > $(B)/certificate.txt
	@grep -E '^(memory|RAM|stack)' $(B)/certificate.txt
certificate-host: $(O)/libkernel.a $(B)/stack_painter
	$(Q)scripts/certificate $(BOARD) --callgraph $(O)/kernel --stack-budget $(HOST_STACK_BUDGET) \
	  --painted $(B)/stack_painter > $(B)/certificate.txt
	@grep -E '^(memory|stack|painted)' $(B)/certificate.txt
$(B)/stack_painter: $(call obj,tests/wcet/stack_painter.cpp $(PLAYER)) $(O)/libkernel.a
	$(call say,LD    $@)
	$(Q)$(CXX) -o $@ $^ -lccd
$(O)/tests/wcet/stack_painter.o: CXXFLAGS += -DPIPELINE_FILE='"build/wcet/$(firstword $(WCET_PIPELINES)).ini"'
$(O)/tests/wcet/stack_painter.o: $(WCET_PIPELINES:%=build/wcet/%.ini)
