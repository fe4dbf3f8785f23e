# What the wire to the drives may use beside what the kernel may: system calls of sockets, the clock while it connects, a sleep while it leaves.
CAN_SYSTEM := socket|bind|if_nametoindex|recvfrom|send|ioctl|[gs]etsockopt|fcntl|close|p?poll|(recv|send)mmsg|clock_(gettime|nanosleep)|strerror|__errno_location|strncpy|memchr|floor|lround

# The CAN part of a cycle, counted and bounded on the Cortex-M7: docs/timing.md. The Makefile includes this file.
CAN_IMAGE := $(CAN_BENCH) tests/wcet/can/library.cpp tests/wcet/can/main.cpp $(BARE_START)

.PHONY: can-symbols wcet-can wcet-can-image
can-symbols: $(B)/libcan.a                    ## check that the wires to drives, CAN and EtherCAT, have no heap, exceptions or locks
	$(Q)scripts/no_heap $< $(NM) '$(CAN_SYSTEM)'
$(eval $(call archive,$(B)/libcan.a,$(call objects,$(KERNEL) $(wildcard hal/cia402/*.cpp hal/can/*.cpp hal/ethercat/*.cpp))))
wcet-can:                                     ## count and bound the CAN part of a cycle
	$(Q)$(MAKE) --no-print-directory BOARD=fer_sim build/wcet/count_plugin.so
	$(Q)$(MAKE) --no-print-directory BOARD=fer_sim ARCH=m7 wcet-can-image
	$(Q)scripts/wcet/can build/fer_sim-m7/wcet-can.elf
ifeq ($(ARCH),m7)
# What the analyser reads: a copy of a few bytes stays a loop, whose LoopBound says how many they are, and a switch is
# comparisons.
$(call obj,$(wildcard hal/can/*.cpp hal/cia402/*.cpp)): private CXXFLAGS += -fno-tree-loop-distribute-patterns -fno-jump-tables
wcet-can-image: $(B)/wcet-can.elf
$(B)/wcet-can.elf: $(call obj,$(CAN_IMAGE)) $(KERNEL_LIB)
	$(call say,LD    $@)
	$(Q)$(CXX) $(FLAGS_m7) -nostartfiles -nostdlib -Wl,--gc-sections $(MEASURE_LD:%=-T %) -o $@ $^ -lm -lgcc
endif
