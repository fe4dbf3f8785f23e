# tactusctl, the client: one program for all robots, so that it is compiled without a robot's table, and may use the heap.
# The Makefile includes this file and defines say, Q, SEAMFLAGS, VERSION and the rest.
CTL          := build/ctl$(HOW)
CTL_SEAM     := gateway/ctl/options.cpp
CTL_PARTS    := $(filter-out %/main.cpp,$(wildcard gateway/ctl/*.cpp gateway/ctl/retime/*.cpp)) gateway/csv_cells.cpp \
                gateway/line_reader.cpp gateway/sockets/address.cpp gateway/sockets/key_file.cpp kernel/core/text.cpp kernel/core/status.cpp kernel/load/ini.cpp \
                kernel/math/so3.cpp kernel/reference/space/polynomial.cpp kernel/reference/space/rotation_segment.cpp \
                kernel/reference/space/vector_bounds.cpp
ctl_obj       = $(patsubst %.cpp,$(CTL)/%.o,$(1))
CTL_SEAMFLAGS := $(filter-out -DTACTUS_ROBOT=%,$(SEAMFLAGS)) -isystem $(CTL)/proto
CTLFLAGS     := $(CTL_SEAMFLAGS) -fno-exceptions -fno-rtti $(if $(SANITIZE),,-DNDEBUG)
TACTUSCTL    := build/tactusctl$(HOW)

CTL_TESTS    := $(filter $(B)/tests/ctl/%,$(TESTS))

$(TACTUSCTL): $(call ctl_obj,gateway/ctl/main.cpp) $(CTL)/libctl.a
	$(call say,LD    $@)
	$(Q)$(CXX) $(SANITIZER) -o $@ $^ -lprotobuf -lsodium
$(CTL)/libctl.a: $(call ctl_obj,$(CTL_PARTS)) $(CTL)/proto/tactus.pb.o
$(CTL)/proto/tactus.pb.cc: gateway/tactus.proto
	$(call say,PROTO $<)
	$(Q)protoc -Igateway --cpp_out=$(@D) $<
$(CTL)/proto/tactus.pb.o: $(CTL)/proto/tactus.pb.cc
	$(Q)$(CXX) -std=c++17 $(SANITIZER) -O1 -c $< -o $@
# The messages are a system header, which dependency files leave out.
$(CTL)/%.o: %.cpp Makefile gateway/ctl/ctl.mk $(CTL)/proto/tactus.pb.cc
	$(call say,CXX   $<)
	$(Q)$(CXX) $(if $(filter $(CTL_SEAM),$<),$(CTL_SEAMFLAGS) -DTACTUS_VERSION='"$(VERSION)"',$(CTLFLAGS)) -c $< -o $@
$(call ctl_obj,$(CTL_SEAM)): build/version
# A program for the computer at which people sit; boards for other machines are built without it.
all: $(if $(filter host,$(ARCH)),$(TACTUSCTL))
.PHONY: install-tactusctl
install-tactusctl: setup $(TACTUSCTL)                          ## install tactusctl below PREFIX (default /usr/local)
	$(Q)install -D $(TACTUSCTL) $(ROOT)/bin/tactusctl
	$(Q)install -d $(SHARE)/man/man1 $(SHARE)/bash-completion/completions
	$(Q)ABOUT="client of the server of references" scripts/manual $(TACTUSCTL) tactusctl > $(SHARE)/man/man1/tactusctl.1
	$(Q)scripts/completion $(TACTUSCTL) tactusctl > $(SHARE)/bash-completion/completions/tactusctl
# Its tests are compiled as it is, and judge what it writes by the kernel of their board.
$(CTL)/tests/%.o: private CTLFLAGS += -DTACTUS_ROBOT=$(ROBOT)
$(CTL_TESTS): $(B)/%: $(CTL)/%.o $(CTL)/libctl.a $(O)/libkernel.a | $(TACTUSCTL)
	$(call say,LD    $@)
	$(Q)$(CXX) $(SANITIZER) -o $@ $^ -lcmocka
-include $(shell find $(CTL) -name '*.d' 2>/dev/null)
