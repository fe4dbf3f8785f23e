# How sources become objects: docs/decisions/0024-units-of-several-sources.md. The Makefile includes this file and
# defines O, B, CXXFLAGS, SEAMS and the rest. `make UNITS=` compiles every source by itself.
# What costs time in a source is Eigen's templates, so that sources which people change together are compiled together.
in_folders = $(filter-out $(SEAMS) %/main.cpp %/version.cpp,$(call of_robot,$(1:%=%/*.cpp)))

UNITS := numerics control executive reference gateway server program reach arm pil serial cia402 can ethercat scan \
         ur ur_hal ur_plant ur_server drives drives_server segment
SOURCES_numerics  := $(call in_folders,kernel/core kernel/math kernel/model)
SOURCES_control   := $(call in_folders,kernel/control)
SOURCES_executive := $(call in_folders,kernel/guard kernel/pipeline kernel/load kernel/cycle)
SOURCES_reference := $(call in_folders,kernel/reference/space kernel/reference/motion kernel/reference/generator \
                       kernel/streams kernel/reference/blocks)
SOURCES_gateway   := $(call in_folders,gateway gateway/trajectory gateway/trajectory/smoothing gateway/sockets)
SOURCES_server    := $(call in_folders,gateway/server gateway/page)
# A program whose malloc is that of heap_count.cpp takes its object, which is therefore its own.
SOURCES_program   := $(filter-out program/heap_count.cpp,$(call in_folders,program program/host program/session program/results hal/os))
SOURCES_reach     := $(call in_folders,program/reach)
SOURCES_arm       := $(call in_folders,sim_plant/arm)
SOURCES_pil       := $(call in_folders,program/pil)
SOURCES_serial    := $(call in_folders,hal/serial)
SOURCES_cia402    := $(call in_folders,hal/cia402)
SOURCES_can       := $(call in_folders,hal/can)
SOURCES_ethercat  := $(call in_folders,hal/ethercat)
SOURCES_scan      := $(call in_folders,program/scan)
SOURCES_ur_hal    := $(filter-out hal/ur/ur_state.cpp,$(wildcard hal/net/*.cpp hal/ur/ur_*.cpp))
SOURCES_ur        := $(filter-out $(SOURCES_ur_hal),$(call in_folders,hal/ur))
SOURCES_ur_plant  := $(call in_folders,$(addprefix sim_plant/ur/,controller motion parts programs scene script wire))
SOURCES_ur_server := $(call in_folders,sim_plant/ur/server)
SOURCES_drives    := $(call in_folders,sim_plant/drives)
SOURCES_drives_server := $(call in_folders,sim_plant/drives/server)
SOURCES_segment   := $(call in_folders,sim_plant/ethercat)

# What is linked for a bare core is counted and bounded object by object.
ifneq ($(BARE),)
UNITS :=
endif

# $(call objects,SOURCES): the units that are among them as a whole, and an object for each other source.
units_in = $(foreach unit,$(UNITS),$(if $(SOURCES_$(unit)),$(if $(filter-out $(1),$(SOURCES_$(unit))),,$(unit))))
objects  = $(call joined,$(1),$(call units_in,$(1)))
joined   = $(foreach unit,$(2),$(if $(filter $(unit),$(OF_LAWS)),$(B),$(O))/units/$(unit).o) $(call obj,$(filter-out $(foreach unit,$(2),$(SOURCES_$(unit))),$(1)))

# A board without all kinds of block, or with laws compiled elsewhere, has its own objects of what sees them, and a kernel
# of its own.
OF_LAWS        := $(if $(LAWS),$(filter executive gateway server program,$(UNITS)))
KERNEL_LIB     := $(if $(KINDS)$(LAWS),$(B),$(O))/libkernel.a
kernel_objects  = $(if $(KINDS),$(foreach source,$(1),$(patsubst %.cpp,$(if $(filter $(OF_KINDS),$(source)),$(B),$(O))/%.o,$(source))),$(call objects,$(1)))

# Of a function that several objects have, the linker takes the first: the cycle's, not one that is compiled for size.
KERNEL_OBJECTS := $(call kernel_objects,$(filter-out $(NOT_CYCLIC),$(KERNEL)) $(filter $(NOT_CYCLIC),$(KERNEL))) $(LAW_OBJECTS)

# $(call archive,FILE,OBJECTS): it is made anew when it has other members, too.
define archive
$(1): $(2) $(1).members
$(1).members: private MEMBERS := $(2)
endef

# The precompiled header comes first: clang ignores it behind another -include.
compile = $(Q)$(call timed,compile) $(CXX) $(PCH:%=-include %) $(CXXFLAGS) -c $< -o $@
# A word of the shell, whatever it contains.
quote   = '$(subst ','\'',$(1))'
$(O)/flags: always
	$(call kept,echo $(call quote,$(CXX) $(CXXFLAGS) $(SMALL) $(QUICK) $(OPTION)))
$(UNITS:%=$(O)/units/%.cpp): $(O)/units/%.cpp: always
	$(call kept,printf '#include "%s"\n' $(sort $(SOURCES_$*)))
$(UNITS:%=$(O)/units/%.o): %.o: %.cpp $(O)/flags | $(O)/precompiled.hpp.gch $(MESSAGES).h
	$(call say,CXX   $<)
	$(compile)
$(O)/%.o: %.cpp $(O)/flags | $(O)/precompiled.hpp.gch $(MESSAGES).h
	$(call say,CXX   $<)
	$(compile)
$(OF_LAWS:%=$(B)/units/%.o): $(B)/units/%.o: $(O)/units/%.cpp $(O)/flags $(B)/laws.hpp | $(O)/precompiled.hpp.gch $(MESSAGES).h
	$(call say,CXX   $<)
	$(compile)
$(if $(LAWS),$(B)/kinds): $(B)/laws.hpp
$(B)/laws.hpp: always
	$(call kept,{ echo '#include "kernel/control/c_law.hpp"'; $(foreach law,$(LAW_NAMES),\
	  echo 'extern "C" const tactus_law $(law);'; echo 'namespace tactus { inline constexpr char $(law)_word[] = "$(law)"; }';) \
	  echo '#define TACTUS_LAW_KINDS' $(foreach law,$(LAW_NAMES),'$(comma) CLaw<::$(law)$(comma) $(law)_word>'); })
OWN_KINDS := $(OF_LAWS:%=$(B)/units/%.o) $(if $(KINDS),$(OF_KINDS:%.cpp=$(B)/%.o))
$(OWN_KINDS): private CXXFLAGS += $(if $(KINDS),-DTACTUS_KINDS='$(KINDS)') $(if $(LAWS),-DTACTUS_LAWS='"$(B)/laws.hpp"')
$(if $(KINDS),$(OF_KINDS:%.cpp=$(B)/%.o)): $(B)/%.o: %.cpp $(O)/flags $(B)/kinds | $(O)/precompiled.hpp.gch
	$(call say,CXX   $<)
	$(compile)
$(B)/kinds: always
	$(call kept,echo $(call quote,$(KINDS)))
$(if $(KINDS)$(LAWS),$(KERNEL_LIB)): | $(B)/kinds_checked
$(B)/kinds_checked: $(filter $(O)/%,$(KERNEL_OBJECTS) $(if $(OF_LAWS),$(call objects,$(SRCS) $(PROGRAM))))
	$(Q)! grep -l 'kernel/pipeline/kinds[.]hpp' $(^:.o=.d) || { echo '$@: these see the kinds of block; name them in OF_KINDS or OF_LAWS' >&2; exit 1; }
	$(Q)mkdir -p $(@D) && touch $@
# Eigen and the standard library, parsed once for what is shipped, once for what is small, and once for tests, which need
# not be fast.
$(addprefix $(O)/,precompiled.hpp.gch small.hpp.gch quick.hpp.gch): kernel/core/precompiled.hpp $(O)/flags
	$(call say,PCH   $@)
	$(Q)cp $< $(@:.gch=) && $(call timed,compile) $(CXX) $(CXXFLAGS) -x c++-header $< -o $@

# libccd from its source in LIBCCD, with our flags, for machines without a package of it and for the same bits on all; only
# what the kernel calls, which takes no heap.
ifneq ($(LIBCCD),)
CCD := $(O)/libccd.o
CCD_SOURCES := $(addprefix $(LIBCCD)/src/,ccd.c vec3.c support.c)
$(if $(wildcard $(CCD_SOURCES)),,$(error LIBCCD=$(LIBCCD) has no src/ccd.c; give the folder of the source of libccd 2.1))
$(CCD): $(CCD_SOURCES) $(O)/ccd/config.h
	$(call say,CC    $@)
	$(Q)cat $(CCD_SOURCES) | $(CROSS_$(ARCH))gcc -std=gnu99 -w $(NUMERICS) $(FLAGS_$(ARCH)) $(CCD_FLAGS) -ffunction-sections -x c -c - -o $@
	$(Q)$(CROSS_$(ARCH))ld -r --gc-sections -e ccdGJKIntersect -u ccdGJKIntersect $@ -o $@.part && mv $@.part $@
	$(Q)$(CROSS_$(ARCH))objcopy --keep-global-symbol=ccdGJKIntersect --strip-unneeded $@
$(KERNEL_OBJECTS): | $(O)/ccd/config.h
$(O)/ccd/config.h:
	@mkdir -p $(@D) && touch $@
endif
