# The benchmark of policies: docs/policies.md. The Makefile includes this file.
POLICY_BOARDS := fer_sim ur10_sim
POLICIES      := $(filter-out %/test_policies.cpp,$(wildcard tests/bench/policies/*.cpp))

.PHONY: bench-policies
bench-policies:                               ## replay chunks of a policy through the kernel and other executors: table and figure
	$(Q)set -e; for board in $(POLICY_BOARDS); do \
	  $(MAKE) --no-print-directory BOARD=$$board build/$$board/policy_replay; done
	$(Q)scripts/policies/bench $(POLICY_BOARDS:%=build/%/policy_replay)
$(B)/policy_replay: $(call obj,$(POLICIES)) $(B)/libprogram.a $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(LINK) -o $@ $^ $(LIBS)
$(B)/tests/bench/policies/test_policies: | $(B)/policy_replay
