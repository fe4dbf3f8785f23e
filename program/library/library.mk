# `make install-kernel`: the kernel as a library for programs of others (docs/library.md). The Makefile includes this file
# after install.mk.
LIBRARY   := $(B)/libtactus_kernel_$(robot).a
UMBRELLAS := $(wildcard program/library/tactus/*.hpp)
# The client of reference channels belongs to it.
CLIENT    := $(addprefix gateway/,chunk_fit.cpp reference_client.cpp)
# Options that the caller's sources must share: those of layout and numerics, and those of the core.
CALLERS   := -DEIGEN_DONT_VECTORIZE -ffp-contract=off $(filter -m%,$(FLAGS_$(ARCH)))
PRIVATE   := $(if $(BARE),,-lccd -lm)
AS_CALLER  = $(CXX) -std=c++17 $(CALLERS) -I. -Iprogram/library -isystem /usr/include/eigen3
WITH       = $(filter -DTACTUS_CHUNK% -DTACTUS_TUNING% -DTACTUS_CONVEX%,$(CXXFLAGS))
HEADERS    = $(ROOT)/include/tactus
CMAKE      = $(ROOT)/lib/cmake/Tactus
filled     = sed -e 's,@prefix@,$(PREFIX),; s/@robot@/$(robot)/g; s/@version@/$(SEMVER)/; s/@flags@/$(CALLERS)/; s/@libs@/$(PRIVATE)/'

.PHONY: install-kernel
install-kernel: setup $(LIBRARY) $(B)/library.headers         ## install the kernel for BOARD's robot as a library below PREFIX
	$(Q)install -D -m 644 -t $(ROOT)/lib $(LIBRARY)
	$(Q)for header in $$(cat $(B)/library.headers); do install -D -m 644 $$header $(HEADERS)/$${header#program/library/}; done
	$(Q)install -D -m 644 -t $(HEADERS)/tactus $(B)/library/$(robot).hpp
	$(Q)install -m 644 -t $(HEADERS) kernel/core/tactus_law.h
	$(Q)install -d $(CMAKE)/robots $(ROOT)/lib/pkgconfig
	$(Q)$(filled) program/library/tactus-kernel.pc.in > $(ROOT)/lib/pkgconfig/tactus-kernel-$(robot).pc
	$(Q)$(filled) program/library/kernel.cmake.in > $(CMAKE)/robots/$(robot).cmake
	$(Q)install -m 644 program/library/TactusConfig.cmake $(CMAKE)
$(eval $(call archive,$(LIBRARY),$(KERNEL_OBJECTS) $(call obj,$(CLIENT)) $(CCD)))

# Robot and switches, as the library has them. Only headers that the umbrellas reach are installed.
$(B)/library/$(robot).hpp: $(O)/flags program/library/library.mk
	@mkdir -p $(@D)
	$(Q){ echo '// The robot and the switches of libtactus_kernel_$(robot).a. Include this file before all others of Tactus.'; \
	  echo '#pragma once'; printf '#define %s %s\n' TACTUS_ROBOT $(ROBOT) TACTUS_ROBOT_TABLES '"kernel/robots/$(robot)_capsules.hpp"' \
	  $(foreach switch,$(WITH),$(subst =, ,$(switch:-D%=%))); echo '#include "kernel/core/build.hpp"'; } > $@
$(B)/library.headers: $(B)/library/$(robot).hpp $(UMBRELLAS) $(LIBRARY)
	$(Q)printf '#include "%s"\n' $^ | grep 'hpp"' | $(AS_CALLER) -MM -x c++ - | tr -s ' \\' '\n\n' \
	  | sed -n '/library.$(robot).hpp/d; /[.]hp*$$/p' | sort -u > $@
