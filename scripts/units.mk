# Units of several sources: docs/decisions/0024-units-of-several-sources.md. The Makefile includes this file and defines
# O, SEAMS and obj.
# What costs time in a source is Eigen's templates, so that sources which people change together are compiled together.
in_folders = $(filter-out $(SEAMS) %/main.cpp,$(call of_robot,$(1:%=%/*.cpp)))

UNITS := numerics control executive reference gateway server program reach arm pil cia402 can ethercat scan \
         ur ur_hal ur_plant ur_server drives drives_server segment segment_server
SOURCES_numerics  := $(call in_folders,kernel/core kernel/math kernel/model)
SOURCES_control   := $(call in_folders,kernel/control)
SOURCES_executive := $(call in_folders,kernel/guard kernel/pipeline kernel/load kernel/cycle)
SOURCES_reference := $(call in_folders,kernel/reference/space kernel/reference/motion kernel/reference/generator)
SOURCES_gateway   := $(call in_folders,gateway gateway/sockets)
SOURCES_server    := $(call in_folders,gateway/server gateway/page)
# A program whose malloc is that of heap_count.cpp takes its object, which is therefore its own.
SOURCES_program   := $(filter-out program/heap_count.cpp,$(call in_folders,program program/session program/results hal/os))
SOURCES_reach     := $(call in_folders,program/reach)
SOURCES_arm       := $(call in_folders,sim_plant/arm)
SOURCES_pil       := $(call in_folders,program/pil hal/serial)
SOURCES_cia402    := $(call in_folders,hal/cia402)
SOURCES_can       := $(call in_folders,hal/can)
SOURCES_ethercat  := $(call in_folders,hal/ethercat)
SOURCES_scan      := $(call in_folders,program/scan)
SOURCES_ur_hal    := $(filter-out hal/ur/ur_state.cpp,$(wildcard hal/net/*.cpp hal/ur/ur_*.cpp))
SOURCES_ur        := $(filter-out $(SOURCES_ur_hal),$(call in_folders,hal/ur))
SOURCES_ur_plant  := $(call in_folders,$(addprefix sim_plant/ur/,controller motion parts programs scene script wire))
SOURCES_ur_server := $(call in_folders,sim_plant/ur/server)
SOURCES_drives         := $(call in_folders,sim_plant/drives)
SOURCES_drives_server  := $(call in_folders,sim_plant/drives/server)
SOURCES_segment        := $(call in_folders,sim_plant/ethercat)
SOURCES_segment_server := $(call in_folders,sim_plant/ethercat/server)
