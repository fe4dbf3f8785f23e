# The tests. The Makefile includes this file and defines B, O, TESTS and the rest.
# Tests of scripts run nothing that is compiled, so that a sanitizer has nothing to see in them; nor in what another robot
# does in the same lines.
SCRIPT_TESTS := $(wildcard tests/scripts/test_*.cpp)
OF_THREADS   := $(addprefix tests/,core/test_mailbox.cpp core/test_histogram.cpp pipeline/test_recorder.cpp \
                  reference/generator/test_reference_threads.cpp cycle/test_ladder.cpp)
UNSEEN       := $(SCRIPT_TESTS) $(if $(filter fer,$(robot)),,$(filter-out $(OF_EACH),$(ANY_ROBOT)))
TEST_SOURCES := $(if $(SANITIZE),$(filter-out $(UNSEEN),$(TESTS)),$(TESTS))
TEST_SOURCES := $(if $(filter thread,$(SANITIZE)),$(OF_THREADS),$(TEST_SOURCES))
# `make test ONLY="control guard"` builds and runs the tests of these folders.
chosen       := $(strip $(if $(filter command,$(origin ONLY)),$(subst $(comma), ,$(ONLY))))
ifneq ($(filter test,$(MAKECMDGOALS)),)
$(foreach word,$(chosen),$(if $(wildcard tests/$(word)/.),,$(error ONLY: there is no folder tests/$(word); name folders of tests/)))
endif
TEST_SOURCES := $(if $(chosen),$(filter $(chosen:%=tests/%/%),$(TEST_SOURCES)),$(TEST_SOURCES))
SCRIPTED     := $(if $(chosen),$(filter $(chosen:%=tests/%/%),$(SCRIPTED)),$(SCRIPTED))
TESTS        := $(TEST_SOURCES:%.cpp=$(B)/%)
# These run together in a virtual machine that has CAN buses.
VM_TESTS     := $(filter $(B)/tests/vm/%,$(TESTS))
LONG         := $(addprefix $(B)/tests/reference/motion/,test_motion test_admission_oracle test_every_motion)
TESTLIBS     := -Wl,--as-needed -lcmocka -lmujoco -lorocos-kdl -lquadmath -Lbuild -lfcl_oracle -Wl,-rpath,$(CURDIR)/build

# The tests of a folder are compiled as one unit and linked to one program, which runs those that it is called by: each
# source is a link to it, a process of its own. Math in quad precision gains nothing from that; a virtual machine takes files.
APART   := tests/math tests/vm
FOLDERS := $(patsubst %/,%,$(sort $(dir $(TEST_SOURCES))))
of       = $(strip $(foreach source,$(TEST_SOURCES),$(if $(filter $(1)/,$(dir $(source))),$(source))))
JOINED  := $(if $(UNITS),$(foreach folder,$(filter-out $(APART),$(FOLDERS)),$(if $(word 2,$(call of,$(folder))),$(folder))))
SINGLE  := $(foreach folder,$(filter-out $(JOINED),$(FOLDERS)),$(call of,$(folder)))
LINKED  := $(filter-out $(SINGLE:%.cpp=$(B)/%),$(TESTS))

# Folders in which this board has no tests.
WITHOUT := $(filter-out $(FOLDERS),$(patsubst %/.,%,$(wildcard tests/*/. tests/*/*/.)))

.PHONY: tests list-tests list-sources sanitized-tests thread-tests $(FOLDERS) $(WITHOUT) $(addsuffix /,$(FOLDERS) $(WITHOUT))
tests: trajectories $(if $(filter thread,$(SANITIZE)),,$(if $(TESTS)$(SCRIPTED),$(B)/$(NAME))) $(TESTS)
	@:
list-tests:
	@echo $(filter-out $(VM_TESTS),$(TESTS)) $(if $(SANITIZE),,$(if $(VM_TESTS),tests/vm/run tests/vm/repeat tests/vm/pipeline) $(SCRIPTED))
list-sources:
	@echo $(TEST_SOURCES)
sanitized-tests:                              ## build and run the tests of BOARDS with sanitizers
	$(Q)$(call build,tests,$(SANITIZED))
	$(Q)set -e; tests=$$($(call each,$(SANITIZED) list-tests)); scripts/run_tests $$tests
thread-tests:                                 ## build and run the tests of what threads share with the sanitizer of threads
	$(Q)$(MAKE) --no-print-directory -j$(JOBS) SANITIZE=thread tests
	$(Q)scripts/run_tests $$($(MAKE) --no-print-directory SANITIZE=thread list-tests)

QUICK := -O1
IN_TESTS := $(filter-out $(SEAMS),$(ORACLES) $(SINGLE))
$(call obj,$(IN_TESTS)) $(JOINED:%=$(B)/%/unit.o) $(O)/quick.hpp.gch: private CXXFLAGS += $(QUICK)
$(call obj,$(IN_TESTS)) $(JOINED:%=$(B)/%/unit.o): private PCH := $(O)/quick.hpp
$(call obj,$(IN_TESTS)): | $(O)/quick.hpp.gch
$(O)/tests/pipeline/test_pipelines.o $(B)/tests/pipeline/unit.o: private CXXFLAGS += -DRUNS='"$(RUNS)"'
$(O)/tests/pipeline/test_pipelines.o $(B)/tests/pipeline/unit.o: boards/$(BOARD)/board.mk
$(eval $(call archive,$(O)/liboracles.a,$(call obj,$(ORACLES))))
# Debian's FCL is compiled with vectorised Eigen, so its caller is too, in a library that hides its symbols.
build/libfcl_oracle.so: tests/oracles/fcl/fcl.cpp tests/oracles/fcl/fcl.hpp
	$(call say,LD    $@)
	$(Q)$(call timed,compile) $(CXX) -std=c++17 -O1 -fPIC -shared -fvisibility=hidden $(WARNINGS) -I. -isystem /usr/include/eigen3 -o $@ $< -lfcl
$(TESTS): | build/libfcl_oracle.so

OF_PRODUCT := $(O)/liboracles.a $(B)/libprogram.a $(KERNEL_LIB) $(B)/linked
$(filter-out $(B)/tests/gateway/ctl/%,$(SINGLE:%.cpp=$(B)/%)): $(B)/%: $(O)/%.o $(OF_PRODUCT)
	$(call say,LD    $@)
	$(Q)$(call timed,link) $(CXX) $(LINK) -o $@ $(filter %.o %.a,$^) $(TESTLIBS) $(LIBS)
$(patsubst %,$(B)/%/tests,$(filter-out tests/gateway/ctl,$(JOINED))): %/tests: %/unit.o $(OF_PRODUCT) | build/libfcl_oracle.so
	$(call say,LD    $@)
	$(Q)$(call timed,link) $(CXX) $(LINK) -o $@ $(filter %.o %.a,$^) $(TESTLIBS) $(LIBS)
$(patsubst %,$(B)/%/unit.o,$(filter-out tests/gateway/ctl,$(JOINED))): %/unit.o: %/unit.cpp $(O)/flags | $(O)/quick.hpp.gch $(MESSAGES).h
	$(call say,CXX   $<)
	$(compile)
$(JOINED:%=$(B)/%/sources): $(B)/%/sources: always
	$(call kept,echo $(call of,$*))

.SECONDEXPANSION:
$(JOINED:%=$(B)/%/unit.cpp): $(B)/%/unit.cpp: $$(call of,$$*) $(B)/%/sources scripts/test_unit
	$(Q)scripts/test_unit $@ $(call of,$*) && touch $@
$(LINKED): %: $$(@D)/tests
	$(Q)ln -sf tests $@
# `make BOARD=fer_sim tests/control` builds and runs the tests of one folder.
$(FOLDERS): trajectories $(B)/$(NAME) $$(patsubst %.cpp,$(B)/%,$$(call of,$$@))
	$(Q)scripts/run_tests $(patsubst %.cpp,$(B)/%,$(call of,$@))
$(WITHOUT):
	@echo '$@: $(BOARD) has no tests there; it has some in $(FOLDERS)' >&2; exit 2
$(addsuffix /,$(FOLDERS) $(WITHOUT)): %/: % ;
