# The messages of gateway/tactus.proto as C structs of fixed size, by nanopb. The Makefile includes this file and defines
# O, CROSS_..., obj and say.
MESSAGES := build/generated/gateway/tactus.pb
# Static, as Debian has both: the programs of robots need the C library and no other.
GATEWAY_LIBS := -l:libprotobuf-nanopb.a -l:libsodium.a

# Apart from our warnings, as it is generated.
$(O)/gateway/tactus.pb.o: $(MESSAGES).c
	$(call say,CC    $<)
	$(Q)$(CROSS_$(ARCH))gcc -std=c11 -O2 -g1 -Ibuild/generated -c $< -o $@
$(MESSAGES).c $(MESSAGES).h $(MESSAGES:.pb=.schema) &: gateway/tactus.proto gateway/tactus.options
	$(call say,PROTO $<)
	$(Q)mkdir -p build/generated && protoc -I. --nanopb_out=build/generated --descriptor_set_out=$(MESSAGES:.pb=.schema) $<

# It copies the schema of the messages into the program.
$(call obj,program/results/run_recording.cpp) $(O)/units/program.o: $(MESSAGES:.pb=.schema)

# It copies the page into the program.
$(call obj,gateway/page/page_files.cpp) $(O)/units/server.o: $(wildcard gateway/page/web/*)

.PHONY: run-server
run-server: setup                             ## serve a simulated UR10 in real time, with a page; says where
	$(Q)$(MAKE) --no-print-directory -j$(JOBS) BOARD=ur10_sim all
	$(Q)build/ur10_sim/tactus serve --virtual-time --http 127.0.0.1:7380 pipelines/ur10_trg_cpc.ini

.PHONY: page-picture
page-picture:                                 ## make docs/images/page.png, the page of a simulated UR10, in Chromium
	$(Q)scripts/setup report
	$(Q)$(MAKE) --no-print-directory -j$(JOBS) BOARD=ur10_sim all
	$(Q)scripts/page_picture build/ur10_sim/tactus pipelines/ur10_trg_cpc.ini pipelines/trajectories/ur10_square.csv docs/images/page.png

.PHONY: bench-key-press
bench-key-press: setup                        ## measure the time from a key press to the first changed command
	$(Q)$(MAKE) --no-print-directory -j$(JOBS) BOARD=ur10_sim build/ur10_sim/tactus build/tactusctl python
	$(Q)tests/bench/key_press.py build/ur10_sim/tactus build/tactusctl
