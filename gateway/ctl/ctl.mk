# tactusctl, the client: one program for all robots, so that it is compiled without a robot's table, and may use the heap.
# The Makefile includes this file and defines say, Q, SEAMFLAGS, VERSION and the rest.
CTL          := build/ctl$(HOW)
CTL_SEAM     := gateway/ctl/options.cpp
CTL_CLIENT   := $(filter-out $(CTL_SEAM) %/main.cpp,$(wildcard gateway/ctl/*.cpp gateway/ctl/retime/*.cpp))
# What it shares with the programs of robots.
CTL_SHARED   := gateway/trajectory/csv_cells.cpp gateway/trajectory/line_reader.cpp gateway/mcap_writer.cpp gateway/sockets/address.cpp gateway/sockets/key_file.cpp \
                kernel/core/text.cpp kernel/core/status.cpp kernel/load/ini.cpp kernel/math/so3.cpp \
                $(addprefix kernel/reference/space/,polynomial.cpp rotation_segment.cpp vector_bounds.cpp)
ctl_obj       = $(patsubst %.cpp,$(CTL)/%.o,$(1))
CTL_OBJECTS  := $(if $(UNITS),$(CTL)/units/client.o,$(call ctl_obj,$(CTL_CLIENT))) \
                $(call ctl_obj,$(CTL_SEAM) gateway/version.cpp) $(CTL)/proto/tactus.pb.o
CTL_SEAMFLAGS := $(filter-out $(OF_ROBOT),$(SEAMFLAGS)) -isystem $(CTL)/proto
CTLFLAGS     := $(CTL_SEAMFLAGS) -fno-exceptions -fno-rtti $(if $(SANITIZE),,-DNDEBUG)
TACTUSCTL    := build/tactusctl$(HOW)

CTL_TESTS    := $(filter $(B)/tests/gateway/ctl/%,$(TESTS:%.cpp=$(B)/%))

$(TACTUSCTL): $(call ctl_obj,gateway/ctl/main.cpp) $(CTL)/libctl.a $(if $(UNITS),$(CTL)/units/shared.o,$(call ctl_obj,$(CTL_SHARED)))
	$(call say,LD    $@)
	$(Q)$(call timed,link) $(CXX) $(LINK) -o $@ $^ -lprotobuf -lsodium
$(eval $(call archive,$(CTL)/libctl.a,$(CTL_OBJECTS)))
$(CTL)/proto/tactus.pb.cc: gateway/tactus.proto
	$(call say,PROTO $<)
	$(Q)protoc -Igateway --cpp_out=$(@D) $<
$(CTL)/proto/tactus.pb.o: $(CTL)/proto/tactus.pb.cc
	$(Q)$(call timed,compile) $(CXX) -std=c++17 $(SANITIZER) -O1 -c $< -o $@
# The tables of all robots, for `retime --robot`.
CTL_ROBOTS = { printf '\#include "kernel/robots/%s.hpp"\n' $(ROBOTS); echo 'namespace tactus::ctl {'; \
  echo '/// True if use(robot) is, of one of the robots.'; echo 'template <class Use> bool any_robot(Use use) { return false'; \
  printf ' || use(%s{})' $(shell printf '%s\n' $(ROBOTS) | sed 's/^./\U&/'); echo '; } }'; }
$(CTL)/proto/robots.hpp: always
	$(call kept,$(CTL_ROBOTS))
$(CTL)/units/client.o $(call ctl_obj,gateway/ctl/retime/retime_limits.cpp): $(CTL)/proto/robots.hpp
$(CTL)/flags: always
	$(call kept,echo $(call quote,$(CXX) $(CTLFLAGS) $(OPTION)))
$(CTL)/units/client.cpp: always
	$(call kept,printf '#include "%s"\n' $(CTL_CLIENT))
$(CTL)/units/shared.cpp: always
	$(call kept,printf '#include "%s"\n' $(CTL_SHARED))
$(CTL)/units/retime.cpp: always
	$(call kept,printf '#include "%s"\n' $(filter-out %/retime_limits.cpp,$(wildcard gateway/ctl/retime/*.cpp)))
ctl_compile = $(Q)$(call timed,compile) $(CXX) $(CTLFLAGS) -c $< -o $@
# The messages are a system header, which dependency files leave out.
$(CTL)/units/%.o: $(CTL)/units/%.cpp $(CTL)/flags $(CTL)/proto/tactus.pb.cc
	$(call say,CXX   $<)
	$(ctl_compile)
$(CTL)/%.o: %.cpp $(CTL)/flags $(CTL)/proto/tactus.pb.cc
	$(call say,CXX   $<)
	$(ctl_compile)
$(call ctl_obj,$(CTL_SEAM)): private CTLFLAGS := $(CTL_SEAMFLAGS) $(OPTION)
$(CTL)/gateway/version.o: private CTLFLAGS += -DTACTUS_VERSION='"$(VERSION)"'
$(CTL)/gateway/version.o: build/version
# A program for the computer at which people sit; boards for other machines are built without it.
all: $(if $(filter host,$(ARCH)),$(TACTUSCTL))
.PHONY: install-tactusctl
install-tactusctl: setup $(TACTUSCTL)                          ## install tactusctl below PREFIX (default /usr/local)
	$(Q)install -D $(TACTUSCTL) $(ROOT)/bin/tactusctl
	$(Q)install -d $(SHARE)/man/man1 $(SHARE)/bash-completion/completions
	$(Q)ABOUT="client of the server of references" scripts/manual $(TACTUSCTL) tactusctl > $(SHARE)/man/man1/tactusctl.1
	$(Q)scripts/completion $(TACTUSCTL) tactusctl > $(SHARE)/bash-completion/completions/tactusctl
# Its tests judge what it writes by the kernel of their board, for whose robot they and what they call of it are compiled.
CTL_LIBS := $(CTL)/units/retime.o $(B)/libprogram.a $(KERNEL_LIB)
$(CTL)/tests/%.o $(CTL)/units/retime.o $(B)/tests/gateway/ctl/unit.o: private CTLFLAGS += $(OF_ROBOT)
$(B)/tests/gateway/ctl/unit.o: %.o: %.cpp $(CTL)/flags $(CTL)/proto/tactus.pb.cc
	$(call say,CXX   $<)
	$(ctl_compile)
$(B)/tests/gateway/ctl/tests: $(B)/tests/gateway/ctl/unit.o $(CTL_LIBS) | $(TACTUSCTL)
	$(call say,LD    $@)
	$(Q)$(call timed,link) $(CXX) $(LINK) -o $@ $^ -lcmocka -lprotobuf $(LIBS)
$(if $(UNITS),,$(CTL_TESTS)): $(B)/%: $(CTL)/%.o $(CTL_LIBS) | $(TACTUSCTL)
	$(call say,LD    $@)
	$(Q)$(CXX) $(LINK) -o $@ $^ -lcmocka -lprotobuf $(LIBS)
-include $(shell find $(CTL) -type f -name '*.d' 2>/dev/null)
