# The version, and `make install`. The Makefile includes this file and defines B, O, NAME and obj.
SEMVER  := $(shell sed -n 's/^.define TACTUS_VERSION_[MP][A-Z]* //p' program/library/tactus_version.h | paste -sd.)
VERSION := $(basename $(SEMVER))$(shell git describe --always --dirty 2>/dev/null | sed 's/^/-/')
PREFIX  ?= /usr/local
ROOT    := $(call quote,$(DESTDIR)$(PREFIX))
LIB     := $(ROOT)/lib/tactus
SHARE   := $(ROOT)/share
COMMAND := $(NAME)-$(BOARD)
# The man page and the completion are what the program itself says.
RUN_arm64 := qemu-aarch64 -L /usr/aarch64-linux-gnu
RUN       := $(RUN_$(ARCH))

# The program finds scripts/figure three folders above itself, as in this tree.
.PHONY: install
install: setup $(B)/$(NAME) trajectories                       ## install the program of BOARD below PREFIX (default /usr/local)
	$(Q)install -D $(B)/$(NAME) $(LIB)/boards/$(BOARD)/$(NAME)
	$(Q)install -d $(ROOT)/bin $(SHARE)/man/man1 $(SHARE)/bash-completion/completions $(SHARE)/tactus
	$(Q)ln -sf ../lib/tactus/boards/$(BOARD)/$(NAME) $(ROOT)/bin/$(COMMAND)
	$(Q)install -D -t $(LIB)/scripts scripts/figure scripts/report
	$(Q)install -D -m 644 -t $(LIB)/scripts/reporting scripts/reporting/*.py
	$(Q)install -D -m 644 -t $(LIB)/scripts/reporting/web scripts/reporting/web/*
	$(Q)install -D -m 644 -t $(LIB)/docs docs/ports.md
	$(Q)install -D -m 644 -t $(LIB)/sim_plant/arm sim_plant/arm/*_mjcf.cpp
	$(Q)install -m 644 NOTICE $(LIB)/NOTICE
	$(Q)for file in $$(find pipelines -type f); do install -D -m 644 $$file $(SHARE)/tactus/$$file; done
	$(Q)install -D -m 644 -t $(SHARE)/tactus/build/trajectories build/trajectories/*
	$(Q)scripts/manual $(B)/$(NAME) $(COMMAND) $(RUN) > $(SHARE)/man/man1/$(COMMAND).1
	$(Q)scripts/completion $(B)/$(NAME) $(COMMAND) $(RUN) > $(SHARE)/bash-completion/completions/$(COMMAND)
	$(Q)chmod 644 $(SHARE)/man/man1/$(COMMAND).1 $(SHARE)/bash-completion/completions/$(COMMAND)

$(call obj,gateway/version.cpp): private CXXFLAGS += -DTACTUS_VERSION='"$(VERSION)"'
$(call obj,gateway/version.cpp): build/version
build/version: always
	$(call kept,echo '$(VERSION)')
.PHONY: always
always:
