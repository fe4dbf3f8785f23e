#The benchmark of policies : docs / policies.md.The Makefile includes this file.
POLICY_BOARDS := fer_sim ur10_sim

.PHONY: bench-policies
bench-policies:                               ## replay chunks of policies through the kernel and other executors: table and figure
	$(Q)$(foreach board,$(POLICY_BOARDS),$(MAKE) --no-print-directory BOARD=$(board) build/$(board)/policy_replay &&) \
	  scripts/policies/bench $(POLICY_BOARDS:%=build/%/policy_replay)
$(B)/policy_replay: $(call obj,$(wildcard tests/bench/policies/*.cpp)) $(B)/libprogram.a $(O)/libkernel.a
	$(call say,LD    $@)
	$(Q)$(CXX) $(SANITIZER) -o $@ $^
