# The same bits on every machine: docs/same_bits.md. The Makefile includes this file after wcet.mk.
TRACE := tests/trace/trace.cpp tests/trace/traced_player.cpp $(PLAYER)

.PHONY: trace same-bits
trace: $(B)/trace
same-bits:                                    ## compare the bits of all runs on x86-64, every compiler and level, aarch64 and bare cores
	$(Q)scripts/setup check
	$(Q)scripts/same_bits --matrix --twice
ifneq ($(BARE),)
$(B)/trace: $(call obj,tests/trace/m7/main.cpp $(TRACE) $(BARE_START)) $(CCD) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(FLAGS_$(ARCH)) -nostartfiles -nostdlib -Wl,--gc-sections $(MEASURE_LD:%=-T %) -o $@ $(WHOLE_KERNEL) -lm -lgcc
else
# Linked statically where that is possible, so that an emulator needs no libraries of the machine; libccd is a shared one.
$(B)/trace: $(or $(CCD),$(call obj,tests/trace/no_libccd.cpp)) $(call obj,tests/trace/main.cpp $(TRACE)) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(or $(SANITIZER),-static) -o $@ $^
$(B)/tests/trace/test_trace: $(O)/tests/trace/trace.o | $(B)/trace
$(B)/tests/trace/test_trace: private TESTLIBS := $(KERNEL_LIB) $(TESTLIBS)
endif
